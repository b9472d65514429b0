// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "facet_mapping/ros/cloud_conversions.h"

#include <cmath>
#include <cstring>
#include <limits>
#include <stdexcept>
#include <string>

#include <sensor_msgs/point_cloud2_iterator.h>

#include "facet_mapping/geometry/facet_centroid.h"

namespace facet_mapping {
namespace {

using sensor_msgs::PointField;

std::size_t size_of(std::uint8_t datatype) {
  switch (datatype) {
    case PointField::INT8:
    case PointField::UINT8:
      return 1;
    case PointField::INT16:
    case PointField::UINT16:
      return 2;
    case PointField::FLOAT64:
      return 8;
    default:
      return 4;
  }
}

template <typename T>
double load(const std::uint8_t* bytes) {
  T value;
  std::memcpy(&value, bytes, sizeof(T));
  return static_cast<double>(value);
}

double load_as(std::uint8_t datatype, const std::uint8_t* bytes) {
  switch (datatype) {
    case PointField::INT8:
      return load<std::int8_t>(bytes);
    case PointField::UINT8:
      return load<std::uint8_t>(bytes);
    case PointField::INT16:
      return load<std::int16_t>(bytes);
    case PointField::UINT16:
      return load<std::uint16_t>(bytes);
    case PointField::INT32:
      return load<std::int32_t>(bytes);
    case PointField::UINT32:
      return load<std::uint32_t>(bytes);
    case PointField::FLOAT32:
      return load<float>(bytes);
    case PointField::FLOAT64:
      return load<double>(bytes);
    default:
      return std::numeric_limits<double>::quiet_NaN();
  }
}

const PointField* find_field(const sensor_msgs::PointCloud2& cloud, const std::string& name) {
  for (const PointField& field : cloud.fields) {
    if (field.name == name) {
      if (field.offset + size_of(field.datatype) > cloud.point_step) {
        throw std::invalid_argument("the cloud's field '" + name + "' lies beyond its point_step " +
                                    std::to_string(cloud.point_step));
      }
      return &field;
    }
  }
  return nullptr;
}

std::string names_of_fields(const sensor_msgs::PointCloud2& cloud) {
  std::string names;
  for (const PointField& field : cloud.fields) {
    names += " " + field.name;
  }
  return names;
}

const PointField& coordinate(const sensor_msgs::PointCloud2& cloud, const std::string& name) {
  const PointField* field = find_field(cloud, name);
  if (field == nullptr) {
    throw std::invalid_argument("the cloud has no field '" + name + "' (it has:" +
                                names_of_fields(cloud) + "); publish x, y and z in metres");
  }
  if (field->datatype != PointField::FLOAT32 && field->datatype != PointField::FLOAT64) {
    throw std::invalid_argument("the cloud's field '" + name + "' is not a float; publish metres");
  }
  return *field;
}

void check_layout(const sensor_msgs::PointCloud2& cloud) {
  if (cloud.is_bigendian != 0) {
    throw std::invalid_argument("the cloud is big-endian, which is not supported");
  }
  const std::size_t used = static_cast<std::size_t>(cloud.point_step) * cloud.width;
  if (used > cloud.row_step ||
      static_cast<std::size_t>(cloud.row_step) * cloud.height > cloud.data.size()) {
    throw std::invalid_argument("the cloud holds " + std::to_string(cloud.data.size()) +
                                " bytes, fewer than its width, height, point_step and row_step "
                                "say; the message is damaged or truncated");
  }
}

Label to_label(double value) {
  return value >= 0.0 && value < kUnlabelled ? static_cast<Label>(value) : kUnlabelled;
}

}  // namespace

std::vector<LabeledPoint> points_from_cloud(const sensor_msgs::PointCloud2& cloud) {
  const PointField& x = coordinate(cloud, "x");
  const PointField& y = coordinate(cloud, "y");
  const PointField& z = coordinate(cloud, "z");
  const PointField* label = find_field(cloud, "label");
  const PointField* sigma = find_field(cloud, "sigma");
  check_layout(cloud);
  std::vector<LabeledPoint> points;
  points.reserve(static_cast<std::size_t>(cloud.width) * cloud.height);
  for (std::size_t row = 0; row < cloud.height; ++row) {
    const std::uint8_t* bytes = cloud.data.data() + row * cloud.row_step;
    for (std::size_t column = 0; column < cloud.width; ++column, bytes += cloud.point_step) {
      LabeledPoint point;
      point.position = {static_cast<float>(load_as(x.datatype, bytes + x.offset)),
                        static_cast<float>(load_as(y.datatype, bytes + y.offset)),
                        static_cast<float>(load_as(z.datatype, bytes + z.offset))};
      if (label != nullptr) {
        point.label = to_label(load_as(label->datatype, bytes + label->offset));
      }
      if (sigma != nullptr) {
        point.sigma = static_cast<float>(load_as(sigma->datatype, bytes + sigma->offset));
      }
      points.push_back(point);
    }
  }
  return points;
}

std::vector<double> values_from_cloud(const sensor_msgs::PointCloud2& cloud,
                                      const std::string& field) {
  const PointField* found = find_field(cloud, field);
  if (found == nullptr) {
    throw std::invalid_argument("the cloud has no field '" + field +
                                "' (it has:" + names_of_fields(cloud) + ")");
  }
  check_layout(cloud);
  std::vector<double> values;
  values.reserve(static_cast<std::size_t>(cloud.width) * cloud.height);
  for (std::size_t row = 0; row < cloud.height; ++row) {
    const std::uint8_t* bytes = cloud.data.data() + row * cloud.row_step + found->offset;
    for (std::size_t column = 0; column < cloud.width; ++column, bytes += cloud.point_step) {
      values.push_back(load_as(found->datatype, bytes));
    }
  }
  return values;
}

bool has_label_field(const sensor_msgs::PointCloud2& cloud) {
  return find_field(cloud, "label") != nullptr;
}

sensor_msgs::PointCloud2 cloud_from_points(const std::vector<LabeledPoint>& points,
                                           const std_msgs::Header& header) {
  sensor_msgs::PointCloud2 cloud;
  cloud.header = header;
  cloud.is_dense = 1;
  sensor_msgs::PointCloud2Modifier modifier(cloud);
  modifier.setPointCloud2Fields(5,
                                "x",
                                1,
                                PointField::FLOAT32,
                                "y",
                                1,
                                PointField::FLOAT32,
                                "z",
                                1,
                                PointField::FLOAT32,
                                "label",
                                1,
                                PointField::UINT16,
                                "sigma",
                                1,
                                PointField::FLOAT32);
  modifier.resize(points.size());
  sensor_msgs::PointCloud2Iterator<float> position(cloud, "x");
  sensor_msgs::PointCloud2Iterator<std::uint16_t> label(cloud, "label");
  sensor_msgs::PointCloud2Iterator<float> sigma(cloud, "sigma");
  for (const LabeledPoint& point : points) {
    for (int axis = 0; axis < 3; ++axis) {
      position[axis] = point.position[axis];
    }
    *label = point.label;
    *sigma = point.sigma;
    ++position;
    ++label;
    ++sigma;
  }
  return cloud;
}

sensor_msgs::PointCloud2 cloud_from_mesh(const TriangleMesh& mesh,
                                         const LabelSet& labels,
                                         const std_msgs::Header& header) {
  sensor_msgs::PointCloud2 cloud;
  cloud.header = header;
  cloud.is_dense = 1;
  sensor_msgs::PointCloud2Modifier modifier(cloud);
  modifier.setPointCloud2Fields(5,
                                "x",
                                1,
                                PointField::FLOAT32,
                                "y",
                                1,
                                PointField::FLOAT32,
                                "z",
                                1,
                                PointField::FLOAT32,
                                "label",
                                1,
                                PointField::UINT16,
                                "rgb",
                                1,
                                PointField::FLOAT32);
  modifier.resize(mesh.triangles.size());
  sensor_msgs::PointCloud2Iterator<float> position(cloud, "x");
  sensor_msgs::PointCloud2Iterator<std::uint16_t> label(cloud, "label");
  sensor_msgs::PointCloud2Iterator<std::uint8_t> color(cloud, "rgb");
  for (std::size_t f = 0; f < mesh.triangles.size(); ++f) {
    const Eigen::Vector3d center = facet_centroid(mesh.vertices, mesh.triangles[f]);
    for (int axis = 0; axis < 3; ++axis) {
      position[axis] = static_cast<float>(center[axis]);
    }
    *label = mesh.labels.empty() ? kUnlabelled : mesh.labels[f];
    const Rgb rgb = labels.color_of(*label);
    for (int channel = 0; channel < 3; ++channel) {
      color[channel] = rgb[2 - channel];  // stored as b, g, r
    }
    ++position;
    ++label;
    ++color;
  }
  return cloud;
}

}  // namespace facet_mapping
