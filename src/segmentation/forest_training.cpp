// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "facet_mapping/segmentation/forest_training.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <random>
#include <stdexcept>
#include <string>
#include <utility>

#include "cell_features.h"
#include "forest_growth.h"

namespace facet_mapping {
namespace {

constexpr double kClearMajority = 0.8;  // of a cell's labelled pixels

void check_config(const ForestTrainingConfig& config) {
  detail::check_cells(config.cells);
  if (config.trees < 1 || config.trees > 1000 || config.max_depth < 1 || config.max_depth > 30 ||
      config.min_leaf_samples < 1 || config.max_samples < 100 || config.max_samples > 10000000 ||
      !(config.class_balance >= 0.0 && config.class_balance <= 1.0)) {
    throw std::invalid_argument(
        "A forest must have 1 to 1000 trees of depth 1 to 30, at least 1 sample a leaf, 100 to "
        "10000000 samples and a class balance of 0 to 1");
  }
}

void check_image(const TrainingImage& image, const LabelSet& labels) {
  check_color_image(image.bgr);
  if (image.labels.type() != CV_16UC1 || image.labels.size() != image.bgr.size()) {
    throw std::invalid_argument(
        "A label image to train on must be 16-bit class ids of its image's size");
  }
  for (int y = 0; y < image.labels.rows; ++y) {
    for (int x = 0; x < image.labels.cols; ++x) {
      const Label id = image.labels.at<Label>(y, x);
      if (id != kUnlabelled && labels.find(id) == nullptr) {
        throw std::invalid_argument("A label image to train on holds class " + std::to_string(id) +
                                    ", which the label list does not have; use its own list");
      }
    }
  }
}

/// The class that clearly rules the labelled pixels of each cell, row by row; else kUnlabelled.
std::vector<Label> cell_labels(const cv::Mat& labels, const cv::Size& cells) {
  std::vector<std::map<Label, int>> counts(static_cast<std::size_t>(cells.area()));
  for (int y = 0; y < labels.rows; ++y) {
    const int row = static_cast<int>((y + 0.5) * cells.height / labels.rows);
    for (int x = 0; x < labels.cols; ++x) {
      const int column = static_cast<int>((x + 0.5) * cells.width / labels.cols);
      const Label id = labels.at<Label>(y, x);
      if (id != kUnlabelled) {
        ++counts[row * cells.width + column][id];
      }
    }
  }
  std::vector<Label> rulers(counts.size(), kUnlabelled);
  for (std::size_t k = 0; k < counts.size(); ++k) {
    int sum = 0;
    for (const auto& [id, count] : counts[k]) {
      sum += count;
    }
    for (const auto& [id, count] : counts[k]) {
      rulers[k] = count >= kClearMajority * sum ? id : rulers[k];
    }
  }
  return rulers;
}

struct Sample {
  std::size_t image;
  int cell;
};

using SamplesOfClass = std::map<Label, std::vector<Sample>>;

/// Keeps of each class a random part, in proportion to its cells to the power of 1 - balance.
void thin(const ForestTrainingConfig& config, SamplesOfClass* samples) {
  std::mt19937_64 random(config.seed);
  double weights = 0.0;
  const auto weight = [&](const std::vector<Sample>& of_class) {
    return std::pow(static_cast<double>(of_class.size()), 1.0 - config.class_balance);
  };
  for (const auto& [id, of_class] : *samples) {
    weights += weight(of_class);
  }
  for (auto& [id, of_class] : *samples) {
    const auto quota = static_cast<std::size_t>(
        std::max(1.0, std::floor(config.max_samples * weight(of_class) / weights)));
    const std::size_t kept = std::min(quota, of_class.size());
    for (std::size_t k = 0; k < kept; ++k) {  // Fisher-Yates, as far as needed
      std::swap(of_class[k], of_class[k + random() % (of_class.size() - k)]);
    }
    of_class.resize(kept);
  }
}

SamplesOfClass collect(const std::vector<TrainingImage>& images, const CellConfig& config) {
  SamplesOfClass samples;
  for (std::size_t i = 0; i < images.size(); ++i) {
    const cv::Size cells = detail::cell_grid(images[i].bgr.size(), config);
    const std::vector<Label> rulers = cell_labels(images[i].labels, cells);
    for (std::size_t k = 0; k < rulers.size(); ++k) {
      if (rulers[k] != kUnlabelled) {
        samples[rulers[k]].push_back({i, static_cast<int>(k)});
      }
    }
  }
  if (samples.size() < 2) {
    throw std::invalid_argument("The label images to train on show " +
                                std::to_string(samples.size()) + " classes; at least 2 are needed");
  }
  return samples;
}

}  // namespace

ForestModel train_forest(const std::vector<TrainingImage>& images,
                         const LabelSet& labels,
                         const ForestTrainingConfig& config) {
  check_config(config);
  std::vector<cv::Mat> features;
  for (const TrainingImage& image : images) {
    check_image(image, labels);
    const GroundView* ground = image.ground ? &*image.ground : nullptr;
    features.push_back(detail::cell_features(image.bgr, ground, config.cells));
  }
  SamplesOfClass samples = collect(images, config.cells);
  thin(config, &samples);
  ForestModel model;
  model.cells = config.cells;
  model.features = detail::feature_count(config.cells);
  detail::TrainingTable table;
  for (const auto& [id, of_class] : samples) {
    for (const Sample& sample : of_class) {
      table.features.push_back(features[sample.image].row(sample.cell));
      table.classes.push_back(static_cast<int>(model.classes.size()));
    }
    model.classes.push_back({id, labels.name_of(id)});
  }
  detail::grow_forest(table, config, &model);
  return model;
}

}  // namespace facet_mapping
