"""The tables of scripts/point_tables."""
import json
import os

from measuring import markdown_table

# As evaluate_points and map_bag call them.
SOURCES = ("stereo", "lidar", "tracks", "sweep")


def number(value, pattern="%.1f", scale=1.0):
    return "-" if value is None else pattern % (scale * value)


def percent(value):
    return number(value, "%.1f", 100.0)


def points_table(case):
    header = (["source", "points a frame"] +
              ["within %g %%" % (100 * bound) for bound in (0.01, 0.03, 0.05)] +
              ["median error mm", "1 σ", "2 σ", "errors / σ", "image cells", "classes",
               "processor ms an image", "points a processor second"])
    rows = []
    for one in case["sources"]:
        rows.append([one["name"], number(one["points_per_frame"], "%.0f"),
                     *(percent(share) for share in one["within_relative"]),
                     number(one["median_error_m"], "%.1f", 1e3),
                     percent(one["within_sigma"][0]), percent(one["within_sigma"][1]),
                     number(one["sigma_factor"], "%.2f"), percent(one["density"]),
                     percent(one["label_agreement"]),
                     number(one["processor_s_per_image"], "%.0f", 1e3),
                     number(one["points_per_processor_s"], "%.0f")])
    return markdown_table(header, rows)


def maps_name(case, names):
    return names[0] if len(names) == 1 else "all together"


def maps_table(case):
    header = ["sources", "facets", "complete %", "median mm", "mean mm", "within 10 cm %",
              "held out: complete %", "median mm", "mean mm", "within 10 cm %", "processor s",
              "peak MiB"]
    rows = []
    for one in case["maps"]:
        row = [maps_name(case, one["sources"]), "%d" % one["whole"]["facets"]]
        for kind in ("whole", "held_out"):
            depth = one[kind]["depth"]
            row += [percent(depth["completeness"]), number(depth["median_m"], "%.1f", 1e3),
                    number(depth["mae_m"], "%.0f", 1e3), percent(depth["within_absolute"][1])]
        rows.append(row + ["%.1f" % one["whole"]["cpu_s"], "%.0f" % one["whole"]["peak_mib"]])
    return markdown_table(header, rows)


POINTS_LEGEND = (
    "*within*: per cent of the compared points whose depth error is at most that part of the "
    "depth, each compared with the one pixel that it falls on. *1 σ, 2 σ*: per cent of errors "
    "below once and twice the stated standard deviation (Gaussian noise: 68.3, 95.4). *errors / "
    "σ*: median error over that of Gaussian noise of the stated size. *image cells*: per cent of "
    "the 16 px cells with ground truth that hold a point. *classes*: per cent of the points' "
    "classes that agree with the ground truth's, or with the segmentation where there is none "
    "(from which the points have theirs). Processor time is that of all threads, without reading "
    "files.")


def text_of(cases, skipped, quick):
    parts = ["# Sources of points"]
    if quick:
        parts.append("Quick run on a few frames: the numbers mean nothing.")
    if any(case["kind"] == "points" for case in cases):
        parts.append(POINTS_LEGEND)
    tables = {"points": points_table, "maps": maps_table}
    for case in cases:
        parts += ["## " + case["title"], case["note"], tables[case["kind"]](case)]
    if skipped:
        parts += ["## Skipped"] + ["- " + reason for reason in skipped]
    return "\n\n".join(parts) + "\n"


def write(folder, cases, skipped, quick):
    """Writes tables.md and scores.json; returns their paths."""
    paths = [os.path.join(folder, name) for name in ("tables.md", "scores.json")]
    with open(paths[0], "w", encoding="utf-8") as file:
        file.write(text_of(cases, skipped, quick))
    with open(paths[1], "w") as file:
        json.dump(cases, file, indent=1)
    return paths
