#!/usr/bin/python3
# SPDX-FileCopyrightText: facet_mapping contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""scripts/paper_tables: what is computed of scores, and the whole command on a few frames.
Usage: paper_tables_test.py FOLDER_OF_PROGRAMS"""
import json
import math
import os
import re
import struct
import subprocess
import sys
import tempfile
import unittest

ROOT = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..")
SCRIPTS = os.path.join(ROOT, "scripts")
sys.path.insert(0, SCRIPTS)
import paper_tables_report as report  # noqa: E402

METHODS = report.METHODS


def scores(mae, f_score):
    return {"facets": 10, "cpu_s": 2.0,
            "depth": {"mae_m": mae, "median_m": mae, "rms_m": mae, "trimmed_mae_m": mae,
                      "completeness": 0.5, "within_absolute": [0.1, 0.2, 0.3, 0.4]},
            "labels": {"accuracy": f_score, "recall": f_score, "f_score": f_score,
                       "precision": f_score, "mean_iou": f_score}}


def sample(offset):
    one = {method: scores(0.010 * (k + 1) + offset, 0.1 * (k + 1) + offset)
           for k, method in enumerate(METHODS)}
    one["segmentation"] = {"depth": {"mae_m": None}, "labels": scores(0, 0.7)["labels"]}
    return one


def street(**more):
    return dict({"key": "street", "title": "Street", "note": "A note.",
                 "samples": [sample(0.0), sample(0.001), sample(0.002)]}, **more)


class Report(unittest.TestCase):
    def test_mean_and_standard_deviation_over_streets(self):
        self.assertAlmostEqual(report.center(street(), "initial mesh", "depth/mae_m"), 0.011)
        self.assertAlmostEqual(report.spread(street(), "initial mesh", "depth/mae_m"), 0.001)
        self.assertEqual(report.cell(street(), "proposed", "depth/mae_m", "%.1f", 1e3),
                         "41.0 ± 1.0")

    def test_the_given_start_is_the_value_and_perturbed_ones_its_spread(self):
        case = street(given=sample(0.005))
        self.assertEqual(report.cell(case, "proposed", "depth/mae_m", "%.1f", 1e3), "45.0 ± 1.0")

    def test_one_seed_has_no_spread(self):
        case = dict(street(), samples=[sample(0.0)])
        self.assertEqual(report.cell(case, "proposed", "depth/mae_m", "%.1f", 1e3), "40.0")

    def test_ratio_to_photometric(self):
        case = street(given=sample(0.0))
        self.assertEqual(report.ratio(case, "proposed", "depth/mae_m"), "2.000")

    def test_what_is_not_known_is_a_dash(self):
        peer = {"facets": 3, "depth": dict(scores(0.01, 0)["depth"], trimmed_mae_m=None)}
        case = street(given=dict(sample(0.0), peer=peer))
        row = [line for line in report.depth_table(case).splitlines() if "| peer |" in line][0]
        self.assertEqual(row.split(" | ")[6], "-")
        self.assertTrue(row.endswith("| 0.500 | - |"))
        self.assertNotIn("peer", report.label_table(case))

    def test_paired_difference_has_no_part_that_both_share(self):
        self.assertEqual(report.paired_difference(street(), "depth/mae_m", "%+.1f", 1e3),
                         "-10.0 ± +0.0")


def png_size(path):
    with open(path, "rb") as file:
        head = file.read(24)
    assert head[:8] == b"\x89PNG\r\n\x1a\n", path
    return struct.unpack(">II", head[16:24])


class Command(unittest.TestCase):
    def run_parts(self, folder, *parts):
        """--data is FOLDER/data."""
        return subprocess.run(
            ["/usr/bin/python3", os.path.join(SCRIPTS, "paper_tables_runs.py"), "--programs",
             PROGRAMS, "--data", os.path.join(folder, "data"), "--labels",
             os.path.join(ROOT, "config", "labels", "cityscapes.yaml"), "--output", folder,
             "--quick", *parts], text=True, capture_output=True, timeout=500)

    def test_street_and_noise(self):
        with tempfile.TemporaryDirectory() as folder:
            answer = self.run_parts(folder, "street", "noise", "fountain")
            self.assertEqual(answer.returncode, 0, answer.stderr)
            files = [os.path.join(folder, name) for name in
                     ("tables.md", "depth_mae.png", "label_f_score.png", "noise.png")]
            self.assertEqual(answer.stdout.split(), files)
            with open(files[0], encoding="utf-8") as file:
                self.check_tables(file.read())
            for path in files[1:]:
                self.assertGreater(min(png_size(path)), 400)
            self.check_scores(os.path.join(folder, "scores.json"))
            self.assertFalse([name for name in os.listdir(folder) if name.startswith("tmp")])

    def check_tables(self, text):
        for method in METHODS:
            self.assertEqual(len(re.findall(r"^\| %s \|" % method, text, re.MULTILINE)), 2)
        self.assertRegex(text, r"(?m)^\| 0\.7 \|")
        self.assertIn("fountain: the data set fountain_p11 is not in", text)
        self.assertIn("Quick run", text)

    def check_scores(self, path):
        with open(path) as file:
            cases = json.load(file)
        self.assertEqual([case["key"] for case in cases], ["street_0.7", "street_0", "street_0.7"])
        for case in cases:
            initial, proposed = (case["samples"][0][name] for name in ("initial mesh", "proposed"))
            self.assertTrue(math.isfinite(proposed["depth"]["mae_m"]))
            self.assertGreater(proposed["depth"]["completeness"], 0.5)
            self.assertGreater(proposed["cpu_s"], initial["cpu_s"])
        # Without noise the segmentation is the truth.
        exact = cases[1]["samples"][0]["segmentation"]["labels"]
        self.assertEqual(exact["accuracy"], 1.0)

    def test_perturbed_starts_of_a_data_set(self):
        with tempfile.TemporaryDirectory() as folder:
            # The street stands in for the data set of that name.
            subprocess.run([os.path.join(PROGRAMS, "street_to_bag"),
                            os.path.join(folder, "data", "kitti_labels_03"), "--no-bag",
                            "--no-scans", "--frames", "5"], check=True, capture_output=True)
            answer = self.run_parts(folder, "kitti_labels")
            self.assertEqual(answer.returncode, 0, answer.stderr)
            with open(os.path.join(folder, "scores.json")) as file:
                case = json.load(file)[0]
            given, perturbed = case["given"]["initial mesh"], case["samples"][0]["initial mesh"]
            self.assertEqual(given["facets"], perturbed["facets"])
            self.assertNotEqual(given["depth"]["mae_m"], perturbed["depth"]["mae_m"])
            self.assertLess(abs(given["depth"]["median_m"] - perturbed["depth"]["median_m"]), 0.05)
            self.check_perturbation(folder)

    def check_perturbation(self, folder):
        def displaced(seed):
            mesh = os.path.join(folder, "displaced.ply")
            subprocess.run([os.path.join(PROGRAMS, "refine_mesh"),
                            os.path.join(folder, "meshes", "kitti_labels", "proposed.ply"),
                            os.path.join(folder, "data", "kitti_labels_03"), mesh, "--iterations",
                            "0", "--perturb-px", "1", "--seed", seed],
                           check=True, capture_output=True)
            with open(mesh, "rb") as file:
                return file.read()

        first = displaced("1")
        self.assertTrue(first == displaced("1"), "the same seed gave another mesh")
        self.assertFalse(first == displaced("2"), "another seed gave the same mesh")

    def test_nothing_to_run_is_an_error_with_a_reason(self):
        with tempfile.TemporaryDirectory() as folder:
            answer = self.run_parts(folder, "kitti")
            self.assertNotEqual(answer.returncode, 0)
            self.assertIn("kitti_drive_0009 is not in", answer.stderr)

    def test_unknown_parts_are_refused(self):
        answer = subprocess.run([os.path.join(SCRIPTS, "paper_tables"), "fontain"], text=True,
                                capture_output=True, timeout=60)
        self.assertNotEqual(answer.returncode, 0)
        self.assertIn("unknown part or option fontain", answer.stderr)


if __name__ == "__main__":
    PROGRAMS = sys.argv.pop(1)
    unittest.main()
