// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// train_segmenter: a few label images in, a forest for the segmenter node out.
#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <limits>
#include <stdexcept>
#include <string>
#include <vector>

#include "tool_main.h"
#include <opencv2/imgcodecs.hpp>

#include "facet_mapping/evaluation/label_scores.h"
#include "facet_mapping/io/dataset.h"
#include "facet_mapping/labels/label_image.h"
#include "facet_mapping/segmentation/forest_segmenter.h"
#include "facet_mapping/segmentation/forest_training.h"

namespace {

using namespace facet_mapping;

struct Options {
  std::string dataset;
  std::string output;
  std::string labels;
  std::vector<std::size_t> views;
  bool from_segmentation = false;
  bool evaluate = false;
  double ground_m = std::numeric_limits<double>::quiet_NaN();
  std::string pictures;
  ForestTrainingConfig training;
  ForestSegmenterConfig segmenter;
};

void add_training_options(CLI::App& app, Options& options) {
  ForestTrainingConfig& training = options.training;
  app.add_option("--trees", training.trees)->capture_default_str();
  app.add_option("--max-depth", training.max_depth, "Of a tree")->capture_default_str();
  app.add_option("--min-leaf-samples", training.min_leaf_samples, "Cells that may be split")
      ->capture_default_str();
  app.add_option("--max-samples", training.max_samples, "Cells to train on, drawn at random")
      ->capture_default_str();
  app.add_option("--class-balance",
                 training.class_balance,
                 "0: classes as frequent as in the images, 1: all alike")
      ->capture_default_str();
  app.add_option(
         "--working-width", training.cells.working_width, "Images are resized to it, pixels")
      ->capture_default_str();
  app.add_option("--cell", training.cells.cell_px, "Edge of a cell, pixels of the resized image")
      ->capture_default_str();
  auto* pose = app.add_flag("--use-pose",
                            training.cells.use_view,
                            "Features of the camera's pose, too (the node has none)");
  app.add_option("--ground", options.ground_m, "Height of the ground in the poses' frame, metres")
      ->needs(pose);
  app.add_option("--seed", training.seed)->capture_default_str();
}

void add_options(CLI::App& app, Options& options) {
  app.add_option("DATASET", options.dataset, "Folder with images, poses and labels (layouts below)")
      ->required();
  app.add_option("OUT.forest", options.output, "The model to write")->required();
  app.add_option("--labels", options.labels, "Class list (YAML) of the label images")->required();
  app.add_option("--views", options.views, "Frames to train on, e.g. 0,5; default: all")
      ->delimiter(',');
  app.add_flag("--from-segmentation",
               options.from_segmentation,
               "Train on segmentation/ or labels/ instead of the ground truth");
  app.add_flag("--evaluate",
               options.evaluate,
               "Then label the other frames and compare them with the ground truth");
  app.add_option("--pictures", options.pictures, "Folder for coloured pictures of these labels")
      ->needs("--evaluate");
  app.add_option("--smoothing", options.segmenter.smoothing_cells, "Radius, cells (evaluation)")
      ->capture_default_str();
  app.add_option("--smoothing-edge", options.segmenter.smoothing_edge, "Grey step (evaluation)")
      ->capture_default_str();
  add_training_options(app, options);
  app.footer(dataset_layouts_help() +
             "\n\nExample: train_segmenter fountain_p11 fountain.forest --labels fountain.yaml "
             "--views 0,5 --evaluate");
}

/// Up in the frame of the poses: z of a map, else what the images call up on average.
Eigen::Vector3d up_of(const Dataset& dataset) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (const DatasetFrame& frame : dataset.frames) {
    sum -= frame.view.world_from_cam.linear().col(1);
  }
  return dataset.is_z_up ? Eigen::Vector3d::UnitZ() : Eigen::Vector3d(sum.normalized());
}

GroundView ground_view(const Dataset& dataset, std::size_t frame, const Options& options) {
  constexpr double kUsualCameraHeightM = 1.65;
  GroundView ground{dataset.frames[frame].view, up_of(dataset), options.ground_m};
  if (std::isnan(options.ground_m)) {
    ground.ground_m = ground.up.dot(ground.view.center()) - kUsualCameraHeightM;
  }
  return ground;
}

cv::Mat read_ids(const std::string& path, const LabelSet& labels, const cv::Size& size) {
  LabelImageReport report;
  const cv::Mat ids = decode_label_image(read_labels(path), "mono16", labels, &report);
  if (!report.clean()) {
    std::fprintf(stderr, "%s: %s\n", path.c_str(), report.to_string().c_str());
  }
  return resize_label_image(ids, size);
}

TrainingImage read_image(const Dataset& dataset,
                         std::size_t frame,
                         const LabelSet& labels,
                         const Options& options) {
  const DatasetFrame& files = dataset.frames[frame];
  const std::string& path = options.from_segmentation ? files.labels : files.gt_labels;
  if (path.empty()) {
    throw std::runtime_error("Frame " + std::to_string(frame) + " of '" + options.dataset +
                             "' has no label image; choose others with --views, or "
                             "--from-segmentation");
  }
  TrainingImage image;
  image.bgr = read_color(files.left_image);
  image.labels = read_ids(path, labels, image.bgr.size());
  image.ground = ground_view(dataset, frame, options);
  return image;
}

void print_scores(const LabelScores& scores, const LabelSet& labels) {
  std::printf("accuracy %.4f  recall %.4f  F-score %.4f  precision %.4f  mIoU %.4f\n",
              scores.accuracy,
              scores.recall,
              scores.f_score,
              scores.precision,
              scores.mean_iou);
  std::printf("(%zu pixels, means over %zu classes)\n", scores.pixels, scores.counted_classes);
  for (const ClassScores& c : scores.classes) {
    std::printf("  %-16s recall %.4f  precision %.4f  IoU %.4f  %zu pixels\n",
                labels.name_of(c.id).c_str(),
                c.recall,
                c.precision,
                c.iou,
                c.truth_pixels);
  }
}

void write_picture(const cv::Mat& ids,
                   const LabelSet& labels,
                   std::size_t frame,
                   const std::string& folder) {
  std::filesystem::create_directories(folder);
  char name[32];
  std::snprintf(name, sizeof(name), "/%06zu.png", frame);
  if (!cv::imwrite(folder + name, color_label_image(ids, labels))) {
    throw std::runtime_error("The picture '" + folder + name + "' cannot be written");
  }
}

void evaluate(const Dataset& dataset, const LabelSet& labels, const Options& options) {
  ForestSegmenter segmenter(load_forest(options.output), labels, options.segmenter);
  ConfusionMatrix confusion;
  std::size_t views = 0;
  std::chrono::duration<double> seconds{0.0};
  for (std::size_t k = 0; k < dataset.frames.size(); ++k) {
    const bool trained = std::count(options.views.begin(), options.views.end(), k) > 0;
    if (trained || dataset.frames[k].gt_labels.empty()) {
      continue;
    }
    const cv::Mat bgr = read_color(dataset.frames[k].left_image);
    const auto start = std::chrono::steady_clock::now();
    const cv::Mat ids = segmenter.segment(bgr, ground_view(dataset, k, options));
    seconds += std::chrono::steady_clock::now() - start;
    confusion.add(ids, read_ids(dataset.frames[k].gt_labels, labels, bgr.size()));
    ++views;
    if (!options.pictures.empty()) {
      write_picture(ids, labels, k, options.pictures);
    }
  }
  if (views == 0) {
    throw std::runtime_error("No frame with ground truth is left to evaluate; give fewer --views");
  }
  std::printf(
      "%zu other frames, %.3f s per image\n", views, seconds.count() / static_cast<double>(views));
  print_scores(confusion.scores(), labels);
}

void run(Options& options) {
  const Dataset dataset = read_dataset(options.dataset);
  const LabelSet labels = LabelSet::load(options.labels);
  for (std::size_t k = 0; options.views.empty() && k < dataset.frames.size(); ++k) {
    options.views.push_back(k);
  }
  std::vector<TrainingImage> images;
  for (const std::size_t frame : options.views) {
    if (frame >= dataset.frames.size()) {
      throw std::invalid_argument("--views: there is no frame " + std::to_string(frame) +
                                  ", the last is " + std::to_string(dataset.frames.size() - 1));
    }
    images.push_back(read_image(dataset, frame, labels, options));
  }
  const auto start = std::chrono::steady_clock::now();
  const ForestModel model = train_forest(images, labels, options.training);
  const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - start;
  save_forest(model, options.output);
  std::printf("%zu images, %zu classes, %zu trees with %zu nodes, trained in %.1f s\n",
              images.size(),
              model.classes.size(),
              model.roots.size(),
              model.nodes.size(),
              seconds.count());
  if (options.evaluate) {
    evaluate(dataset, labels, options);
  }
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app("Trains the forest of the segmenter node on a few label images.", "train_segmenter");
  Options options;
  add_options(app, options);
  return run_tool(app, argc, argv, [&options] { run(options); });
}
