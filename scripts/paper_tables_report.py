"""What scripts/paper_tables writes: Markdown tables and plots (gnuplot) of the scores."""
import os
import statistics
import subprocess

from measuring import markdown_table

METHODS = ("initial mesh", "photometric only", "pairwise semantic", "proposed")
COLORS = ("#999999", "#4477aa", "#ee8833", "#228833")


def number(scores, path):
    """The value at "depth/mae_m" of a mesh's scores; None where it has none."""
    value = scores
    for key in path.split("/"):
        value = value.get(key) if isinstance(value, dict) else value[int(key)]
        if value is None:
            return None
    return value


def values_of(case, method, path):
    """One value for each seed."""
    values = [number(sample[method], path) for sample in case["samples"] if method in sample]
    return [value for value in values if value is not None]


def center(case, method, path):
    """From the given start where there is one, else the mean over the seeds."""
    if "given" in case:
        return number(case["given"].get(method, {}), path)
    values = values_of(case, method, path)
    return statistics.mean(values) if values else None


def spread(case, method, path):
    """Standard deviation over the seeds; None if there are fewer than two."""
    values = values_of(case, method, path)
    return statistics.stdev(values) if len(values) > 1 else None


def cell(case, method, path, pattern, scale):
    value, deviation = center(case, method, path), spread(case, method, path)
    if value is None:
        return "-"
    text = pattern % (scale * value)
    return text if deviation is None else text + " ± " + pattern % (scale * deviation)


def ratio(case, method, path):
    value, reference = center(case, method, path), center(case, "photometric only", path)
    return "-" if value is None or not reference else "%.3f" % (value / reference)


def rows_of(case):
    return list(case["given"] if "given" in case else case["samples"][0])


DEPTH_COLUMNS = (("facets", "facets", "%.0f", 1), ("complete %", "depth/completeness", "%.2f", 100),
                 ("MAE mm", "depth/mae_m", "%.2f", 1e3),
                 ("median mm", "depth/median_m", "%.2f", 1e3),
                 ("RMS mm", "depth/rms_m", "%.2f", 1e3),
                 ("MAE below 10 medians mm", "depth/trimmed_mae_m", "%.2f", 1e3))
SHARE_COLUMNS = tuple(("depth/within_absolute/%d" % k, "%.1f", 100) for k in range(4))
LABEL_COLUMNS = (("accuracy %", "labels/accuracy"), ("recall %", "labels/recall"),
                 ("F-score %", "labels/f_score"), ("precision %", "labels/precision"),
                 ("mIoU %", "labels/mean_iou"))


def share_names(case):
    bounds = ("5", "10", "20", "50") if case["key"].startswith("fountain") else \
        ("50", "100", "200", "500")
    return ["%s mm %%" % bound for bound in bounds]


def depth_table(case):
    header = ["method"] + [column[0] for column in DEPTH_COLUMNS] + share_names(case) + \
        ["MAE / photometric", "processor s"]
    rows = []
    for method in rows_of(case):
        if method == "segmentation":
            continue
        rows.append([method] + [cell(case, method, *column[1:]) for column in DEPTH_COLUMNS] +
                    [cell(case, method, *column) for column in SHARE_COLUMNS] +
                    [ratio(case, method, "depth/mae_m"), cell(case, method, "cpu_s", "%.1f", 1)])
    return markdown_table(header, rows)


def label_table(case):
    rows = [[method] + [cell(case, method, path, "%.2f", 100) for _, path in LABEL_COLUMNS]
            for method in rows_of(case) if center(case, method, "labels/accuracy") is not None]
    if not rows:
        return "No ground-truth labels."
    return markdown_table(["method"] + [name for name, _ in LABEL_COLUMNS], rows)


def paired_difference(case, path, pattern, scale):
    """Pairwise minus proposed on the same streets: what both have in common cancels."""
    pairs = zip(values_of(case, "pairwise semantic", path), values_of(case, "proposed", path))
    differences = [scale * (pairwise - proposed) for pairwise, proposed in pairs]
    text = pattern % statistics.mean(differences)
    if len(differences) > 1:
        text += " ± " + pattern % statistics.stdev(differences)
    return text


# Measure, path, factor, and the methods that have it.
NOISE_MEASURES = (
    ("depth MAE, mm", "depth/mae_m", 1e3, METHODS),
    ("depth MAE of errors below 10 medians, mm", "depth/trimmed_mae_m", 1e3, METHODS),
    ("label F-score, %", "labels/f_score", 1e2, ("segmentation",) + METHODS))


def noise_table(cases, title, path, scale, methods):
    rows = [["%g" % case["noise_level"]] +
            [cell(case, method, path, "%.2f", scale) for method in methods] +
            [paired_difference(case, path, "%+.2f", scale)] for case in cases]
    header = ["noise", *methods, "pairwise - proposed"]
    return "### %s\n\n%s" % (title, markdown_table(header, rows))


def bar(case, method, path, scale):
    """Height, lower and upper end of a bar with its spread."""
    value = scale * center(case, method, path)
    deviation = scale * (spread(case, method, path) or 0.0)
    return "%g %g %g" % (value, value - deviation, value + deviation)


def gnuplot(path, lines):
    script = "\n".join(lines) + "\n"
    subprocess.run(["gnuplot"], input=script.encode(), cwd=os.path.dirname(path), check=True)
    return path


def start_of_plot(path, width, height):
    return ["set terminal pngcairo size %d,%d font 'DejaVu Sans,11' noenhanced" % (width, height),
            "set output '%s'" % os.path.basename(path),
            "set grid ytics back lt 1 lw 1 lc rgb '#cccccc'",
            "set key outside top center horizontal maxrows 2", "set bmargin 4"]


def bar_chart(path, cases, methods, value_path, scale_of, title):
    """Groups of bars, a group for each case and a bar for each method."""
    lines = start_of_plot(path, 240 + 220 * len(cases), 520)
    lines.append("$bars << END")
    for case in cases:
        cells = [bar(case, method, value_path, scale_of(case)) for method in methods]
        lines.append('"%s" %s' % (case["title"].replace(", ", "\\n"), " ".join(cells)))
    lines += ["END", "set style data histograms", "set style histogram errorbars gap 1.5 lw 1",
              "set style fill solid", "set ylabel '%s'" % title, "set yrange [0:*]",
              "plot " + ", ".join(
                  "$bars using %d:%d:%d%s lc rgb '%s' title '%s'" %
                  (3 * k + 2, 3 * k + 3, 3 * k + 4, ":xtic(1)" if k == 0 else "",
                   color_of(method), method) for k, method in enumerate(methods))]
    return gnuplot(path, lines)


def color_of(method):
    return COLORS[METHODS.index(method)] if method in METHODS else "#222222"


def noise_panel(cases, name, title, path, scale, methods):
    """Data and plot command of a panel: a line for each method over the level of noise."""
    lines = ["$%s << END" % name]
    for case in cases:
        bars = [bar(case, method, path, scale) for method in methods]
        lines.append("%g %s" % (case["noise_level"], " ".join(bars)))
    # Beside each other, so that the bars of equal values are seen.
    shifts = [0.012 * (k - (len(methods) - 1) / 2) for k in range(len(methods))]
    style = "$%s using ($1+%g):%d:%d:%d with yerrorlines lw 2 pt 7 lc rgb '%s' title '%s'"
    styles = [style % (name, shift, 3 * k + 2, 3 * k + 3, 3 * k + 4, color_of(method), method)
              for k, (method, shift) in enumerate(zip(methods, shifts))]
    return lines + ["END", "set ylabel '%s'" % title, "plot " + ", ".join(styles)]


def noise_plot(path, cases):
    lines = start_of_plot(path, 1650, 520) + [
        "set multiplot layout 1,3", "set xlabel 'level of label noise'",
        "set xrange [-0.1:%g]" % (max(case["noise_level"] for case in cases) + 0.1)]
    for k, measure in enumerate(NOISE_MEASURES):
        lines += noise_panel(cases, "panel%d" % k, *measure)
    return gnuplot(path, lines)


def plots(output, tabled, noisy):
    files = [bar_chart(os.path.join(output, "depth_mae.png"), tabled, METHODS, "depth/mae_m",
                       lambda case: 100 / center(case, "initial mesh", "depth/mae_m"),
                       "depth MAE, % of the initial mesh")] if tabled else []
    labelled = [case for case in tabled
                if center(case, "segmentation", "labels/f_score") is not None]
    if labelled:
        files.append(bar_chart(os.path.join(output, "label_f_score.png"), labelled,
                               ("segmentation",) + METHODS, "labels/f_score", lambda case: 100,
                               "label F-score, %"))
    if noisy:
        files.append(noise_plot(os.path.join(output, "noise.png"), noisy))
    return files


INTRODUCTION = """# Depth errors and label scores of the four methods

Tables of Romanoni et al. 2017 (ICCV Workshops), made by `scripts/paper_tables`.

- *Initial mesh*: labelled, not refined; *photometric only*: Vu et al. 2012; *pairwise semantic*:
  Blaha et al. 2017; *proposed*: the single-view semantic term, defaults of `refine_mesh`;
  *segmentation*: the label images that all of them were given.
- After ± stands a standard deviation: of the data sets over perturbed starts (vertices displaced by
  a quarter of a pixel), while the value itself is from the start as given; of the street over
  streets, the value being their mean.
- Processor seconds are those of `refine_mesh`, reading and writing included.
"""


def sections(tabled, noisy, skipped, pictures):
    if tabled:
        for title, table in (("Table 1: depth", depth_table), ("Table 2: labels", label_table)):
            yield "## " + title
            for case in tabled:
                yield "### %s\n\n%s\n\n%s" % (case["title"], case["note"], table(case))
    if noisy:
        yield "## Label noise on the street"
        for measure in NOISE_MEASURES:
            yield noise_table(noisy, *measure)
    yield "\n".join("![%s](%s)" % (os.path.basename(path), os.path.basename(path))
                    for path in pictures)
    if skipped:
        yield "## Skipped\n\n" + "\n".join("- " + reason for reason in skipped)


def write(output, cases, skipped, quick):
    """Writes tables.md and the plots into a folder; returns their paths."""
    tabled = [case for case in cases if "noise_level" not in case]
    noisy = [case for case in cases if "noise_level" in case]
    pictures = plots(output, tabled, noisy)
    warning = ["**Quick run: a few frames only, these are no results.**"] if quick else []
    path = os.path.join(output, "tables.md")
    with open(path, "w") as file:
        file.write("\n\n".join([INTRODUCTION.rstrip(), *warning,
                                *sections(tabled, noisy, skipped, pictures)]) + "\n")
    return [path, *pictures]
