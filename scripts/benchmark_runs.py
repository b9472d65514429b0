"""The runs of scripts/benchmark, which is the one to call."""
import argparse
import json
import os
import statistics
import subprocess
import sys
import tempfile

from measuring import (evaluate, markdown_table, median_of, missing_data, run, say,
                       write_fountain_classes)


def table(title, header, rows):
    print("\n### %s\n\n%s" % (title, markdown_table(header, rows)), flush=True)


def google_benchmark(options, name):
    command = [os.path.join(options.programs, "benchmarks"), "--benchmark_filter=^%s/" % name,
               "--benchmark_format=json"]
    say("  " + " ".join(command))
    answer = subprocess.run(command, check=True, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL)
    entries = json.loads(answer.stdout)["benchmarks"]
    for entry in entries:
        if entry.get("error_occurred"):
            sys.exit("%s: %s" % (entry["name"], entry["error_message"]))
    return entries


def trace(options):
    rows = []
    for entry in google_benchmark(options, "trace/(100000|1000000)"):
        rows.append([entry["name"].split("/")[1], "%.0f" % entry["rays"],
                     "%.1f" % entry["cells_per_ray"], "%.1f" % (entry["cgal_cells_per_s"] / 1e6),
                     "%.1f" % (entry["singly_cells_per_s"] / 1e6),
                     "%.1f" % (entry["cells_per_s"] / 1e6), "**%.2f**" % entry["ratio"],
                     "%.0f" % entry["wrong_cells"]])
    table("Tracing, million cells a second of processor time",
          ["points", "rays", "cells a ray", "CGAL", "one walk", "walks by turns", "ratio to CGAL",
           "cells that differ"], rows)


def insert(options):
    # A process of its own for each size: the peak memory is the process's.
    rows = []
    for size in (100000, 1000000):
        entries = [google_benchmark(options, "insert/%d" % size)[0] for _ in range(options.repeats)]
        rows.append(["%d" % size, "%.0f" % entries[0]["rays"], "%.0f" % entries[0]["cells"]] +
                    ["%.1f" % (statistics.median(e[key] for e in entries) / 1e3)
                     for key in ("real_time", "cpu_time")] +
                    ["%.0f" % statistics.median(e["peak_mib"] for e in entries)])
    table("Insertion and tracing in one batch",
          ["points", "rays", "cells", "wall s", "processor s", "peak MiB"], rows)


def drive(options):
    for name, arguments in (("2000 keyframes, frozen beyond 60 m", ["2000", "60"]),
                            ("600 keyframes, 400 MiB", ["600", "60", "400"])):
        print("\n### A long street: %s\n" % name)
        sys.stdout.flush()
        command = [os.path.join(options.programs, "long_drive"), *arguments]
        say("  " + " ".join(command))
        subprocess.run(command, check=True)


def map_variants(options, folder, variants):
    """Runs each variant by turns; returns name -> (mesh, median costs)."""
    programs = {"": options.programs}
    if options.baseline:
        programs = {"baseline ": options.baseline, "": options.programs}
    runs = {}
    for _ in range(options.repeats):
        for name, arguments in variants.items():
            for prefix, where in programs.items():
                mesh = os.path.join(folder, (prefix + name).replace(" ", "_") + ".ply")
                cost = run([os.path.join(where, "map_bag"), arguments[0], mesh, *arguments[1:]])
                runs.setdefault(prefix + name, (mesh, []))[1].append(cost)
    return {name: (mesh, median_of(costs)) for name, (mesh, costs) in runs.items()}


def score_rows(scores, costs, unit, bounds):
    """One row per mesh; costs in ratio to the first that has any (or to its own baseline)."""
    rows = []
    first = next(iter(costs.values()))[1] if costs else None
    for score, name in zip(scores, [None] * (len(scores) - len(costs)) + list(costs)):
        depth = score["depth"]
        row = [name or score["name"], "%d" % score["facets"],
               "%.1f" % (100 * depth["completeness"]),
               "%.2f" % (depth["median_m"] * unit), "%.2f" % (depth["mae_m"] * unit),
               "%.2f" % (depth["rms_m"] * unit)]
        row += ["%.1f" % (100 * share) for share in depth["within_absolute"][:bounds]]
        if name:
            cost = costs[name][1]
            base = costs.get("baseline " + name, (None, first))[1]
            row += ["%.1f" % cost["wall"], "%.1f" % cost["cpu"], "%.2f" % (cost["cpu"] / base["cpu"]),
                    "%.0f" % cost["mib"]]
        else:
            row += ["-"] * 4
        rows.append(row)
    return rows


COST_HEADER = ["wall s", "processor s", "ratio", "peak MiB"]


def kitti(options):
    dataset = os.path.join(options.data, "kitti_drive_0009")
    with tempfile.TemporaryDirectory() as folder:
        variants = {"%s %s" % (source, cut): [dataset, "--points", source, "--extraction", cut]
                    for source in ("stereo", "lidar") for cut in ("graph_cut", "count")}
        costs = map_variants(options, folder, variants)
        scores = evaluate(options.programs, [mesh for mesh, _ in costs.values()], dataset,
                          ["--max-depth", "30"])
    table("KITTI drive 0009 against LiDAR nearer than 30 m (errors in mm)",
          ["mesh", "facets", "complete %", "median", "mean", "RMS", "5 cm %", "10 cm %", "20 cm %",
           "50 cm %"] + COST_HEADER, score_rows(scores, costs, 1e3, 4))


def fountain(options):
    dataset = os.path.join(options.data, "fountain_p11")
    start = os.path.join(dataset, "start_mesh.ply")
    with tempfile.TemporaryDirectory() as folder:
        labels = write_fountain_classes(os.path.join(folder, "classes.yaml"))
        common = [dataset, "--points-mesh", start, "--fit-scale", "--labels", labels]
        costs = map_variants(options, folder, {
            cut: common + ["--extraction", cut] for cut in ("graph_cut", "count")})
        scores = evaluate(options.programs, [start] + [mesh for mesh, _ in costs.values()], dataset,
                          ["--max-error", "0.1"])
    table("fountain-P11 against the laser scan (errors in mm below 100); start_mesh: OpenMVS from "
          "the same points",
          ["mesh", "facets", "complete %", "median", "mean", "RMS", "5 mm %", "10 mm %", "20 mm %",
           "50 mm %"] + COST_HEADER, score_rows(scores, costs, 1e3, 4))


PARTS = {"trace": (trace, None), "insert": (insert, None),
         "drive": (drive, None),
         "kitti": (kitti, "kitti_drive_0009"), "fountain": (fountain, "fountain_p11")}


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("parts", nargs="*")
    parser.add_argument("--programs", required=True)
    parser.add_argument("--data", required=True)
    parser.add_argument("--baseline")
    parser.add_argument("--repeats", type=int, default=3)
    options = parser.parse_args()
    for name in options.parts or PARTS:
        function, data = PARTS[name]
        reason = missing_data(options.data, data)
        if reason:
            print("\n%s: skipped, %s" % (name, reason))
            continue
        say(name)
        function(options)


if __name__ == "__main__":
    main()
