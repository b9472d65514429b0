// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Publishes wavy ground of 256 chunks, as a LabeledMesh or as a Marker, to measure displays with:
// big_mesh (mesh|marker) CELLS, of 512 * CELLS^2 facets (72: 2.65 million).
#include <cmath>
#include <cstdio>
#include <string>

#include <facet_mapping/ClassPalette.h>
#include <facet_mapping/LabeledMesh.h>
#include <ros/ros.h>
#include <visualization_msgs/Marker.h>

namespace {

constexpr int kChunksPerSide = 16;
constexpr double kChunkSize = 8.0;  // metres

double height(double x, double y) {
  return 2.0 * std::sin(0.3 * x) * std::cos(0.23 * y);
}

facet_mapping::LabeledMeshChunk make_chunk(int column, int row, int cells) {
  facet_mapping::LabeledMeshChunk chunk;
  chunk.key = {column, row, 0};
  chunk.origin.x = kChunkSize * column;
  chunk.origin.y = kChunkSize * row;
  for (int k = 0; k <= cells; ++k) {
    for (int i = 0; i <= cells; ++i) {
      geometry_msgs::Point32 v;
      v.x = static_cast<float>(kChunkSize * i / cells);
      v.y = static_cast<float>(kChunkSize * k / cells);
      v.z = static_cast<float>(height(chunk.origin.x + v.x, chunk.origin.y + v.y));
      chunk.vertex_ids.push_back(static_cast<std::uint32_t>(chunk.vertices.size()));
      chunk.vertices.push_back(v);
    }
  }
  for (int k = 0; k < cells; ++k) {
    for (int i = 0; i < cells; ++i) {
      const auto a = static_cast<std::uint32_t>(k * (cells + 1) + i);
      const std::uint32_t b = a + static_cast<std::uint32_t>(cells) + 1;
      chunk.triangles.insert(chunk.triangles.end(), {a, a + 1, b + 1, a, b + 1, b});
      chunk.labels.insert(chunk.labels.end(),
                          2,
                          static_cast<std::uint16_t>((column + row + 2 * kChunksPerSide) % 3));
      chunk.confidence.insert(chunk.confidence.end(), 2, static_cast<std::uint8_t>(i));
      chunk.views.insert(chunk.views.end(), 2, static_cast<std::uint16_t>(k));
    }
  }
  return chunk;
}

facet_mapping::LabeledMesh make_mesh(int cells) {
  facet_mapping::LabeledMesh mesh;
  mesh.header.frame_id = "map";
  mesh.map_id = "big";
  mesh.full = 1;
  for (int row = 0; row < kChunksPerSide; ++row) {
    for (int column = 0; column < kChunksPerSide; ++column) {
      mesh.chunks.push_back(
          make_chunk(column - kChunksPerSide / 2, row - kChunksPerSide / 2, cells));
    }
  }
  return mesh;
}

facet_mapping::ClassPalette make_palette() {
  facet_mapping::ClassPalette palette;
  const char* names[] = {"road", "building", "vegetation"};
  for (std::uint16_t id = 0; id < 3; ++id) {
    facet_mapping::PaletteClass entry;
    entry.id = id;
    entry.name = names[id];
    entry.color.r = id == 1 ? 0.9F : 0.3F;
    entry.color.g = id == 2 ? 0.8F : 0.3F;
    entry.color.b = id == 0 ? 0.7F : 0.2F;
    entry.color.a = 1.0F;
    palette.classes.push_back(entry);
  }
  return palette;
}

/// As mesh_markers makes it: a list of triangles in one colour.
visualization_msgs::Marker make_marker(const facet_mapping::LabeledMesh& mesh) {
  visualization_msgs::Marker marker;
  marker.header.frame_id = "map";
  marker.type = visualization_msgs::Marker::TRIANGLE_LIST;
  marker.pose.orientation.w = 1.0;
  marker.scale.x = marker.scale.y = marker.scale.z = 1.0;
  marker.color.r = marker.color.a = 1.0F;
  for (const auto& chunk : mesh.chunks) {
    for (const std::uint32_t k : chunk.triangles) {
      geometry_msgs::Point point;
      point.x = chunk.origin.x + static_cast<double>(chunk.vertices[k].x);
      point.y = chunk.origin.y + static_cast<double>(chunk.vertices[k].y);
      point.z = static_cast<double>(chunk.vertices[k].z);
      marker.points.push_back(point);
    }
  }
  return marker;
}

template <typename Message>
void publish_when_asked(ros::NodeHandle* nh, const std::string& topic, const Message& message) {
  ros::Publisher publisher = nh->advertise<Message>(topic, 1, true);
  while (ros::ok() && publisher.getNumSubscribers() == 0) {
    ros::WallDuration(0.05).sleep();
  }
  std::printf("published %.3f, %u bytes\n",
              ros::WallTime::now().toSec(),
              ros::serialization::serializationLength(message));
  std::fflush(stdout);
  publisher.publish(message);
  ros::spin();
}

}  // namespace

int main(int argc, char** argv) {
  ros::init(argc, argv, "big_mesh");
  if (argc != 3) {
    std::fprintf(stderr, "usage: big_mesh (mesh|marker) CELLS\n");
    return 2;
  }
  ros::NodeHandle nh;
  const facet_mapping::LabeledMesh mesh = make_mesh(std::stoi(argv[2]));
  if (std::string(argv[1]) == "marker") {
    publish_when_asked(&nh, "/mapper/mesh_marker", make_marker(mesh));
    return 0;
  }
  ros::Publisher palette = nh.advertise<facet_mapping::ClassPalette>("/mapper/palette", 1, true);
  palette.publish(make_palette());
  publish_when_asked(&nh, "/mapper/mesh", mesh);
  return 0;
}
