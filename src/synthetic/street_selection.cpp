// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "street_selection.h"

#include <array>

namespace facet_mapping {
namespace {

/// Inward unit normals of the four planes through the camera and the image's sides.
std::array<Eigen::Vector3d, 4> side_planes(const PinholeCamera& camera) {
  const double left = (-0.5 - camera.cx) / camera.fx;
  const double right = (camera.width - 0.5 - camera.cx) / camera.fx;
  const double top = (-0.5 - camera.cy) / camera.fy;
  const double bottom = (camera.height - 0.5 - camera.cy) / camera.fy;
  return {Eigen::Vector3d(1.0, 0.0, -left).normalized(),
          Eigen::Vector3d(-1.0, 0.0, right).normalized(),
          Eigen::Vector3d(0.0, 1.0, -top).normalized(),
          Eigen::Vector3d(0.0, -1.0, bottom).normalized()};
}

bool meets(const StreetPart& part,
           const Eigen::Vector3d& center_in_cam,
           const std::array<Eigen::Vector3d, 4>& planes,
           double far) {
  if (center_in_cam.z() < -part.radius || center_in_cam.norm() > far + part.radius) {
    return false;
  }
  for (const Eigen::Vector3d& plane : planes) {
    if (plane.dot(center_in_cam) < -part.radius) {
      return false;
    }
  }
  return true;
}

struct Selection {
  TriangleMesh mesh;
  std::vector<std::int32_t> facets;  // of the street, per facet of the mesh
};

void append(const Street& street, const StreetPart& part, Selection* selection) {
  const TriangleMesh& all = street.mesh;
  const auto first = all.vertices.begin() + part.first_vertex;
  const auto shift =
      static_cast<std::uint32_t>(selection->mesh.vertices.size()) - part.first_vertex;
  selection->mesh.vertices.insert(selection->mesh.vertices.end(), first, first + part.vertex_count);
  for (std::uint32_t f = part.first_facet; f < part.first_facet + part.facet_count; ++f) {
    const Triangle& t = all.triangles[f];
    selection->mesh.triangles.push_back({t[0] + shift, t[1] + shift, t[2] + shift});
    selection->facets.push_back(static_cast<std::int32_t>(f));
  }
}

}  // namespace

std::vector<std::size_t> parts_in_view(const Street& street, const View& view, double far) {
  const std::array<Eigen::Vector3d, 4> planes = side_planes(view.camera);
  const Eigen::Isometry3d cam_from_map = view.cam_from_world();
  std::vector<std::size_t> parts;
  for (std::size_t k = 0; k < street.parts.size(); ++k) {
    if (meets(street.parts[k], cam_from_map * street.parts[k].center, planes, far)) {
      parts.push_back(k);
    }
  }
  return parts;
}

FacetImage render_parts(const Street& street,
                        const std::vector<std::size_t>& parts,
                        const View& view) {
  Selection selection;
  for (const std::size_t part : parts) {
    append(street, street.parts[part], &selection);
  }
  FacetImage image = make_renderer()->render(selection.mesh, view);
  image.facets.forEach<std::int32_t>([&](std::int32_t& facet, const int* /*position*/) {
    facet = facet < 0 ? -1 : selection.facets[static_cast<std::size_t>(facet)];
  });
  return image;
}

}  // namespace facet_mapping
