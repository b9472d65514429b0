"""The runs of scripts/point_tables, which is the one to call."""
import argparse
import json
import os
import tempfile

import point_tables_report as report
from measuring import evaluate, run, run_parts, write_fountain_classes

KITTI, FOUNTAIN = "kitti_drive_0009", "fountain_p11"
MAX_DEPTH_M = "30"  # of the maps' ground truth
QUICK_FRAMES = 6
EVERY = 2  # held-out maps are of every second frame; the frames between judge them


def program(options, name):
    return os.path.join(options.programs, name)


def points_of(options, dataset, source, arguments):
    """The scores of one source as evaluate_points gives them."""
    with tempfile.TemporaryDirectory() as folder:
        path = os.path.join(folder, "scores.json")
        frames = ["--frames", ":%d" % (QUICK_FRAMES - 1)] if options.quick else []
        run([program(options, "evaluate_points"), dataset, "--points", source, "--json", path,
             *frames, *arguments])
        with open(path) as file:
            return json.load(file)["sources"][0]


def sources_of(folder):
    """The sources that a dataset folder (of the two layouts used here) can give."""
    there = {"stereo": "right", "lidar": "velodyne"}
    return [name for name in report.SOURCES
            if name not in there or os.path.isdir(os.path.join(folder, there[name]))]


def score_points(options, name, arguments):
    dataset = os.path.join(options.data, name)
    return list(options.pool.map(
        lambda source: points_of(options, dataset, source, arguments), sources_of(dataset)))


def kitti(options):
    return {"title": "KITTI drive 0009 against LiDAR", "kind": "points",
            "sources": score_points(options, KITTI, ["--labels", options.labels]),
            "note": "Stereo and images against the LiDAR depth of their own frame; LiDAR against "
                    "that of the next frame, carried over by the poses, with errors of the poses, "
                    "the other scan's noise and what moved in between."}


def fountain(options):
    with tempfile.TemporaryDirectory() as folder:
        labels = write_fountain_classes(os.path.join(folder, "classes.yaml"))
        return {"title": "fountain-P11 against the laser model", "kind": "points",
                "sources": score_points(options, FOUNTAIN, ["--labels", labels]),
                "note": "11 views at half size (1536x1024). The ground truth has steps of 4 to "
                        "8 mm."}


def map_of(options, dataset, names, arguments, mesh):
    cost = run([program(options, "map_bag"), dataset, mesh, "--points", ",".join(names),
                "--labels", options.labels, *arguments])
    return {"cpu_s": cost["cpu"], "peak_mib": cost["mib"]}


def score_map(options, dataset, names, frames):
    """A map of all frames against all, and one of every second frame against those between."""
    key = "_".join(names)
    meshes = {"whole": os.path.join(options.meshes, key + ".ply"),
              "held_out": os.path.join(options.meshes, key + "_held_out.ply")}
    last = ["--last", "%d" % (frames - 1)] if options.quick else []
    views = {"whole": ",".join("%d" % k for k in range(frames)),
             "held_out": ",".join("%d" % k for k in range(1, frames - 1, EVERY))}
    steps = {"whole": [], "held_out": ["--every", "%d" % EVERY]}
    result = {"sources": names}
    for kind, mesh in meshes.items():
        cost = map_of(options, dataset, names, [*last, *steps[kind]], mesh)
        scores = evaluate(options.programs, [mesh], dataset,
                          ["--max-depth", MAX_DEPTH_M, "--views", views[kind]])[0]
        del scores["views"], scores["areas"]
        result[kind] = {**scores, **cost}
    draw(options, dataset, meshes["whole"], key, frames)
    return result


def draw(options, dataset, mesh, key, frames):
    view = "%d" % (frames // 2)
    pictures = {"shaded": ["--view", view], "error": ["--view", view, "--mode", "error"],
                "bird": ["--bird", "--mode", "labels"]}
    for name, arguments in pictures.items():
        picture = os.path.join(options.output, "%s_%s.png" % (key, name))
        run([program(options, "render_mesh"), mesh, "-o", picture, "--dataset", dataset,
             "--legend", *arguments])


def maps(options):
    dataset = os.path.join(options.data, KITTI)
    count = len(os.listdir(os.path.join(dataset, "left")))
    frames = min(count, QUICK_FRAMES) if options.quick else count
    sources = sources_of(dataset)
    choices = [[name] for name in sources] + ([sources] if len(sources) > 1 else [])
    options.meshes = os.path.join(options.output, "meshes")
    os.makedirs(options.meshes, exist_ok=True)
    return {"title": "Maps of KITTI drive 0009 from each source alone and from all together",
            "kind": "maps", "maps": list(options.pool.map(
                lambda names: score_map(options, dataset, names, frames), choices)),
            "note": "%d frames, ground truth nearer than %s m. *Held out*: a map of every second "
                    "frame against the ground truth of the frames between, which is what makes "
                    "maps with LiDAR comparable: whole maps hold the very points that they are "
                    "compared with." % (frames, MAX_DEPTH_M)}


PARTS = {"kitti": (kitti, KITTI), "fountain": (fountain, FOUNTAIN), "map": (maps, KITTI)}


def parse_options():
    parser = argparse.ArgumentParser()
    parser.add_argument("parts", nargs="*")
    for name in ("--programs", "--data", "--labels", "--output"):
        parser.add_argument(name, required=True)
    parser.add_argument("--jobs", type=int, default=1)
    parser.add_argument("--quick", action="store_true")
    return parser.parse_args()


def main():
    options = parse_options()
    run_parts(options, PARTS, lambda name: [{"key": name, **PARTS[name][0](options)}],
              lambda cases, skipped: report.write(options.output, cases, skipped, options.quick))


if __name__ == "__main__":
    main()
