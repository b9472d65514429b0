// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cstring>
#include <stdexcept>

#include "ply_comments.h"

#include "facet_mapping/io/atomic_file.h"
#include "facet_mapping/io/ply.h"

namespace facet_mapping {
namespace {

// Collects little-endian numbers and hands them on in large pieces.
class BinarySink {
 public:
  explicit BinarySink(AtomicFile& file) : file_(file) {}

  template <typename T>
  void put(T value) {
    char bytes[sizeof(T)];
    std::memcpy(bytes, &value, sizeof(T));
#if defined(__BYTE_ORDER__) && __BYTE_ORDER__ == __ORDER_BIG_ENDIAN__
    std::reverse(bytes, bytes + sizeof(T));
#endif
    buffer_.append(bytes, sizeof(T));
    if (buffer_.size() >= kPieceBytes) {
      flush();
    }
  }
  void put(const Rgb& color) {
    for (const std::uint8_t channel : color) {
      put(channel);
    }
  }
  void flush() {
    file_.write(buffer_);
    buffer_.clear();
  }

 private:
  static constexpr std::size_t kPieceBytes = 1U << 20U;
  AtomicFile& file_;
  std::string buffer_;
};

std::string header_of(const MeshFile& file) {
  const TriangleMesh& mesh = file.mesh;
  const std::string colors = "property uchar red\nproperty uchar green\nproperty uchar blue\n";
  std::string header = "ply\nformat binary_little_endian 1.0\n";
  for (const std::string& comment : ply::write_comments({file.frame_id, file.labels})) {
    header += "comment " + comment + "\n";
  }
  header += "element vertex " + std::to_string(mesh.vertices.size()) +
            "\nproperty double x\nproperty double y\nproperty double z\n" +
            (mesh.labels.empty() ? "" : colors) + "element face " +
            std::to_string(mesh.triangles.size()) + "\nproperty list uchar int vertex_indices\n";
  header += mesh.labels.empty() ? "" : "property ushort label\n";
  header += mesh.confidence.empty() ? "" : "property float confidence\n";
  header += mesh.views.empty() ? "" : "property ushort views\n";
  header += mesh.labels.empty() ? "" : colors;
  return header + "end_header\n";
}

// The class of most facets around each vertex (the lower id on a tie): what viewers that know no
// facet colours show.
std::vector<Label> vertex_labels(const TriangleMesh& mesh) {
  const Adjacency facets = vertex_facets(mesh);
  std::vector<Label> labels(mesh.vertices.size(), kUnlabelled);
  std::vector<Label> around;
  for (std::size_t v = 0; v < labels.size(); ++v) {
    around.clear();
    std::transform(
        facets.begin(v), facets.end(v), std::back_inserter(around), [&mesh](std::uint32_t f) {
          return mesh.labels[f];
        });
    std::sort(around.begin(), around.end());
    std::ptrdiff_t best = 0;
    for (auto run = around.begin(); run != around.end();) {
      const auto run_end = std::upper_bound(run, around.end(), *run);
      if (run_end - run > best) {
        best = run_end - run;
        labels[v] = *run;
      }
      run = run_end;
    }
  }
  return labels;
}

void write_vertices(const MeshFile& file, BinarySink& sink) {
  const TriangleMesh& mesh = file.mesh;
  const std::vector<Label> labels =
      mesh.labels.empty() ? std::vector<Label>() : vertex_labels(mesh);
  for (std::size_t v = 0; v < mesh.vertices.size(); ++v) {
    for (int axis = 0; axis < 3; ++axis) {
      sink.put(mesh.vertices[v][axis]);
    }
    if (!labels.empty()) {
      sink.put(file.labels.color_of(labels[v]));
    }
  }
}

void write_facets(const MeshFile& file, BinarySink& sink) {
  const TriangleMesh& mesh = file.mesh;
  for (std::size_t f = 0; f < mesh.triangles.size(); ++f) {
    sink.put<std::uint8_t>(3);
    for (const std::uint32_t v : mesh.triangles[f]) {
      sink.put(v);
    }
    if (!mesh.labels.empty()) {
      sink.put(mesh.labels[f]);
    }
    if (!mesh.confidence.empty()) {
      sink.put(mesh.confidence[f]);
    }
    if (!mesh.views.empty()) {
      sink.put(mesh.views[f]);
    }
    if (!mesh.labels.empty()) {
      sink.put(file.labels.color_of(mesh.labels[f]));
    }
  }
}

}  // namespace

void write_ply(const std::string& path, const MeshFile& file) {
  validate(file.mesh);
  if (file.mesh.empty()) {
    throw std::runtime_error("cannot write '" + path + "': the mesh has no facets");
  }
  if (file.mesh.vertices.size() > INT32_MAX) {
    throw std::runtime_error("cannot write '" + path + "': more than 2^31 vertices");
  }
  AtomicFile output(path);
  output.write(header_of(file));
  BinarySink sink(output);
  write_vertices(file, sink);
  write_facets(file, sink);
  sink.flush();
  output.commit();
}

}  // namespace facet_mapping
