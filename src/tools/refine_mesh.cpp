// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// refine_mesh: a mesh and a dataset folder in, a refined, labelled mesh out.
#include <chrono>
#include <cstdint>
#include <cstdio>
#include <exception>
#include <map>
#include <string>
#include <vector>

#include "perturbation.h"
#include <CLI/CLI.hpp>

#include "facet_mapping/io/dataset.h"
#include "facet_mapping/io/ply.h"
#include "facet_mapping/labels/label_image.h"
#include "facet_mapping/refinement/refiner.h"

namespace {

using namespace facet_mapping;

struct Options {
  std::string mesh;
  std::string dataset;
  std::string output;
  std::string labels;
  std::size_t first = 0;
  std::size_t last = static_cast<std::size_t>(-1);
  std::size_t every = 1;
  bool right = false;
  bool no_photometric = false;
  bool no_relabel = false;
  double perturb_px = 0.0;
  std::uint64_t seed = 1;
  bool no_keep_quality = false;
  std::vector<double> box;  ///< mesh frame, metres
  RefinementConfig config;
};

void add_config_options(CLI::App* app, Options* options) {
  RefinementConfig& config = options->config;
  const std::map<std::string, SemanticMode> modes = {{"off", SemanticMode::kOff},
                                                     {"normal", SemanticMode::kNormal},
                                                     {"full", SemanticMode::kFull},
                                                     {"split", SemanticMode::kSplit},
                                                     {"pairwise", SemanticMode::kPairwise}};
  app->add_option("--levels", config.levels, "image pyramid levels")->capture_default_str();
  app->add_option("--iterations", config.iterations, "iterations per level")->capture_default_str();
  app->add_flag("--no-photometric", options->no_photometric, "leave the photometric flow out");
  app->add_option("--semantic", config.semantic, "off, normal, full, split or pairwise")
      ->transform(CLI::CheckedTransformer(modes));
  app->add_option("--semantic-weight", config.semantic_weight)->capture_default_str();
  app->add_option("--smoothing", config.smoothing, "umbrella weight")->capture_default_str();
  app->add_option("--thin-plate", config.thin_plate)->capture_default_str();
  app->add_option("--planar-smoothing", config.planar_smoothing, "factor on planar classes")
      ->capture_default_str();
  app->add_option("--ncc-window", config.ncc_window_px, "pixels, odd")->capture_default_str();
  app->add_option("--semantic-window", config.semantic_window_px, "pixels, odd")
      ->capture_default_str();
  app->add_option("--min-incidence-cos", config.min_incidence_cos)->capture_default_str();
  app->add_option("--pairs-per-view", config.pairs_per_view)->capture_default_str();
  app->add_option("--max-step", config.max_step_edge_fraction, "mean edge lengths")
      ->capture_default_str();
  app->add_option("--subdivide-px", config.subdivide_px, "largest facet, pixels")
      ->capture_default_str();
  const std::map<std::string, OrientationPrior> priors = {{"global", OrientationPrior::kGlobal},
                                                          {"mixture", OrientationPrior::kMixture},
                                                          {"local", OrientationPrior::kLocal}};
  app->add_option("--orientation-prior",
                  config.labeling.orientation_prior,
                  "of the labelling: global, mixture or local")
      ->transform(CLI::CheckedTransformer(priors));
  app->add_option("--normal-weight", config.labeling.normal_weight, "of that prior")
      ->capture_default_str();
  app->add_option("--local-facets", config.labeling.local_facets, "size of a neighbourhood of it")
      ->capture_default_str();
  app->add_flag("--no-relabel", options->no_relabel, "keep the facets' labels");
  app->add_flag("--no-keep-quality",
                options->no_keep_quality,
                "do not collapse and flip badly shaped facets");
  app->add_option("--box", options->box, "refine only this: MIN_X MIN_Y MIN_Z MAX_X MAX_Y MAX_Z")
      ->expected(6);
  app->add_option("--classes", config.part.classes, "refine only facets of these classes (ids)");
}

void add_options(CLI::App* app, Options* options) {
  app->add_option("mesh", options->mesh, "mesh to refine (PLY)")->required();
  app->add_option("dataset", options->dataset, "folder with images and poses (layouts below)")
      ->required();
  app->add_option("output", options->output, "refined mesh (PLY)")->required();
  app->add_option("--labels", options->labels, "class list (YAML); default: the mesh's own");
  app->add_option("--first", options->first, "first frame")->capture_default_str();
  app->add_option("--last", options->last, "last frame");
  app->add_option("--every", options->every, "use every n-th frame")
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
  app->add_flag("--right", options->right, "use the right images of a stereo pair too");
  app->add_option("--perturb-px",
                  options->perturb_px,
                  "first displace the vertices at random by this standard deviation, pixels of the "
                  "nearest view: how much a result depends on its start")
      ->check(CLI::Range(0.0, 100.0))
      ->capture_default_str();
  app->add_option("--seed", options->seed, "of --perturb-px")->capture_default_str();
  add_config_options(app, options);
  app->footer(dataset_layouts_help());
}

LabeledView read_view(const DatasetFrame& frame, const LabelSet& labels) {
  LabeledView view;
  view.view = frame.view;
  view.stamp = frame.stamp;
  view.gray = read_gray(frame.left_image);
  if (!frame.labels.empty()) {
    const cv::Mat ids = read_labels(frame.labels);
    view.labels = resize_label_image(
        labels.empty() ? ids : decode_label_image(ids, "mono16", labels), view.gray.size());
  }
  return view;
}

std::vector<LabeledView> read_views(const Options& options, const LabelSet& labels) {
  const Dataset dataset = read_dataset(options.dataset);
  std::vector<LabeledView> views;
  for (std::size_t k = options.first; k < dataset.frames.size() && k <= options.last;
       k += options.every) {
    const DatasetFrame& frame = dataset.frames[k];
    views.push_back(read_view(frame, labels));
    if (options.right && !frame.right_image.empty()) {
      DatasetFrame right = frame;
      right.left_image = frame.right_image;
      right.labels.clear();
      right.view.world_from_cam = frame.view.world_from_cam * dataset.right_from_left.inverse();
      views.push_back(read_view(right, labels));
    }
  }
  return views;
}

bool print_progress(const RefinementProgress& progress) {
  std::fprintf(stderr,
               "\r%3.0f %%  level %d iteration %d  photometric %.4f  semantic %.4f ",
               100.0 * progress.fraction,
               progress.level,
               progress.iteration + 1,
               progress.energy.photometric,
               progress.energy.semantic);
  return true;
}

void print_result(const RefinementResult& result, double seconds) {
  std::fprintf(stderr, "\n");
  std::printf("photometric %.5f -> %.5f\nsemantic %.5f -> %.5f\n",
              result.before.photometric,
              result.after.photometric,
              result.before.semantic,
              result.after.semantic);
  std::printf("facets %zu -> %zu, relabelled %zu, %.1f s\n",
              result.facets_before,
              result.facets_after,
              result.relabelled,
              seconds);
}

void run(Options options) {
  options.config.photometric = !options.no_photometric;
  if (!options.box.empty()) {
    const Eigen::Map<const Eigen::Matrix<double, 6, 1>> bounds(options.box.data());
    options.config.part.box = Eigen::AlignedBox3d(bounds.head<3>(), bounds.tail<3>());
    if (options.config.part.box.isEmpty()) {
      throw std::invalid_argument("--box: each minimum must be at most the maximum");
    }
  }
  options.config.relabel = !options.no_relabel;
  options.config.keep_quality = !options.no_keep_quality;
  MeshFile file = read_ply(options.mesh);
  if (!options.labels.empty()) {
    file.labels = LabelSet::load(options.labels);
  }
  const std::vector<LabeledView> views = read_views(options, file.labels);
  std::printf("%zu facets, %zu views\n", file.mesh.triangles.size(), views.size());
  if (options.perturb_px > 0.0) {
    perturb(views, options.perturb_px, options.seed, &file.mesh);
  }
  const auto start = std::chrono::steady_clock::now();
  RefinementResult result = refine(file.mesh, views, file.labels, options.config, print_progress);
  const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - start;
  print_result(result, seconds.count());
  file.mesh = std::move(result.mesh);
  write_ply(options.output, file);
}

}  // namespace

int main(int argc, char** argv) {
  Options options;
  CLI::App app("Refines a mesh by the images and segmentations of a dataset folder");
  add_options(&app, &options);
  CLI11_PARSE(app, argc, argv);
  try {
    run(options);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "refine_mesh: %s\n", error.what());
    return 1;
  }
  return 0;
}
