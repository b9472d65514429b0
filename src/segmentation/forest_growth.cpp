// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "forest_growth.h"

#include <cmath>
#include <cstdint>
#include <utility>

#include <opencv2/ml.hpp>

namespace facet_mapping::detail {
namespace {

constexpr double kFullShare = 255.0;

cv::Ptr<cv::ml::RTrees> train(const TrainingTable& table, const ForestTrainingConfig& config) {
  const cv::Ptr<cv::ml::RTrees> trees = cv::ml::RTrees::create();
  trees->setMaxDepth(config.max_depth);
  trees->setMinSampleCount(config.min_leaf_samples);
  trees->setActiveVarCount(0);  // the square root of all
  trees->setCalculateVarImportance(false);
  trees->setTermCriteria({cv::TermCriteria::MAX_ITER, config.trees, 0.0});
  const cv::Mat classes(table.classes, true);
  cv::setRNGSeed(static_cast<int>(config.seed % 0x7FFFFFFF));
  trees->train(cv::ml::TrainData::create(table.features, cv::ml::ROW_SAMPLE, classes));
  return trees;
}

/// One tree of OpenCV's, parents before children.
void copy_tree(const cv::ml::RTrees& trees, int root, ForestModel* model) {
  const auto& nodes = trees.getNodes();
  const auto& splits = trees.getSplits();
  std::vector<std::pair<int, std::size_t>> open{{root, model->nodes.size()}};  // theirs, ours
  model->roots.push_back(static_cast<std::int32_t>(model->nodes.size()));
  model->nodes.emplace_back();
  while (!open.empty()) {
    const auto [theirs, ours] = open.back();
    open.pop_back();
    if (nodes[theirs].split < 0) {
      continue;
    }
    const auto& split = splits[nodes[theirs].split];
    const auto left = static_cast<std::int32_t>(model->nodes.size());
    model->nodes[ours] = {split.varIdx, split.c, left, left + 1};
    open.emplace_back(nodes[theirs].left, model->nodes.size());
    open.emplace_back(nodes[theirs].right, model->nodes.size() + 1);
    model->nodes.resize(model->nodes.size() + 2);
  }
}

/// Numbers the leaves and lets every sample say its class in the leaves that it falls into.
void fill_leaves(const TrainingTable& table, ForestModel* model) {
  std::int32_t leaves = 0;
  for (ForestModel::Node& node : model->nodes) {
    if (node.feature < 0) {
      node.left = leaves++;
    }
  }
  const std::size_t classes = model->classes.size();
  std::vector<int> counts(leaves * classes, 0);
  for (int k = 0; k < table.features.rows; ++k) {
    for (const std::int32_t root : model->roots) {
      ++counts[model->leaf(root, table.features.ptr<float>(k)) * classes + table.classes[k]];
    }
  }
  model->leaves.assign(counts.size(), 0);
  for (std::size_t first = 0; first < counts.size(); first += classes) {
    double sum = 0.0;
    for (std::size_t c = 0; c < classes; ++c) {
      sum += counts[first + c];
    }
    for (std::size_t c = 0; sum > 0.0 && c < classes; ++c) {
      model->leaves[first + c] =
          static_cast<std::uint8_t>(std::lround(kFullShare * counts[first + c] / sum));
    }
  }
}

}  // namespace

void grow_forest(const TrainingTable& table,
                 const ForestTrainingConfig& config,
                 ForestModel* model) {
  const cv::Ptr<cv::ml::RTrees> trees = train(table, config);
  for (const int root : trees->getRoots()) {
    copy_tree(*trees, root, model);
  }
  fill_leaves(table, model);
}

}  // namespace facet_mapping::detail
