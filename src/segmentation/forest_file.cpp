// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Layout: magic line, then little-endian: versions, cells, counts, classes, nodes, roots, leaves,
// and the FNV-1a check sum of all before it.
#include <algorithm>
#include <cstring>
#include <fstream>
#include <iterator>
#include <stdexcept>

#include "cell_features.h"

#include "facet_mapping/io/atomic_file.h"
#include "facet_mapping/io/byte_stream.h"
#include "facet_mapping/segmentation/forest_model.h"

namespace facet_mapping {
namespace {

constexpr char kMagic[] = "facet_mapping forest\n";
constexpr std::int32_t kFileVersion = 1;

void put_text(const std::string& text, ByteWriter* writer) {
  writer->put_all(std::vector<char>(text.begin(), text.end()));
}

std::string get_text(ByteReader* reader) {
  const std::vector<char> text = reader->get_all<char>();
  return {text.begin(), text.end()};
}

std::runtime_error problem(const std::string& path, const std::string& sentence) {
  return std::runtime_error("The forest '" + path + "' " + sentence +
                            "; train it anew with train_segmenter");
}

std::string read_bytes(const std::string& path) {
  std::ifstream stream(path, std::ios::binary);
  if (!stream) {
    throw problem(path, "cannot be read: there is no such file, or no permission");
  }
  return {std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
}

/// The bytes between magic and check sum.
ByteReader open_bytes(const std::string& bytes, const std::string& path) {
  const std::size_t magic = sizeof(kMagic) - 1;
  if (bytes.compare(0, magic, kMagic) != 0) {
    throw problem(path, "is no forest that train_segmenter wrote");
  }
  std::uint64_t sum = 0;
  const std::size_t end = bytes.size() - std::min(bytes.size() - magic, sizeof(sum));
  std::memcpy(&sum, bytes.data() + end, bytes.size() - end);
  if (sum != checksum(bytes.data(), end)) {
    throw problem(path, "is damaged or truncated (its check sum is wrong)");
  }
  return {bytes.data() + magic, end - magic};
}

bool is_sound(const ForestModel& model) {
  const auto nodes = static_cast<std::int32_t>(model.nodes.size());
  const std::size_t leaves = model.classes.empty() ? 0 : model.leaves.size() / model.classes.size();
  bool sound = model.classes.size() >= 2 && !model.roots.empty() &&
               model.leaves.size() == leaves * model.classes.size();
  for (const std::int32_t root : model.roots) {
    sound = sound && root >= 0 && root < nodes;
  }
  for (std::int32_t k = 0; k < nodes && sound; ++k) {
    const ForestModel::Node& node = model.nodes[k];
    const auto is_child = [&](std::int32_t child) { return child > k && child < nodes; };
    sound = node.feature < 0
                ? node.left >= 0 && static_cast<std::size_t>(node.left) < leaves
                : node.feature < model.features && is_child(node.left) && is_child(node.right);
  }
  return sound;
}

ForestModel read_model(ByteReader* reader) {
  ForestModel model;
  model.cells.working_width = reader->get<std::int32_t>();
  model.cells.cell_px = reader->get<std::int32_t>();
  model.cells.use_view = reader->get<std::uint8_t>() != 0;
  model.features = reader->get<std::int32_t>();
  const auto classes = reader->get<std::uint64_t>();
  for (std::uint64_t k = 0; k < classes; ++k) {
    const auto id = reader->get<Label>();
    model.classes.push_back({id, get_text(reader)});
  }
  model.nodes = reader->get_all<ForestModel::Node>();
  model.roots = reader->get_all<std::int32_t>();
  model.leaves = reader->get_all<std::uint8_t>();
  return model;
}

}  // namespace

void save_forest(const ForestModel& model, const std::string& path) {
  std::vector<char> bytes(kMagic, kMagic + sizeof(kMagic) - 1);
  ByteWriter writer(&bytes);
  writer.put(kFileVersion);
  writer.put(static_cast<std::int32_t>(detail::kFeatureVersion));
  writer.put(static_cast<std::int32_t>(model.cells.working_width));
  writer.put(static_cast<std::int32_t>(model.cells.cell_px));
  writer.put(static_cast<std::uint8_t>(model.cells.use_view));
  writer.put(model.features);
  writer.put(static_cast<std::uint64_t>(model.classes.size()));
  for (const ForestClass& known : model.classes) {
    writer.put(known.id);
    put_text(known.name, &writer);
  }
  writer.put_all(model.nodes);
  writer.put_all(model.roots);
  writer.put_all(model.leaves);
  writer.put(checksum(bytes.data(), bytes.size()));
  AtomicFile file(path);
  file.write(bytes.data(), bytes.size());
  file.commit();
}

ForestModel load_forest(const std::string& path) {
  const std::string bytes = read_bytes(path);
  ByteReader reader = open_bytes(bytes, path);
  try {
    if (reader.get<std::int32_t>() != kFileVersion ||
        reader.get<std::int32_t>() != detail::kFeatureVersion) {
      throw problem(path, "was written by another version of train_segmenter");
    }
    ForestModel model = read_model(&reader);
    detail::check_cells(model.cells);
    if (!is_sound(model) || model.features != detail::feature_count(model.cells)) {
      throw problem(path, "contradicts itself");
    }
    return model;
  } catch (const std::logic_error& error) {  // out of range, cells
    throw problem(path, std::string("is damaged: ") + error.what());
  }
}

}  // namespace facet_mapping
