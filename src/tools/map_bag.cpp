// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// map_bag: a dataset folder in, a labelled mesh out, without a ROS graph and without losing a
// frame.
#include <chrono>
#include <iostream>
#include <limits>
#include <stdexcept>
#include <string>
#include <vector>

#include "carving_options.h"
#include "point_sources.h"
#include "tool_main.h"

#include "facet_mapping/io/atomic_file.h"
#include "facet_mapping/io/dataset.h"
#include "facet_mapping/io/ply.h"
#include "facet_mapping/io/progress_bar.h"
#include "facet_mapping/mapping/dataset_points.h"
#include "facet_mapping/mapping/labeled_map.h"
#include "facet_mapping/mapping/seen_points.h"
#include "facet_mapping/ros/file_paths.h"

namespace {

using namespace facet_mapping;

struct Options {
  std::string input;
  std::string output;
  std::vector<std::string> sources{"stereo"};
  std::string points_mesh;
  std::string labels;
  std::size_t first = 0;
  std::size_t last = std::numeric_limits<std::size_t>::max();
  std::size_t every = 1;
  bool drop_dynamic = false;
  bool fit_scale = false;
  DatasetPointsConfig points;
  SeenPointsConfig seen;
  MapConfig map;
};

void add_input_options(CLI::App& app, Options& options) {
  app.add_option("DATASET", options.input, "Dataset folder (layouts below)")->required();
  app.add_option("OUTPUT.ply", options.output, "Mesh to write (replaced if it exists)")->required();
  auto* source = add_points_option(app, options.sources)->capture_default_str();
  app.add_option(
         "--points-mesh",
         options.points_mesh,
         "Take the vertices of this mesh (PLY) as points; the frames that see them are found "
         "by drawing it")
      ->excludes(source);
  app.add_option("--labels",
                 options.labels,
                 "Class list: a path, or a shipped one such as cityscapes (default: cityscapes for "
                 "KITTI, else none: geometry without classes)");
  app.add_option("--first", options.first, "First frame, counted from 0")->capture_default_str();
  app.add_option("--last", options.last, "Last frame (default: the last there is)");
  app.add_option("--every", options.every, "Use every N-th frame")
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
}

void add_point_options(CLI::App& app, Options& options) {
  app.add_option("--min-range", options.map.min_range_m, "Nearer points are dropped, metres")
      ->capture_default_str();
  app.add_option("--max-range",
                 options.map.max_range_m,
                 "Farther points are dropped, metres (default 40; with --points-mesh no limit)");
  app.add_option("--voxel",
                 options.points.cloud_config.voxel_m,
                 "LiDAR: at most one point of a scan per cube of this size, metres; 0: all")
      ->capture_default_str();
  app.add_option("--lidar-sigma",
                 options.points.cloud_config.sigma_m,
                 "LiDAR: standard deviation of the points along their rays, metres")
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
  app.add_option("--cell",
                 options.points.stereo_config.cell_px,
                 "Stereo: at most one point per cell of this size, pixels")
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
  app.add_option("--nearest",
                 options.points.sweep_config.min_depth_m,
                 "Sweep: nearest depth, in the dataset's unit")
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
  app.add_option("--farthest",
                 options.points.sweep_config.max_depth_m,
                 "Sweep: farthest depth, in the dataset's unit")
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
  app.add_option("--point-sigma",
                 options.seen.sigma_m,
                 "Standard deviation of the points of --points-mesh along their rays, metres")
      ->check(CLI::NonNegativeNumber)
      ->capture_default_str();
  app.add_flag("--drop-dynamic", options.drop_dynamic, "Ignore points of classes that move");
  app.add_flag("--fit-scale",
               options.fit_scale,
               "Scale the lengths of the carving with the median edge of --points-mesh (options "
               "given beside it win)")
      ->needs("--points-mesh");
}

LabelSet read_label_set(const Options& options, const Dataset& dataset) {
  if (options.labels.empty()) {
    return dataset.is_z_up ? LabelSet::load(label_file_path("cityscapes")) : LabelSet();
  }
  return LabelSet::load(label_file_path(options.labels));
}

/// Counts over all frames.
struct Totals {
  std::size_t frames = 0;
  std::size_t clouds = 0;
  std::size_t used = 0;
  std::size_t out_of_range = 0;
  std::size_t unknown_label = 0;
  std::size_t dynamic_dropped = 0;
  std::size_t still = 0;     // images without parallax
  std::size_t restarts = 0;  // of the feature tracks or the plane sweep

  void add(const FrameReport& report) {
    ++clouds;
    used += report.used;
    out_of_range += report.out_of_range;
    unknown_label += report.unknown_label;
    dynamic_dropped += report.dynamic_dropped;
  }
};

template <typename AddFrame>
Totals for_each_frame(const Options& options, const Dataset& dataset, const AddFrame& add_frame) {
  Totals totals;
  const std::size_t end = end_frame(dataset, options.first, options.last);
  ProgressBar bar("points");
  for (std::size_t k = options.first; k < end; k += options.every) {
    add_frame(k, &totals);
    ++totals.frames;
    bar.update(k + 1 - options.first, end - options.first);
  }
  bar.update(1, 1);
  return totals;
}

Totals add_sensor_points(const Options& options, const Dataset& dataset, LabeledMap* map) {
  const DatasetPointsConfig config = with_sources(options.points, options.sources);
  DatasetPoints points(dataset, map->labels(), config);
  const auto add_all = [map](const std::vector<SensorPoints>& all, Totals* totals) {
    for (const SensorPoints& sensor : all) {
      totals->add(map->add(sensor.frame, sensor.sensor));
    }
  };
  Totals sums = for_each_frame(options, dataset, [&](std::size_t k, Totals* totals) {
    add_all(points.read(k), totals);
    TrackReport tracks;
    SweepReport sweep;
    add_all(points.follow(k, &tracks, &sweep), totals);
    totals->still += tracks.still || sweep.still ? 1 : 0;
    totals->restarts += tracks.restarted || sweep.restarted ? 1 : 0;
  });
  add_all(points.finish(), &sums);
  return sums;
}

Totals add_mesh_points(const Options& options,
                       const Dataset& dataset,
                       const TriangleMesh& mesh,
                       LabeledMap* map) {
  SeenPoints points(mesh, options.seen);
  const Totals totals = for_each_frame(options, dataset, [&](std::size_t k, Totals* sums) {
    const DatasetFrame& frame = dataset.frames[k];
    sums->add(map->add(points.seen_from(frame.view, frame_label_image(frame, map->labels()))));
  });
  if (points.unseen() > 0) {
    std::cerr << points.unseen() << " of " << mesh.vertices.size()
              << " vertices are seen from no frame and were left out\n";
  }
  return totals;
}

void print_totals(const Totals& totals) {
  std::cout << totals.frames << " frames, " << totals.used << " rays";
  const auto say = [](std::size_t count, const char* what) {
    if (count > 0) {
      std::cout << ", " << count << ' ' << what;
    }
  };
  say(totals.out_of_range, "points out of range");
  say(totals.unknown_label, "points of unknown classes");
  say(totals.dynamic_dropped, "points of moving things dropped");
  say(totals.still, "images without parallax left out");
  say(totals.restarts, "restarts (a jump of the pose, another image size, time going back)");
  std::cout << '\n';
  if (totals.used == 0) {
    throw std::runtime_error(
        "not one point could be used: look at the range limits, the images and the calibration");
  }
}

void print_map(const LabeledMap& map, double seconds) {
  const CarvingStats stats = map.stats();
  std::cout << stats.vertices << " vertices and " << stats.cells << " cells; the surface encloses "
            << stats.reached_cells << " of " << stats.free_cells << " free cells and has "
            << map.mesh().triangles.size() << " facets; carved in " << seconds << " s\n";
}

void carve(const Options& options, LabeledMap* map) {
  std::cerr << "carving ..." << std::endl;
  const auto start = std::chrono::steady_clock::now();
  map->update();
  print_map(*map, std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count());
  if (map->mesh().empty()) {
    throw std::runtime_error("the map has no surface: too few points, or all in one plane");
  }
  write_ply(options.output, {map->mesh(), map->labels(), "map"});
}

void run(const CLI::App& app, Options& options) {
  if (options.input.size() > 4 && options.input.substr(options.input.size() - 4) == ".bag") {
    throw std::invalid_argument(
        "bags are not read yet: give the folder that the bag was made of, or play the bag to the "
        "mapper node");
  }
  temporary_beside(options.output);  // a path that cannot be written is noticed before the work
  const Dataset dataset = read_dataset(options.input);
  const bool has_mesh = !options.points_mesh.empty();
  const TriangleMesh mesh = has_mesh ? read_ply(options.points_mesh).mesh : TriangleMesh();
  options.map.keyframe_translation_m = 0.0;  // every frame counts
  options.map.keyframe_rotation_deg = 0.0;
  options.map.dynamic = options.drop_dynamic ? DynamicPolicy::kDrop : DynamicPolicy::kKeep;
  if (has_mesh && app.count("--max-range") == 0) {
    options.map.max_range_m = std::numeric_limits<float>::max();
  }
  if (options.fit_scale) {
    fit_scale(app, median_edge(mesh), &options.map.carving);
  }
  print_config(options.map.carving);
  LabeledMap map(read_label_set(options, dataset), options.map);
  print_totals(has_mesh ? add_mesh_points(options, dataset, mesh, &map)
                        : add_sensor_points(options, dataset, &map));
  carve(options, &map);
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app("Maps a recorded drive into a labelled mesh, offline.", "map_bag");
  Options options;
  add_input_options(app, options);
  add_point_options(app, options);
  add_carving_options(app, options.map.carving);
  app.footer(
      dataset_layouts_help() +
      "\n\nExamples:\n"
      "  map_bag ~/kitti/2011_09_26/2011_09_26_drive_0009_sync map.ply --points stereo,lidar\n"
      "  map_bag ~/strecha/fountain_p11 map.ply --points-mesh dense.ply --fit-scale");
  return run_tool(app, argc, argv, [&] { run(app, options); });
}
