// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Own z-buffer rasteriser, parallel over bands of rows.
#pragma once

#include <vector>

#include "render/screen.h"

#include "facet_mapping/render/facet_renderer.h"

namespace facet_mapping {

class SoftwareRenderer : public FacetRenderer {
 public:
  FacetImage render(const TriangleMesh& mesh, const View& view) override;

 private:
  void project_vertices(const TriangleMesh& mesh, const View& view, const Screen& screen);

  std::vector<ScreenVertex> vertices_;  // kept between calls to save the allocation
};

}  // namespace facet_mapping
