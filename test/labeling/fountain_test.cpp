// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Real segmentations of the fountain against its ground-truth labels (Strecha et al. 2008).
#include <cstdint>
#include <string>
#include <vector>

#include "support/shared_data.h"
#include <gtest/gtest.h>
#include <opencv2/imgcodecs.hpp>

#include "facet_mapping/io/dataset.h"
#include "facet_mapping/io/ply.h"
#include "facet_mapping/labeling/facet_labeling.h"
#include "facet_mapping/render/facet_renderer.h"

namespace facet_mapping {
namespace {

constexpr int kNone = 255;

cv::Mat read_labels(const std::string& path) {
  const cv::Mat ids = cv::imread(path, cv::IMREAD_UNCHANGED);
  cv::Mat labels;
  ids.convertTo(labels, CV_16U);
  labels.setTo(kUnlabelled, ids == kNone);
  return labels;
}

/// Right and all pixels where both the mesh and the ground truth are.
struct Score {
  double right = 0.0;
  double all = 0.0;

  void add(const cv::Mat& labels, const cv::Mat& truth, const FacetImage& rendering) {
    const cv::Mat counted = (truth != kUnlabelled) & (rendering.facets >= 0);
    all += cv::countNonZero(counted);
    right += cv::countNonZero((labels == truth) & counted);
  }
  double accuracy() const { return right / all; }
};

TEST(FacetLabeling, CleansTheFountainsSegmentations) {
  FACET_MAPPING_DATA_OR_SKIP(folder, "fountain_p11");
  TriangleMesh mesh = read_ply(folder + "/start_mesh_coarse.ply").mesh;
  std::vector<LabeledView> views;
  std::vector<FacetImage> renderings;
  std::vector<cv::Mat> truth;
  Score input;
  for (const DatasetFrame& frame : read_dataset(folder).frames) {
    LabeledView view;
    view.view = frame.view;
    view.labels = read_labels(frame.labels);
    truth.push_back(read_labels(frame.gt_labels));
    renderings.push_back(make_renderer()->render(mesh, view.view));
    input.add(view.labels, truth.back(), renderings.back());
    views.push_back(view);
  }
  mesh.labels = label_facets(mesh, views, renderings, LabelingConfig()).labels;
  Score output;
  for (std::size_t k = 0; k < views.size(); ++k) {
    output.add(label_image(renderings[k], mesh), truth[k], renderings[k]);
  }
  RecordProperty("input_accuracy", std::to_string(input.accuracy()));
  RecordProperty("output_accuracy", std::to_string(output.accuracy()));
  EXPECT_GT(output.accuracy(), input.accuracy() + 0.015);
}

}  // namespace
}  // namespace facet_mapping
