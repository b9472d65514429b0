// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Meshes with known labels, seen by cameras whose segmentations are right or wrong by chance.
#pragma once

#include <algorithm>
#include <cstdint>
#include <random>
#include <vector>

#include "support/meshes.h"
#include <opencv2/core.hpp>

#include "facet_mapping/labeling/facet_labeling.h"
#include "facet_mapping/render/facet_renderer.h"

namespace facet_mapping::test {

struct LabeledScene {
  TriangleMesh mesh;         ///< without labels
  std::vector<Label> truth;  ///< per facet
  std::vector<LabeledView> views;
  std::vector<FacetImage> renderings;
};

/// Adds a view whose segmentation is the true one; what shows no facet is void.
inline void add_view(LabeledScene* scene, const View& view) {
  TriangleMesh truth = scene->mesh;
  truth.labels = scene->truth;
  LabeledView labeled;
  labeled.view = view;
  scene->renderings.push_back(make_renderer()->render(truth, view));
  labeled.labels = label_image(scene->renderings.back(), truth);
  scene->views.push_back(labeled);
}

/// A box whose six faces have the labels 10 .. 15, seen from eight sides.
inline LabeledScene make_box_scene(int subdivisions = 4) {
  LabeledScene scene;
  scene.mesh = make_box({1.0, 1.5, 1.0}, subdivisions);
  const std::size_t per_face = scene.mesh.triangles.size() / 6;
  for (std::size_t f = 0; f < scene.mesh.triangles.size(); ++f) {
    scene.truth.push_back(static_cast<Label>(10 + f / per_face));
  }
  for (int k = 0; k < 8; ++k) {
    const Eigen::Vector3d eye(
        (k & 1) != 0 ? 3.5 : -3.5, (k & 2) != 0 ? 3.8 : -3.8, (k & 4) != 0 ? 3.0 : -3.0);
    add_view(&scene, look_at(make_camera(160, 120, 150.0), eye, {0, 0, 0}));
  }
  return scene;
}

/// Replaces square blobs by a wrong class (or void) until about `share` of the image is wrong.
inline void add_noise(LabeledScene* scene, double share, int side_px, unsigned seed) {
  std::mt19937 random(seed);
  const std::vector<Label> wrong{10, 11, 12, 13, 14, 15, kUnlabelled};
  for (LabeledView& view : scene->views) {
    cv::Mat& labels = view.labels;
    const int blobs = static_cast<int>(share * static_cast<double>(labels.total()) /
                                       (static_cast<double>(side_px) * side_px));
    for (int k = 0; k < blobs; ++k) {
      const cv::Rect blob(static_cast<int>(random() % labels.cols),
                          static_cast<int>(random() % labels.rows),
                          side_px,
                          side_px);
      labels(blob & cv::Rect({0, 0}, labels.size())).setTo(wrong[random() % wrong.size()]);
    }
  }
}

/// Share of the pixels showing the mesh that the segmentations label rightly, void left out.
inline double input_accuracy(const LabeledScene& scene) {
  std::size_t right = 0;
  std::size_t all = 0;
  for (std::size_t k = 0; k < scene.views.size(); ++k) {
    const auto* labels = scene.views[k].labels.ptr<Label>();
    const auto* facets = scene.renderings[k].facets.ptr<std::int32_t>();
    for (std::size_t p = 0; p < scene.views[k].labels.total(); ++p) {
      if (facets[p] >= 0 && labels[p] != kUnlabelled) {
        ++all;
        right += labels[p] == scene.truth[static_cast<std::size_t>(facets[p])] ? 1 : 0;
      }
    }
  }
  return static_cast<double>(right) / static_cast<double>(all);
}

/// Share of the facets that are labelled rightly.
inline double facet_accuracy(const LabeledScene& scene, const std::vector<Label>& labels) {
  std::size_t right = 0;
  for (std::size_t f = 0; f < labels.size(); ++f) {
    right += labels[f] == scene.truth[f] ? 1 : 0;
  }
  return static_cast<double>(right) / static_cast<double>(labels.size());
}

inline LabelingResult label(const LabeledScene& scene, const LabelingConfig& config = {}) {
  return label_facets(scene.mesh, scene.views, scene.renderings, config);
}

}  // namespace facet_mapping::test
