"""What scripts/benchmark, scripts/paper_tables and scripts/point_tables share: running programs and scoring meshes."""
import concurrent.futures
import json
import os
import statistics
import subprocess
import sys
import tempfile
import time

FOUNTAIN_CLASSES = ("ground", "wall", "fountain", "building")


def say(text):
    print(text, file=sys.stderr, flush=True)


def run(command):
    """Runs a program; returns wall seconds, processor seconds and peak memory in MiB."""
    say("  " + " ".join(command))
    with tempfile.TemporaryFile() as output:
        start = time.monotonic()
        process = subprocess.Popen(command, stdout=output, stderr=subprocess.STDOUT)
        _, status, usage = os.wait4(process.pid, 0)
        wall = time.monotonic() - start
        process.returncode = os.waitstatus_to_exitcode(status)
        if process.returncode != 0:
            output.seek(0)
            sys.exit("%s failed:\n%s" % (command[0], output.read().decode(errors="replace")))
    return {"wall": wall, "cpu": usage.ru_utime + usage.ru_stime, "mib": usage.ru_maxrss / 1024.0}


def median_of(runs):
    return {key: statistics.median(one[key] for one in runs) for key in runs[0]}


def markdown_table(header, rows):
    lines = ["| %s |" % " | ".join(header), "|" + "---|" * len(header)]
    return "\n".join(lines + ["| %s |" % " | ".join(row) for row in rows])


def evaluate(programs, meshes, dataset, arguments):
    """The scores of meshes as evaluate_mesh gives them, in the order of the meshes."""
    with tempfile.TemporaryDirectory() as folder:
        path = os.path.join(folder, "scores.json")
        run([os.path.join(programs, "evaluate_mesh"), *meshes, dataset, "--json", path,
             *arguments])
        with open(path) as file:
            return json.load(file)["meshes"]


def write_fountain_classes(path):
    with open(path, "w") as file:
        file.write("classes:\n" + "".join(
            "  - {id: %d, name: %s, color: [%d, 90, 90]}\n" % (k, name, 60 * k)
            for k, name in enumerate(FOUNTAIN_CLASSES)))
    return path


def missing_data(data, name):
    """Why a data set cannot be used; empty if it is there or none is needed."""
    if name is None or os.path.isdir(os.path.join(data, name)):
        return ""
    return "the data set %s is not in %s (set FACET_MAPPING_DATA)" % (name, data)


def run_parts(options, parts, run, write):
    """Runs the chosen parts that have their data: `run(name)` gives cases, `write(cases, skipped)`
    the files, which are printed at the end. `parts`: name -> (function, data set or None)."""
    os.makedirs(options.output, exist_ok=True)
    options.pool = concurrent.futures.ThreadPoolExecutor(options.jobs)
    reasons = {name: missing_data(options.data, parts[name][1]) for name in options.parts or parts}
    skipped = ["%s: %s" % one for one in reasons.items() if one[1]]
    for reason in skipped:
        say("skipped " + reason)
    cases, files = [], []
    for name in (name for name, reason in reasons.items() if not reason):
        say(name)
        cases += run(name)
        # After each part, so that a run cut short leaves what it has.
        files = write(cases, skipped)
    if not cases:
        sys.exit("nothing was run")
    for path in files:
        print(path)
