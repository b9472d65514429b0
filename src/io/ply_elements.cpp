// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "ply_elements.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>
#include <vector>

namespace facet_mapping::ply {
namespace {

constexpr double kLargestIndex = 4294967294.0;

// What a column means for the mesh.
enum class Role { kSkip, kX, kY, kZ, kCorners, kLabel, kConfidence, kViews };

Role role_of(const Property& property, bool is_face) {
  const std::string& name = property.name;
  if (is_face && property.is_list) {
    return name == "vertex_indices" || name == "vertex_index" ? Role::kCorners : Role::kSkip;
  }
  if (is_face) {
    return name == "label"        ? Role::kLabel
           : name == "confidence" ? Role::kConfidence
           : name == "views"      ? Role::kViews
                                  : Role::kSkip;
  }
  const bool is_axis = !property.is_list && name.size() == 1 && name[0] >= 'x' && name[0] <= 'z';
  return is_axis ? static_cast<Role>(static_cast<int>(Role::kX) + (name[0] - 'x')) : Role::kSkip;
}

std::vector<Role> roles_of(const Element& element) {
  std::vector<Role> roles;
  for (const Property& property : element.properties) {
    roles.push_back(role_of(property, element.name == "face"));
  }
  return roles;
}

bool contains(const std::vector<Role>& roles, Role role) {
  return std::find(roles.begin(), roles.end(), role) != roles.end();
}

// Runs `read_row` for each row and says which row an error comes from.
template <typename Function>
void for_each_row(const Element& element, const Function& read_row) {
  std::uint64_t row = 0;
  try {
    for (; row < element.count; ++row) {
      read_row();
    }
  } catch (const std::runtime_error& error) {
    throw std::runtime_error(element.name + " " + std::to_string(row) + " of " +
                             std::to_string(element.count) + ": " + error.what());
  }
}

class VertexReader {
 public:
  VertexReader(const Element& element, Cursor& cursor)
      : element_(element), cursor_(cursor), roles_(roles_of(element)) {
    for (const Role axis : {Role::kX, Role::kY, Role::kZ}) {
      if (!contains(roles_, axis)) {
        throw std::runtime_error("the vertices lack one of the properties x, y, z");
      }
    }
    if (static_cast<double>(element.count) > kLargestIndex) {
      throw std::runtime_error("more than 2^32 vertices");
    }
  }

  Eigen::Vector3d read() {
    Eigen::Vector3d vertex = Eigen::Vector3d::Zero();
    for (std::size_t k = 0; k < roles_.size(); ++k) {
      const Property& property = element_.properties[k];
      if (roles_[k] == Role::kSkip) {
        cursor_.skip(property);
      } else {
        vertex[static_cast<int>(roles_[k]) - static_cast<int>(Role::kX)] =
            cursor_.read(property.type);
      }
    }
    if (!vertex.allFinite()) {
      throw std::runtime_error("a coordinate is not finite");
    }
    return vertex;
  }

 private:
  const Element& element_;
  Cursor& cursor_;
  std::vector<Role> roles_;
};

class FaceReader {
 public:
  FaceReader(const Element& element, Cursor& cursor)
      : element_(element),
        cursor_(cursor),
        roles_(roles_of(element)),
        has_label_(contains(roles_, Role::kLabel)),
        has_confidence_(contains(roles_, Role::kConfidence)),
        has_views_(contains(roles_, Role::kViews)) {
    if (!contains(roles_, Role::kCorners)) {
      throw std::runtime_error("the faces have no list property 'vertex_indices'");
    }
  }

  void read() {
    for (std::size_t k = 0; k < roles_.size(); ++k) {
      read_column(element_.properties[k], roles_[k]);
    }
    if (!is_whole(label_, kUnlabelled) || !is_whole(views_, 65535.0) ||
        !std::isfinite(confidence_)) {
      throw std::runtime_error("label, views or confidence is out of range");
    }
  }

  // Polygons become a fan of triangles around their first corner.
  void append_to(TriangleMesh& mesh) const {
    for (std::size_t k = 2; k < corners_.size(); ++k) {
      mesh.triangles.push_back({corners_[0], corners_[k - 1], corners_[k]});
      if (has_label_) {
        mesh.labels.push_back(static_cast<Label>(label_));
      }
      if (has_confidence_) {
        mesh.confidence.push_back(static_cast<float>(confidence_));
      }
      if (has_views_) {
        mesh.views.push_back(static_cast<std::uint16_t>(views_));
      }
    }
  }

 private:
  void read_column(const Property& property, Role role) {
    switch (role) {
      case Role::kCorners:
        return read_corners(property);
      case Role::kLabel:
        label_ = cursor_.read(property.type);
        return;
      case Role::kConfidence:
        confidence_ = cursor_.read(property.type);
        return;
      case Role::kViews:
        views_ = cursor_.read(property.type);
        return;
      default:
        return cursor_.skip(property);
    }
  }

  void read_corners(const Property& property) {
    corners_.resize(cursor_.read_count(property));
    if (corners_.size() < 3) {
      throw std::runtime_error("it has " + std::to_string(corners_.size()) + " corners");
    }
    for (std::uint32_t& corner : corners_) {
      const double index = cursor_.read(property.type);
      if (!is_whole(index, kLargestIndex)) {
        throw std::runtime_error("it names the vertex " + std::to_string(index));
      }
      corner = static_cast<std::uint32_t>(index);
    }
  }

  const Element& element_;
  Cursor& cursor_;
  std::vector<Role> roles_;
  bool has_label_;
  bool has_confidence_;
  bool has_views_;
  std::vector<std::uint32_t> corners_;
  double label_ = kUnlabelled;
  double confidence_ = 0.0;
  double views_ = 0.0;
};

void skip_element(const Element& element, Cursor& cursor) {
  if (element.properties.empty()) {
    return;
  }
  for_each_row(element, [&] {
    for (const Property& property : element.properties) {
      cursor.skip(property);
    }
  });
}

}  // namespace

void read_element(const Element& element, Cursor& cursor, TriangleMesh& mesh) {
  if (element.name == "vertex") {
    VertexReader reader(element, cursor);
    mesh.vertices.reserve(element.count);
    for_each_row(element, [&] { mesh.vertices.push_back(reader.read()); });
  } else if (element.name == "face") {
    FaceReader reader(element, cursor);
    mesh.triangles.reserve(element.count);
    for_each_row(element, [&] {
      reader.read();
      reader.append_to(mesh);
    });
  } else {
    skip_element(element, cursor);
  }
}

}  // namespace facet_mapping::ply
