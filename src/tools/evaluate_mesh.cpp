// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// evaluate_mesh: depth error and label scores of meshes against a dataset's ground truth.
#include <filesystem>
#include <iostream>
#include <set>
#include <string>
#include <vector>

#include "tool_main.h"

#include "facet_mapping/evaluation/report.h"
#include "facet_mapping/io/atomic_file.h"
#include "facet_mapping/io/ply.h"
#include "facet_mapping/io/progress_bar.h"

namespace {

using namespace facet_mapping;

struct Options {
  std::vector<std::string> paths;  ///< meshes, then the dataset
  std::string labels;
  std::string json;
  bool segmentation = false;
  std::size_t every = 1;
  std::vector<double> bounds;
  EvaluationOptions evaluation;
};

void add_selection(CLI::App& app, Options& options) {
  auto* views =
      app.add_option("--views", options.evaluation.views, "Views to look at, e.g. 0,10,20")
          ->delimiter(',');
  app.add_option("--every", options.every, "Look at every N-th view")
      ->check(CLI::PositiveNumber)
      ->excludes(views);
  app.add_flag("--hide-unlabelled",
               options.evaluation.hidden.unlabelled,
               "Take facets without a class away first");
  app.add_flag(
      "--hide-sky", options.evaluation.hidden.sky, "Take facets of sky classes away first");
  app.add_flag(
      "--keep-gaps{false}",
      options.evaluation.hidden.gaps,
      "Keep facets that only close the surface (views = 0); else they are taken away first");
}

void add_measures(CLI::App& app, Options& options) {
  DepthErrorOptions& depth = options.evaluation.depth;
  app.add_option("--max-depth", depth.max_depth_m, "Ignore ground truth beyond this, metres");
  app.add_option("--max-error",
                 depth.max_error_m,
                 "Leave larger errors out of mean, median and RMS, metres (fountain-P11: 0.1)");
  app.add_option("--bounds",
                 options.bounds,
                 "Error bounds whose shares are printed, metres (default: 0.05,0.1,0.2,0.5; "
                 "Strecha: a tenth of these)")
      ->delimiter(',');
  app.add_option("--relative-bounds", depth.relative_bounds, "The same as parts of the true depth")
      ->delimiter(',')
      ->capture_default_str();
  app.add_option("--min-class-pixels",
                 options.evaluation.min_class_pixels,
                 "Classes need more ground-truth pixels than this to enter the label means")
      ->capture_default_str();
  app.add_flag("--self-intersections",
               options.evaluation.self_intersections,
               "Count the pairs of facets that run through each other, too");
}

void add_options(CLI::App& app, Options& options) {
  app.add_option("MESH.ply... DATASET",
                 options.paths,
                 "One or several meshes, then the dataset folder (layouts below)")
      ->required()
      ->expected(2, 1000);
  add_selection(app, options);
  add_measures(app, options);
  app.add_option("--labels",
                 options.labels,
                 "Class list (YAML) for names and the sky flag; default: "
                 "the list in the first mesh that has one");
  app.add_flag("--segmentation",
               options.segmentation,
               "Score the dataset's segmentations too, as the first column");
  app.add_option("--json", options.json, "Write all scores, those of each view too, to this file");
  app.footer(
      "Depth is compared with the depth image of a view (gt_depth/, depth_gt/), or with its LiDAR "
      "scan\n"
      "where there is none; labels with gt_label/ or labels_gt/. With several meshes the last "
      "column is\n"
      "the change from the first to the last.\n\n" +
      dataset_layouts_help() +
      "\n\n"
      "Example: evaluate_mesh before.ply after.ply ~/kitti/drive --every 10 --max-depth 30");
}

std::vector<std::size_t> every_nth(std::size_t count, std::size_t step) {
  std::vector<std::size_t> views;
  for (std::size_t k = 0; k < count; k += step) {
    views.push_back(k);
  }
  return views;
}

// The stem where it tells the meshes apart, else the whole path.
std::vector<std::string> column_names(const std::vector<std::string>& meshes) {
  std::set<std::string> stems;
  std::vector<std::string> names;
  for (const std::string& mesh : meshes) {
    names.push_back(std::filesystem::path(mesh).stem().string());
    stems.insert(names.back());
  }
  return stems.size() == meshes.size() ? names : meshes;
}

void set_defaults(const Dataset& dataset, Options& options) {
  EvaluationOptions& evaluation = options.evaluation;
  if (!options.bounds.empty()) {
    evaluation.depth.absolute_bounds_m = options.bounds;
  } else if (!dataset.is_z_up) {
    evaluation.depth.absolute_bounds_m = {0.005, 0.01, 0.02, 0.05};
  }
  if (evaluation.views.empty()) {
    evaluation.views = every_nth(dataset.frames.size(), options.every);
  }
}

void run(Options& options) {
  const std::string folder = options.paths.back();
  const std::vector<std::string> meshes(options.paths.begin(), options.paths.end() - 1);
  const Dataset dataset = read_dataset(folder);
  set_defaults(dataset, options);
  LabelSet labels = options.labels.empty() ? LabelSet() : LabelSet::load(options.labels);
  const std::vector<std::string> names = column_names(meshes);
  std::vector<NamedEvaluation> evaluations;
  if (options.segmentation) {
    evaluations.push_back({"segmentation", evaluate_segmentation(dataset, options.evaluation)});
  }
  for (std::size_t k = 0; k < meshes.size(); ++k) {
    const MeshFile file = read_ply(meshes[k]);
    labels = labels.empty() ? file.labels : labels;
    ProgressBar bar(names[k]);
    evaluations.push_back(
        {names[k],
         evaluate_mesh(file.mesh,
                       labels,
                       dataset,
                       options.evaluation,
                       [&bar](std::size_t done, std::size_t total) { bar.update(done, total); })});
  }
  std::cout << evaluation_table(evaluations, options.evaluation.depth, labels);
  if (!options.json.empty()) {
    AtomicFile file(options.json);
    file.write(evaluation_json(evaluations, options.evaluation.depth, labels));
    file.commit();
  }
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app("Measures meshes against the ground truth of a dataset.", "evaluate_mesh");
  Options options;
  add_options(app, options);
  return run_tool(app, argc, argv, [&options] { run(options); });
}
