// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// evaluate_points: how good and how dear the points of each source are.
#include <ctime>
#include <iostream>
#include <map>
#include <stdexcept>
#include <string>
#include <vector>

#include "point_sources.h"
#include "tool_main.h"

#include "facet_mapping/evaluation/point_quality.h"
#include "facet_mapping/evaluation/point_report.h"
#include "facet_mapping/io/atomic_file.h"
#include "facet_mapping/io/progress_bar.h"
#include "facet_mapping/ros/file_paths.h"

namespace {

using namespace facet_mapping;

struct Options {
  std::string dataset;
  std::vector<std::string> sources;
  std::string frames;
  std::string labels;
  std::string json;
  DatasetPointsConfig points;
  PointQualityOptions quality;
};

/// Frames first .. last, this one included.
struct FrameRange {
  std::size_t first = 0;
  std::size_t last = std::numeric_limits<std::size_t>::max();
};

void add_options(CLI::App& app, Options& options) {
  app.add_option("DATASET", options.dataset, "Dataset folder (layouts below)")->required();
  add_points_option(app, options.sources)->default_str("all that the dataset can give");
  app.add_option("--frames",
                 options.frames,
                 "First and last frame, as 10:19, :19 or 10:, counted from 0 (default: all)");
  app.add_option("--labels",
                 options.labels,
                 "Class list: a path, or a shipped one such as cityscapes (default: cityscapes for "
                 "KITTI, else none: points without classes)");
  app.add_option(
      "--max-depth", options.quality.max_depth_m, "Ignore ground truth beyond this, metres");
  app.add_option("--bounds",
                 options.quality.relative_bounds,
                 "Error bounds whose shares are printed, as parts of the true depth")
      ->delimiter(',')
      ->capture_default_str();
  app.add_option("--cell",
                 options.quality.cell_px,
                 "Side of the squares that the density over the image is counted in, pixels")
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
  app.add_option("--json", options.json, "Write all figures to this file, too");
  app.footer(
      "Points are compared with the depth image of their own frame (gt_depth/, depth_gt/), or with "
      "its\nLiDAR scan where there is none; each with the one pixel that it falls on. LiDAR "
      "points, "
      "whose\nown frame's ground truth they are, are compared with that of the next frame, carried "
      "over by the\nposes: errors of the poses, what moves and the noise of the other scan count, "
      "too. Processor\ntime is that of all threads, without reading files.\n\n" +
      dataset_layouts_help() + "\n\nExample: evaluate_points ~/kitti/drive --frames :19");
}

std::size_t frame_number(const std::string& text, std::size_t otherwise) {
  if (text.empty()) {
    return otherwise;
  }
  if (text.size() > 9 || text.find_first_not_of("0123456789") != std::string::npos) {
    throw std::invalid_argument("--frames wants two numbers and a colon, such as 10:19, not '" +
                                text + "'");
  }
  return std::stoul(text);
}

FrameRange frame_range(const std::string& text) {
  FrameRange range;
  const std::size_t colon = text.find(':');
  if (!text.empty() && colon == std::string::npos) {
    throw std::invalid_argument("--frames wants a colon, such as 10:19, not '" + text + "'");
  }
  if (!text.empty()) {
    range.first = frame_number(text.substr(0, colon), range.first);
    range.last = frame_number(text.substr(colon + 1), range.last);
  }
  return range;
}

double processor_seconds() {
  return static_cast<double>(std::clock()) / CLOCKS_PER_SEC;
}

/// Makes all points of one source and compares them.
class Evaluation {
 public:
  Evaluation(const Options& options,
             const Dataset& dataset,
             const LabelSet& labels,
             const PointSource& source)
      : source_(source),
        dataset_(dataset),
        labels_(labels),
        config_(source_config(options, source)),
        points_(dataset, labels, config_),
        quality_(options.quality) {
    result_.name = source.name;
    for (std::size_t k = 0; k < dataset.frames.size(); ++k) {
      index_of_[dataset.frames[k].stamp] = k;
    }
  }

  void add_frame(std::size_t frame) {
    ++result_.images;
    const double reading = reading_seconds(dataset_.frames.at(frame));
    const double start = processor_seconds();
    std::vector<SensorPoints> points = points_.read(frame);
    for (SensorPoints& followed : points_.follow(frame)) {
      points.push_back(std::move(followed));
    }
    result_.processor_seconds += std::max(0.0, processor_seconds() - start - reading);
    compare(points);
  }

  NamedPointScores finish() {
    const double start = processor_seconds();
    const std::vector<SensorPoints> points = points_.finish();
    result_.processor_seconds += processor_seconds() - start;
    compare(points);
    result_.scores = quality_.scores();
    return result_;
  }

 private:
  static DatasetPointsConfig source_config(const Options& options, const PointSource& source) {
    DatasetPointsConfig config = with_sources(options.points, {source.name});
    config.sky_config.cell_px = 0;  // rays toward the sky are no measurements
    return config;
  }

  // What reading a frame's files costs, so that it can be left out.
  double reading_seconds(const DatasetFrame& frame) const {
    const double start = processor_seconds();
    frame_label_image(frame, labels_);
    if (config_.lidar) {
      read_scan(frame.scan);
    } else {
      read_gray(frame.left_image);
    }
    if (config_.stereo) {
      read_gray(frame.right_image);
    }
    return processor_seconds() - start;
  }

  void compare(const std::vector<SensorPoints>& all) {
    for (const SensorPoints& points : all) {
      quality_.add(points.frame, truth_of(index_of_.at(points.frame.stamp)));
    }
  }

  PointTruth truth_of(std::size_t frame) {
    if (!config_.lidar) {
      result_.depths = "own frame";
      return own_truth(dataset_, frame, label_truth(frame));
    }
    result_.depths = "next frame";
    const std::size_t other = other_frame(dataset_, frame);
    return scan_truth(dataset_, frame, other, label_truth(other));
  }

  cv::Mat label_truth(std::size_t index) {
    const DatasetFrame& frame = dataset_.frames.at(index);
    const bool has_truth = !frame.gt_labels.empty();
    result_.labels = labels_.empty() ? "" : has_truth ? "ground truth" : "segmentation";
    if (labels_.empty() || !has_truth) {
      return frame_label_image(frame, labels_);
    }
    return read_labels(frame.gt_labels);
  }

  const PointSource& source_;
  const Dataset& dataset_;
  const LabelSet& labels_;
  DatasetPointsConfig config_;
  DatasetPoints points_;
  PointQuality quality_;
  NamedPointScores result_;
  std::map<double, std::size_t> index_of_;  // stamp -> frame
};

NamedPointScores evaluate(const Options& options,
                          const Dataset& dataset,
                          const LabelSet& labels,
                          const PointSource& source) {
  const FrameRange range = frame_range(options.frames);
  const std::size_t end = end_frame(dataset, range.first, range.last);
  Evaluation evaluation(options, dataset, labels, source);
  ProgressBar bar(source.name);
  for (std::size_t k = range.first; k < end; ++k) {
    evaluation.add_frame(k);
    bar.update(k + 1 - range.first, end - range.first);
  }
  return evaluation.finish();
}

bool can_give(const Dataset& dataset, const PointSource& source) {
  const DatasetPointsConfig config = with_sources({}, {source.name});
  return (!config.stereo || dataset.has_right) && (!config.lidar || dataset.has_scans);
}

bool is_wanted(const Options& options, const Dataset& dataset, const PointSource& source) {
  const auto& names = options.sources;
  return names.empty() ? can_give(dataset, source)
                       : std::find(names.begin(), names.end(), source.name) != names.end();
}

void run(const Options& options) {
  const Dataset dataset = read_dataset(options.dataset);
  LabelSet labels;
  if (!options.labels.empty() || dataset.is_z_up) {
    labels =
        LabelSet::load(label_file_path(options.labels.empty() ? "cityscapes" : options.labels));
  }
  std::vector<NamedPointScores> scores;
  for (const PointSource& source : point_sources()) {
    if (is_wanted(options, dataset, source)) {
      scores.push_back(evaluate(options, dataset, labels, source));
    }
  }
  std::cout << point_table(scores, options.quality);
  if (!options.json.empty()) {
    AtomicFile file(options.json);
    file.write(point_json(scores, options.quality));
    file.commit();
  }
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app("Measures sources of points against the ground-truth depth of a dataset.",
               "evaluate_points");
  Options options;
  add_options(app, options);
  return run_tool(app, argc, argv, [&options] { run(options); });
}
