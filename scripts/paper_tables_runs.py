"""The runs of scripts/paper_tables, which is the one to call."""
import argparse
import json
import os
import tempfile

import paper_tables_report as report
from measuring import evaluate, run, run_parts, say, write_fountain_classes

# The paper's methods as options of refine_mesh.
METHODS = {"initial mesh": ["--iterations", "0"], "photometric only": ["--semantic", "off"],
           "pairwise semantic": ["--semantic", "pairwise"], "proposed": []}
# Standard deviation of the perturbed starts' vertices: well below what the refinement corrects.
PERTURBATION_PX = 0.25
NOISE_LEVELS = (0.0, 0.35, 0.7, 1.4, 2.8)
QUICK_NOISE_LEVELS = (0.0, 0.7)
TABLE_NOISE_LEVEL = 0.7  # of the street in the two tables


def refine(options, case, method, start, seed, mesh):
    """Refines one start; returns what it cost."""
    perturbed = ["--perturb-px", "%g" % PERTURBATION_PX, "--seed", "%d" % seed] if seed else []
    cost = run([os.path.join(options.programs, "refine_mesh"), start, case["dataset"], mesh,
                *case["refine"], *METHODS[method], *perturbed])
    return {"cpu_s": cost["cpu"], "wall_s": cost["wall"], "peak_mib": cost["mib"]}


def score_start(options, case, start, seed, folder):
    """All methods from one start: method -> scores; "segmentation" is the input's own."""
    meshes, costs = {}, {}
    for method in METHODS:
        meshes[method] = os.path.join(folder, method.replace(" ", "_") + ".ply")
        costs[method] = refine(options, case, method, start, seed, meshes[method])
    extra = {} if seed else case.get("peers", {})
    own = ["segmentation"] if case["has_label_truth"] else []
    arguments = case["evaluate"] + (["--segmentation"] if own else [])
    names = own + list(meshes) + list(extra)
    scores = evaluate(options.programs, [*meshes.values(), *extra.values()], case["dataset"],
                      arguments)
    assert len(scores) == len(names)
    for score in scores:
        del score["views"]
    return {name: {**score, **costs.get(name, {})} for name, score in zip(names, scores)}


def score_given_start(options, case, start):
    """Scores from the given start, and from seeded perturbations of it for the spread."""
    folder = os.path.join(options.output, "meshes", case["key"])
    os.makedirs(folder, exist_ok=True)

    def score(seed):
        if not seed:
            return score_start(options, case, start, 0, folder)
        with tempfile.TemporaryDirectory(dir=options.output) as scratch:
            return score_start(options, case, start, seed, scratch)

    case["given"], *case["samples"] = options.pool.map(score, range(options.seeds + 1))
    return case


def quick_frames(options, count):
    """Options of map_bag and refine_mesh, and of evaluate_mesh, for the first frames alone."""
    if not options.quick:
        return [], []
    return ["--last", "%d" % (count - 1)], ["--views", ",".join("%d" % k for k in range(count))]


def make_fountain(options, key, start, peer, title):
    dataset = os.path.join(options.data, "fountain_p11")
    with tempfile.TemporaryDirectory() as folder:
        labels = write_fountain_classes(os.path.join(folder, "classes.yaml"))
        frames, views = quick_frames(options, 4)
        case = {"key": key, "title": title, "dataset": dataset, "has_label_truth": True,
                "refine": ["--labels", labels, *frames],
                "evaluate": ["--labels", labels, "--max-error", "0.1", *views],
                "peers": {"OpenMVS RefineMesh": os.path.join(dataset, peer)},
                "note": "11 views at half size, laser ground truth, errors of 0.1 m and more left "
                        "out. The paper, from another start mesh: MAE 12.7, 9.2, 8.6, 8.5 mm."}
        return score_given_start(options, case, os.path.join(dataset, start))


def fountain(options, _):
    return [make_fountain(options, "fountain", "start_mesh_coarse.ply",
                          "peer_openmvs_refined_coarse.ply", "fountain-P11, coarse start mesh")]


def fountain_fine(options, _):
    return [make_fountain(options, "fountain_fine", "start_mesh.ply", "peer_openmvs_refined.ply",
                          "fountain-P11, whole start mesh")]


def make_kitti(options, name, case):
    dataset = os.path.join(options.data, name)
    frames, views = quick_frames(options, 4)
    case.update({"dataset": dataset, "refine": frames, "evaluate": ["--max-depth", "30", *views]})
    with tempfile.TemporaryDirectory(dir=options.output) as folder:
        start = os.path.join(folder, "start.ply")
        run([os.path.join(options.programs, "map_bag"), dataset, start, "--labels", options.labels,
             *frames])
        return score_given_start(options, case, start)


def kitti(options, _):
    note = ("51 frames, start mesh from stereo, against LiDAR nearer than 30 m. The paper, on "
            "drive 95: MAE 46.7, 32.8, 32.7, 32.7 mm.")
    return [make_kitti(options, "kitti_drive_0009",
                       {"key": "kitti", "title": "KITTI drive 0009", "has_label_truth": False,
                        "note": note})]


def kitti_labels(options, _):
    note = "Ten frames, start mesh from stereo, against LiDAR nearer than 30 m."
    return [make_kitti(options, "kitti_labels_03",
                       {"key": "kitti_labels", "title": "KITTI odometry 03, frames 0 to 9",
                        "has_label_truth": True, "note": note})]


def score_street(options, level, seed):
    """All methods on one street: its dataset, its map and what becomes of it."""
    with tempfile.TemporaryDirectory(dir=options.output) as folder:
        dataset = os.path.join(folder, "street")
        start = os.path.join(folder, "start.ply")
        run([os.path.join(options.programs, "street_to_bag"), dataset, "--no-bag", "--no-scans",
             "--frames", "4" if options.quick else "20", "--noise", "%g" % level,
             "--seed", "%d" % seed, "--noise-seed", "%d" % seed])
        run([os.path.join(options.programs, "map_bag"), dataset, start, "--labels",
             options.labels])
        case = {"dataset": dataset, "refine": [], "evaluate": ["--max-depth", "30"],
                "has_label_truth": True}
        return score_start(options, case, start, 0, folder)


def street_cases(options, levels, streets):
    """All seeds at levels of noise; `streets` keeps what was run, for another part."""
    seeds = range(1, max(options.seeds, 1) + 1)

    def score(key):
        say("street %d, label noise %g" % key[::-1])
        return score_street(options, *key)

    missing = [(level, seed) for level in levels for seed in seeds if (level, seed) not in streets]
    streets.update(zip(missing, options.pool.map(score, missing)))
    return [{"key": "street_%g" % level, "title": "Synthetic street, label noise %g" % level,
             "note": "Mean over streets of 20 frames, start mesh from stereo, exact ground truth "
                     "nearer than 30 m.",
             "samples": [streets[level, seed] for seed in seeds]} for level in levels]


def street(options, streets):
    return street_cases(options, [TABLE_NOISE_LEVEL], streets)


def noise(options, streets):
    levels = QUICK_NOISE_LEVELS if options.quick else NOISE_LEVELS
    return [dict(case, noise_level=level)
            for case, level in zip(street_cases(options, levels, streets), levels)]


PARTS = {"fountain": (fountain, "fountain_p11"), "fountain_fine": (fountain_fine, "fountain_p11"),
         "kitti": (kitti, "kitti_drive_0009"), "kitti_labels": (kitti_labels, "kitti_labels_03"),
         "street": (street, None), "noise": (noise, None)}


def parse_options():
    parser = argparse.ArgumentParser()
    parser.add_argument("parts", nargs="*")
    for name in ("--programs", "--data", "--labels", "--output"):
        parser.add_argument(name, required=True)
    parser.add_argument("--seeds", type=int, default=3)
    parser.add_argument("--jobs", type=int, default=1)
    parser.add_argument("--quick", action="store_true")
    options = parser.parse_args()
    if options.quick:
        options.seeds = 1
    return options


def main():
    options = parse_options()
    streets = {}

    def write(cases, skipped):
        with open(os.path.join(options.output, "scores.json"), "w") as file:
            json.dump(cases, file, indent=1)
        return report.write(options.output, cases, skipped, options.quick)

    run_parts(options, PARTS, lambda name: PARTS[name][0](options, streets), write)


if __name__ == "__main__":
    main()
