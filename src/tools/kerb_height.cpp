// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// kerb_height: how a node of your own uses the labelled mesh. Asks for road and sidewalk, walks
// along the road and prints how high the kerb is on both sides.
//
// Example: rosrun facet_mapping kerb_height _mesh_node:=/mapper
//          rosrun facet_mapping kerb_height _mesh_node:=/refiner _refine:=true
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <map>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include <Eigen/Core>
#include <facet_mapping/ClassPalette.h>
#include <facet_mapping/GetMesh.h>
#include <facet_mapping/Refine.h>
#include <ros/ros.h>

#include "facet_mapping/geometry/median.h"
#include "facet_mapping/geometry/mesh.h"
#include "facet_mapping/ros/mesh_conversions.h"

namespace {

using namespace facet_mapping;

constexpr double kServiceWaitS = 30.0;
constexpr double kSampleSpacingM = 0.1;
constexpr double kMinUp = 0.7;       // of the normal: the kerb's face is neither road nor sidewalk
constexpr double kStationM = 2.0;    // one height per side and so much road
constexpr double kBandBeginM = 0.2;  // from the border: what lies nearer is rounded
constexpr double kBandEndM = 1.5;    // from the border: what lies farther says little about it
constexpr std::size_t kMinSamples = 20;

struct Side {
  std::vector<Eigen::Vector2d> road;  // distance from the axis (away from the road), height
  std::vector<Eigen::Vector2d> sidewalk;
};

/// Left and right of the axis.
using Station = std::array<Side, 2>;

void require(const Status& status) {
  if (status.code != Status::OK) {
    throw std::runtime_error(status.message);
  }
}

/// Calls a service of the node; throws if it does not come up.
template <typename Service>
void call(const std::string& name, Service* service) {
  if (!ros::service::waitForService(name, ros::Duration(kServiceWaitS)) ||
      !ros::service::call(name, *service)) {
    throw std::runtime_error("no answer from " + name + "; is the node running?");
  }
  require(service->response.status);
}

/// Ids by name: a mesh says which id a facet has, the palette what the id means.
std::map<std::string, Label> class_ids(const std::string& mesh_node) {
  const auto palette = ros::topic::waitForMessage<ClassPalette>(mesh_node + "/palette",
                                                                ros::Duration(kServiceWaitS));
  if (palette == nullptr) {
    throw std::runtime_error("no message on " + mesh_node + "/palette; is the node running?");
  }
  std::map<std::string, Label> ids;
  for (const PaletteClass& entry : palette->classes) {
    ids[entry.name] = entry.id;
  }
  return ids;
}

Label id_of(const std::map<std::string, Label>& ids, const std::string& name) {
  const auto found = ids.find(name);
  if (found == ids.end()) {
    throw std::runtime_error("the class list has no '" + name + "'; set ~road and ~sidewalk");
  }
  return found->second;
}

void refine(const std::string& mesh_node, const std::vector<Label>& classes) {
  Refine service;
  service.request.classes = classes;
  call(mesh_node + "/refine", &service);
  std::printf("%s\n", service.response.status.message.c_str());
}

/// The facets of the two classes, in the map frame (z up).
TriangleMesh get_mesh(const std::string& mesh_node, const std::vector<Label>& classes) {
  GetMesh service;
  service.request.classes = classes;
  call(mesh_node + "/get_mesh", &service);
  TriangleMesh mesh = mesh_from_message(service.response.mesh);
  const std::vector<Eigen::Vector3d> normals = facet_normals(mesh);
  std::vector<bool> keep;
  for (std::size_t f = 0; f < normals.size(); ++f) {
    keep.push_back(normals[f].z() > kMinUp && !is_gap(mesh, f));
  }
  return select_facets(mesh, keep);
}

/// Points on the facet, at most kSampleSpacingM apart.
template <typename Visit>
void sample(const TriangleMesh& mesh, std::size_t facet, const Visit& visit) {
  const Triangle& t = mesh.triangles[facet];
  const Eigen::Vector3d& a = mesh.vertices[t[0]];
  const Eigen::Vector3d u = mesh.vertices[t[1]] - a;
  const Eigen::Vector3d v = mesh.vertices[t[2]] - a;
  const double longest = std::max({u.norm(), v.norm(), (u - v).norm()});
  const int steps = std::max(1, static_cast<int>(std::ceil(longest / kSampleSpacingM)));
  for (int i = 0; i < steps; ++i) {
    for (int j = 0; j + i < steps; ++j) {
      visit(Eigen::Vector3d(a + u * ((i + 1.0 / 3.0) / steps) + v * ((j + 1.0 / 3.0) / steps)));
    }
  }
}

/// Middle of the road and the direction in which it extends most, seen from above.
struct Axis {
  Eigen::Vector2d origin = Eigen::Vector2d::Zero();
  Eigen::Vector2d along = Eigen::Vector2d::UnitX();
};

Axis axis_of(const TriangleMesh& mesh, Label road) {
  std::vector<Eigen::Vector2d> points;
  for (std::size_t f = 0; f < mesh.triangles.size(); ++f) {
    if (mesh.labels[f] == road) {
      sample(mesh, f, [&](const Eigen::Vector3d& p) { points.emplace_back(p.head<2>()); });
    }
  }
  if (points.empty()) {
    throw std::runtime_error("the mesh has no road");
  }
  Axis axis;
  for (const Eigen::Vector2d& p : points) {
    axis.origin += p / static_cast<double>(points.size());
  }
  Eigen::Matrix2d spread = Eigen::Matrix2d::Zero();
  for (const Eigen::Vector2d& p : points) {
    spread += (p - axis.origin) * (p - axis.origin).transpose();
  }
  const double angle = 0.5 * std::atan2(2.0 * spread(0, 1), spread(0, 0) - spread(1, 1));
  axis.along = {std::cos(angle), std::sin(angle)};  // never against x
  return axis;
}

std::map<int, Station> stations_of(const TriangleMesh& mesh, const Axis& axis, Label road) {
  const Eigen::Vector2d left(-axis.along.y(), axis.along.x());
  std::map<int, Station> stations;
  for (std::size_t f = 0; f < mesh.triangles.size(); ++f) {
    sample(mesh, f, [&](const Eigen::Vector3d& p) {
      const Eigen::Vector2d flat = p.head<2>() - axis.origin;
      const double lateral = flat.dot(left);
      const int number = static_cast<int>(std::floor(flat.dot(axis.along) / kStationM));
      Side& side = stations[number][lateral > 0.0 ? 0 : 1];
      (mesh.labels[f] == road ? side.road : side.sidewalk).emplace_back(std::abs(lateral), p.z());
    });
  }
  return stations;
}

/// The distance from the axis with the fewest samples on the wrong side of it.
double border_of(const Side& side) {
  std::vector<std::pair<double, int>> samples;
  for (const Eigen::Vector2d& sample : side.road) {
    samples.emplace_back(sample.x(), 1);
  }
  for (const Eigen::Vector2d& sample : side.sidewalk) {
    samples.emplace_back(sample.x(), -1);
  }
  std::sort(samples.begin(), samples.end());
  auto wrong = static_cast<int>(side.road.size());
  int best = wrong;
  double border = samples.front().first;
  for (const auto& [distance, step] : samples) {
    wrong -= step;
    if (wrong < best) {
      best = wrong;
      border = distance;
    }
  }
  return border;
}

/// Height at the border of the line through the samples between kBandBeginM and kBandEndM on one
/// side of it (1: outside, -1: inside); NaN with too few.
double height_at(double border, const std::vector<Eigen::Vector2d>& samples, double side) {
  std::vector<Eigen::Vector2d> band;
  for (const Eigen::Vector2d& sample : samples) {
    const double distance = side * (sample.x() - border);
    if (distance >= kBandBeginM && distance <= kBandEndM) {
      band.emplace_back(sample.x() - border, sample.y());
    }
  }
  if (band.size() < kMinSamples) {
    return std::nan("");
  }
  Eigen::Vector2d mean = Eigen::Vector2d::Zero();
  for (const Eigen::Vector2d& sample : band) {
    mean += sample / static_cast<double>(band.size());
  }
  double spread = 0.0;
  double product = 0.0;
  for (const Eigen::Vector2d& sample : band) {
    spread += (sample.x() - mean.x()) * (sample.x() - mean.x());
    product += (sample.x() - mean.x()) * (sample.y() - mean.y());
  }
  return mean.y() - product / std::max(spread, 1e-12) * mean.x();
}

/// NaN where road and sidewalk do not meet.
double kerb_height(const Side& side) {
  if (side.road.empty() || side.sidewalk.empty()) {
    return std::nan("");
  }
  const double border = border_of(side);
  return height_at(border, side.sidewalk, 1.0) - height_at(border, side.road, -1.0);
}

void print_heights(const std::map<int, Station>& stations) {
  const char* names[2] = {"left", "right"};
  std::vector<double> heights[2];
  std::printf("station_m side height_m\n");
  for (const auto& [number, station] : stations) {
    for (std::size_t side = 0; side < 2; ++side) {
      const double height = kerb_height(station[side]);
      if (std::isfinite(height)) {
        std::printf("%.1f %s %.3f\n", (number + 0.5) * kStationM, names[side], height);
        heights[side].push_back(height);
      }
    }
  }
  for (std::size_t side = 0; side < 2; ++side) {
    if (heights[side].empty()) {
      std::printf("%s: no border between road and sidewalk\n", names[side]);
    } else {
      const std::size_t count = heights[side].size();
      std::printf("%s: median %.3f m of %zu stations\n", names[side], median(heights[side]), count);
    }
  }
}

void run(const ros::NodeHandle& private_nh) {
  const auto mesh_node = private_nh.param<std::string>("mesh_node", "/mapper");
  const auto ids = class_ids(mesh_node);
  const Label road = id_of(ids, private_nh.param<std::string>("road", "road"));
  const Label sidewalk = id_of(ids, private_nh.param<std::string>("sidewalk", "sidewalk"));
  if (private_nh.param("refine", false)) {
    refine(mesh_node, {road, sidewalk});
  }
  const TriangleMesh mesh = get_mesh(mesh_node, {road, sidewalk});
  print_heights(stations_of(mesh, axis_of(mesh, road), road));
}

}  // namespace

int main(int argc, char** argv) {
  ros::init(argc, argv, "kerb_height", ros::init_options::AnonymousName);
  try {
    run(ros::NodeHandle("~"));
  } catch (const std::exception& e) {
    std::fprintf(stderr, "error: %s\n", e.what());
    return 1;
  }
  return 0;
}
