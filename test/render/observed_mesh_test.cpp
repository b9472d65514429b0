// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "facet_mapping/render/observed_mesh.h"

#include <cstddef>
#include <cstdint>

#include "support/meshes.h"
#include <gtest/gtest.h>

namespace facet_mapping {
namespace {

TEST(ObservedMesh, ImagesLookThroughGapsAndKeepTheIdsOfTheWholeMesh) {
  // A box seen from outside; the near face (+x, the second) only closes the surface.
  TriangleMesh box = test::make_box({1.0, 1.0, 1.0}, 2);
  const std::size_t per_face = box.triangles.size() / 6;
  box.views.assign(box.triangles.size(), 3);
  for (std::size_t f = per_face; f < 2 * per_face; ++f) {
    box.views[f] = 0;
  }
  const ObservedMesh observed(box);
  EXPECT_EQ(observed.mesh().triangles.size(), 5 * per_face);
  const View view = test::look_at(test::make_camera(80, 60, 60.0), {4.0, 0, 0}, {0, 0, 0});
  const auto renderer = make_renderer();
  const FacetImage image = observed.render(renderer.get(), view);
  const auto facet = image.facets.at<std::int32_t>(30, 40);
  ASSERT_GE(facet, 0);
  EXPECT_EQ(static_cast<std::size_t>(facet) / per_face, 0U);  // the far face, -x
  EXPECT_NEAR(image.depth.at<float>(30, 40), 5.0F, 1e-4F);
}

TEST(ObservedMesh, WithoutViewCountsNothingIsAGap) {
  const TriangleMesh box = test::make_box({1.0, 1.0, 1.0}, 1);
  EXPECT_EQ(ObservedMesh(box).mesh().triangles, box.triangles);
}

}  // namespace
}  // namespace facet_mapping
