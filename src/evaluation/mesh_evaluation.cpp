// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "facet_mapping/evaluation/mesh_evaluation.h"

#include <cmath>
#include <map>
#include <memory>
#include <numeric>
#include <stdexcept>

#include "facet_mapping/geometry/self_intersections.h"
#include "facet_mapping/labels/label_image.h"
#include "facet_mapping/render/facet_renderer.h"

namespace facet_mapping {
namespace {

Label sky_of(const LabelSet& labels) {
  for (const ClassInfo& info : labels.classes()) {
    if (info.sky) {
      return info.id;
    }
  }
  return kUnlabelled;
}

// Sums up over the views of one mesh.
class Evaluator {
 public:
  Evaluator(const TriangleMesh& mesh,
            const LabelSet& labels,
            const Dataset& dataset,
            const EvaluationOptions& options)
      : mesh_(mesh),
        background_(sky_of(labels)),
        dataset_(dataset),
        options_(options),
        renderer_(make_renderer()),
        depth_(options.depth) {
    result_.vertices = mesh.vertices.size();
    result_.facets = mesh.triangles.size();
    result_.areas = class_areas(mesh);
  }

  void add_view(std::size_t index) {
    const DatasetFrame& frame = dataset_.frames[index];
    DepthErrors errors(options_.depth);
    FacetImage image;
    const cv::Mat truth = true_depth(dataset_, frame, options_.scan);
    if (!truth.empty()) {
      image = render(frame.view, truth.size(), frame.gt_depth);
      errors.add(image.depth, truth);
      depth_.add(errors);
      ++(frame.gt_depth.empty() ? result_.scan_views : result_.depth_image_views);
      result_.views.push_back({index, errors.scores()});
    }
    if (!frame.gt_labels.empty() && !mesh_.labels.empty()) {
      add_labels(frame, image);
    }
  }

  MeshEvaluation result() {
    result_.depth = depth_.scores();
    result_.labels = labels_.scores(options_.min_class_pixels);
    return result_;
  }

 private:
  FacetImage render(const View& view, const cv::Size& size, const std::string& what) {
    return renderer_->render(mesh_, view_of_size(view, size, what));
  }

  void add_labels(const DatasetFrame& frame, FacetImage& image) {
    const cv::Mat truth = read_labels(frame.gt_labels);
    if (image.facets.size() != truth.size()) {
      image = render(frame.view, truth.size(), frame.gt_labels);
    }
    cv::Mat predicted = label_image(image, mesh_);
    predicted.setTo(cv::Scalar(background_), image.facets < 0);
    labels_.add(predicted, truth);
    ++result_.label_views;
  }

  const TriangleMesh& mesh_;
  Label background_;  // what an open view shows
  const Dataset& dataset_;
  const EvaluationOptions& options_;
  std::unique_ptr<FacetRenderer> renderer_;
  DepthErrors depth_;
  ConfusionMatrix labels_;
  MeshEvaluation result_;
};

std::vector<std::size_t> chosen_views(const Dataset& dataset, const EvaluationOptions& options) {
  std::vector<std::size_t> views = options.views;
  if (views.empty()) {
    views.resize(dataset.frames.size());
    std::iota(views.begin(), views.end(), std::size_t{0});
  }
  for (const std::size_t view : views) {
    if (view >= dataset.frames.size()) {
      throw std::invalid_argument("there is no view " + std::to_string(view) +
                                  ": the dataset has views 0 to " +
                                  std::to_string(dataset.frames.size() - 1));
    }
  }
  return views;
}

}  // namespace

MeshEvaluation evaluate_mesh(const TriangleMesh& mesh,
                             const LabelSet& labels,
                             const Dataset& dataset,
                             const EvaluationOptions& options,
                             const EvaluationProgress& progress) {
  const std::vector<std::size_t> views = chosen_views(dataset, options);
  const TriangleMesh shown = shown_facets(mesh, labels, options.hidden);
  Evaluator evaluator(shown, labels, dataset, options);
  for (std::size_t k = 0; k < views.size(); ++k) {
    evaluator.add_view(views[k]);
    if (progress) {
      progress(k + 1, views.size());
    }
  }
  MeshEvaluation result = evaluator.result();
  if (result.depth_image_views + result.scan_views + result.label_views == 0) {
    throw std::runtime_error(
        "none of the chosen views has ground truth that this mesh can be compared with: a depth "
        "image, a scan, or ground-truth labels for a labelled mesh");
  }
  if (options.self_intersections) {
    result.self_intersections = count_self_intersections(mesh);
  }
  return result;
}

MeshEvaluation evaluate_segmentation(const Dataset& dataset, const EvaluationOptions& options) {
  MeshEvaluation result;
  result.depth = DepthErrors(options.depth).scores();
  ConfusionMatrix labels;
  for (const std::size_t index : chosen_views(dataset, options)) {
    const DatasetFrame& frame = dataset.frames[index];
    if (!frame.labels.empty() && !frame.gt_labels.empty()) {
      const cv::Mat truth = read_labels(frame.gt_labels);
      labels.add(resize_label_image(read_labels(frame.labels), truth.size()), truth);
      ++result.label_views;
    }
  }
  if (result.label_views == 0) {
    throw std::runtime_error(
        "none of the chosen views has both a segmentation and ground-truth labels");
  }
  result.labels = labels.scores(options.min_class_pixels);
  return result;
}

TriangleMesh shown_facets(const TriangleMesh& mesh, const LabelSet& labels, const Hidden& hidden) {
  std::vector<bool> keep(mesh.triangles.size());
  for (std::size_t f = 0; f < keep.size(); ++f) {
    const Label label = mesh.labels.empty() ? kUnlabelled : mesh.labels[f];
    const ClassInfo* info = labels.find(label);
    const bool is_sky = info != nullptr && info->sky;
    const bool is_unlabelled = !mesh.labels.empty() && label == kUnlabelled;
    keep[f] = !(hidden.gaps && is_gap(mesh, f)) && !(hidden.unlabelled && is_unlabelled) &&
              !(hidden.sky && is_sky);
  }
  return select_facets(mesh, keep);
}

std::vector<ClassArea> class_areas(const TriangleMesh& mesh) {
  std::map<Label, ClassArea> areas;
  for (std::size_t f = 0; f < mesh.labels.size(); ++f) {
    ClassArea& area = areas[mesh.labels[f]];
    area.id = mesh.labels[f];
    ++area.facets;
    area.area_m2 += facet_cross(mesh, f).norm() / 2.0;
  }
  std::vector<ClassArea> list;
  list.reserve(areas.size());
  for (const auto& [id, area] : areas) {
    list.push_back(area);
  }
  return list;
}

cv::Mat true_depth(const Dataset& dataset,
                   const DatasetFrame& frame,
                   const ScanDepthOptions& options) {
  if (!frame.gt_depth.empty()) {
    return read_depth(frame.gt_depth, dataset.depth_scale);
  }
  if (!frame.scan.empty()) {
    return scan_depth(read_scan(frame.scan), dataset.left_from_velo, frame.view.camera, options);
  }
  return {};
}

View view_of_size(const View& view, const cv::Size& size, const std::string& what) {
  const PinholeCamera& camera = view.camera;
  const double width_ratio = static_cast<double>(size.width) / camera.width;
  const double height_ratio = static_cast<double>(size.height) / camera.height;
  if (std::abs(width_ratio / height_ratio - 1.0) > 0.01) {
    throw std::invalid_argument("'" + what + "' is " + std::to_string(size.width) + "x" +
                                std::to_string(size.height) +
                                " pixels, which has not the shape of " + "its camera's " +
                                std::to_string(camera.width) + "x" + std::to_string(camera.height));
  }
  return {camera.resized(size.width, size.height), view.world_from_cam};
}

}  // namespace facet_mapping
