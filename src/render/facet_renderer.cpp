// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "facet_mapping/render/facet_renderer.h"

#include <stdexcept>
#include <string>

#include "render/osmesa_renderer.h"
#include "render/software_renderer.h"

namespace facet_mapping {

std::unique_ptr<FacetRenderer> make_renderer(RenderBackend backend) {
  if (backend == RenderBackend::kOsmesa) {
    return std::make_unique<OsmesaRenderer>();
  }
  return std::make_unique<SoftwareRenderer>();
}

cv::Mat label_image(const FacetImage& image, const TriangleMesh& mesh) {
  const auto facet_count = static_cast<std::int64_t>(mesh.triangles.size());
  const bool labelled = mesh.labels.size() == mesh.triangles.size();
  cv::Mat labels(image.facets.size(), CV_16UC1, cv::Scalar(kUnlabelled));
  for (int y = 0; y < labels.rows; ++y) {
    const auto* facets = image.facets.ptr<std::int32_t>(y);
    auto* row = labels.ptr<Label>(y);
    for (int x = 0; x < labels.cols; ++x) {
      if (facets[x] >= facet_count) {
        throw std::invalid_argument("label_image: the rendering shows facet " +
                                    std::to_string(facets[x]) + " of a mesh with only " +
                                    std::to_string(facet_count) + "; render this mesh");
      }
      if (labelled && facets[x] >= 0) {
        row[x] = mesh.labels[static_cast<std::size_t>(facets[x])];
      }
    }
  }
  return labels;
}

}  // namespace facet_mapping
