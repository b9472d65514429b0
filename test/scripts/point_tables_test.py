#!/usr/bin/python3
# SPDX-FileCopyrightText: facet_mapping contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""scripts/point_tables: its tables, and the whole command on a few frames of a synthetic street.
Usage: point_tables_test.py FOLDER_OF_PROGRAMS"""
import json
import os
import subprocess
import sys
import tempfile
import unittest

ROOT = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..")
SCRIPTS = os.path.join(ROOT, "scripts")
sys.path.insert(0, SCRIPTS)
import point_tables_report as report  # noqa: E402


def source(name, **more):
    return dict({"name": name, "points_per_frame": 1234.4, "within_relative": [0.5, 0.75, 1.0],
                 "median_error_m": 0.1234, "within_sigma": [0.68, 0.95, 0.99],
                 "sigma_factor": 1.1, "density": 0.3, "label_agreement": 0.9,
                 "processor_s_per_image": 0.2, "points_per_processor_s": 6172.4}, **more)


def rows(table):
    return [[cell.strip() for cell in line.strip("|").split("|")] for line in table.splitlines()]


class Report(unittest.TestCase):
    def test_points(self):
        header, _, first, second = rows(report.points_table(
            {"sources": [source("stereo"), source("tracks", label_agreement=None)]}))
        self.assertEqual(len(header), len(first))
        self.assertEqual(first[:6], ["stereo", "1234", "50.0", "75.0", "100.0", "123.4"])
        self.assertEqual(first[header.index("processor ms an image")], "200")
        self.assertEqual(first[-1], "6172")
        self.assertEqual(second[header.index("classes")], "-")

    def test_maps(self):
        depth = {"completeness": 0.5, "median_m": 0.01, "mae_m": 0.2,
                 "within_absolute": [0.1, 0.2, 0.3, 0.4]}
        one = {"facets": 10, "depth": depth, "cpu_s": 1.25, "peak_mib": 7.0}
        held_out = dict(one, depth=dict(depth, mae_m=0.4))
        header, _, first, second = rows(report.maps_table({"maps": [
            {"sources": ["stereo"], "whole": one, "held_out": held_out},
            {"sources": ["stereo", "lidar"], "whole": one, "held_out": held_out}]}))
        self.assertEqual(len(header), len(first))
        self.assertEqual(first[:6], ["stereo", "10", "50.0", "10.0", "200", "20.0"])
        self.assertEqual(first[8], "400")
        self.assertEqual(second[0], "all together")

    def test_what_was_skipped_is_said(self):
        self.assertIn("- kitti: not there", report.text_of([], ["kitti: not there"], False))


class Command(unittest.TestCase):
    def run_parts(self, folder, *parts):
        """--data is FOLDER/data."""
        return subprocess.run(
            ["/usr/bin/python3", os.path.join(SCRIPTS, "point_tables_runs.py"), "--programs",
             PROGRAMS, "--data", os.path.join(folder, "data"), "--labels",
             os.path.join(ROOT, "config", "labels", "cityscapes.yaml"), "--output", folder,
             "--quick", *parts], text=True, capture_output=True, timeout=500)

    def test_the_street_in_place_of_the_drive(self):
        with tempfile.TemporaryDirectory() as folder:
            subprocess.run([os.path.join(PROGRAMS, "street_to_bag"),
                            os.path.join(folder, "data", "kitti_drive_0009"), "--no-bag",
                            "--frames", "7"], check=True, capture_output=True)
            answer = self.run_parts(folder)
            self.assertEqual(answer.returncode, 0, answer.stderr)
            tables, scores = answer.stdout.split()
            with open(tables, encoding="utf-8") as file:
                text = file.read()
            self.assertIn("Quick run", text)
            self.assertIn("fountain: the data set fountain_p11 is not in", text)
            self.assertIn("| all together |", text)
            with open(scores) as file:
                points, maps = json.load(file)
            self.check_points(points)
            self.check_maps(maps)
            self.check_pictures(folder)

    def check_points(self, case):
        self.assertEqual([one["name"] for one in case["sources"]], list(report.SOURCES))
        for one in case["sources"]:
            self.assertGreater(one["points_per_frame"], 100, one["name"])
            self.assertGreater(one["within_relative"][2], 0.8, one["name"])
            self.assertGreater(one["processor_s"], 0.0)
            self.assertEqual(one["images"], 6)
        depths = {one["name"]: one["depths"] for one in case["sources"]}
        self.assertEqual(depths["lidar"], "next frame")  # never with itself
        self.assertEqual(depths["stereo"], "own frame")

    def check_maps(self, case):
        self.assertEqual([one["sources"] for one in case["maps"]],
                         [[name] for name in report.SOURCES] + [list(report.SOURCES)])
        for one in case["maps"]:
            self.assertGreater(one["whole"]["depth"]["completeness"], 0.3, one["sources"])
            # Held out: frames 1 and 3 of 6 judge a map of frames 0, 2 and 4.
            self.assertEqual(one["held_out"]["depth_image_views"], 2)
            self.assertLess(one["held_out"]["facets"], one["whole"]["facets"])

    def check_pictures(self, folder):
        for name in ["stereo", "lidar", "tracks", "_".join(report.SOURCES)]:
            for style in ("shaded", "error", "bird"):
                path = os.path.join(folder, "%s_%s.png" % (name, style))
                self.assertGreater(os.path.getsize(path), 1000, path)

    def test_nothing_to_run_is_an_error_with_a_reason(self):
        with tempfile.TemporaryDirectory() as folder:
            answer = self.run_parts(folder, "fountain")
            self.assertNotEqual(answer.returncode, 0)
            self.assertIn("fountain_p11 is not in", answer.stderr)

    def test_unknown_parts_are_refused(self):
        answer = subprocess.run([os.path.join(SCRIPTS, "point_tables"), "fontain"], text=True,
                                capture_output=True, timeout=60)
        self.assertNotEqual(answer.returncode, 0)
        self.assertIn("unknown part or option fontain", answer.stderr)


if __name__ == "__main__":
    PROGRAMS = sys.argv.pop(1)
    unittest.main()
