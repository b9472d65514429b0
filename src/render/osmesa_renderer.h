// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Facet ids and depth through Mesa's off-screen OpenGL 3.3: the reference backend.
#pragma once

#include <memory>

#include "facet_mapping/render/facet_renderer.h"

namespace facet_mapping {

class OsmesaRenderer : public FacetRenderer {
 public:
  /// Throws std::runtime_error with the reason if no context with gl_PrimitiveID can be had.
  OsmesaRenderer();
  ~OsmesaRenderer() override;
  FacetImage render(const TriangleMesh& mesh, const View& view) override;

 private:
  class Context;
  std::unique_ptr<Context> context_;
};

}  // namespace facet_mapping
