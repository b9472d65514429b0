// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <filesystem>
#include <fstream>
#include <stdexcept>

#include "ply_comments.h"
#include "ply_cursor.h"
#include "ply_elements.h"
#include "ply_header.h"

#include "facet_mapping/io/ply.h"

namespace facet_mapping {
namespace {

std::string read_whole_file(const std::string& path) {
  std::error_code error;
  if (!std::filesystem::exists(path, error)) {
    throw std::runtime_error("there is no such file");
  }
  if (!std::filesystem::is_regular_file(path, error)) {
    throw std::runtime_error("it is not a file");
  }
  std::ifstream input(path, std::ios::binary);
  const std::uintmax_t size = std::filesystem::file_size(path, error);
  std::string content(error ? 0 : size, '\0');
  if (error || !input.read(content.data(), static_cast<std::streamsize>(content.size()))) {
    throw std::runtime_error("it cannot be read (permission?)");
  }
  return content;
}

MeshFile parse(const std::string& content) {
  const ply::Header header = ply::parse_header(content);
  ply::check_size(header, content.size());
  ply::Description description = ply::read_comments(header.comments);
  MeshFile file;
  file.frame_id = std::move(description.frame_id);
  file.labels = std::move(description.labels);
  ply::Cursor cursor(std::string_view(content).substr(header.body_offset), header.format);
  for (const ply::Element& element : header.elements) {
    ply::read_element(element, cursor, file.mesh);
  }
  if (file.mesh.empty()) {
    throw std::runtime_error("it holds no faces; a mesh is needed, not a point cloud");
  }
  validate(file.mesh);
  return file;
}

}  // namespace

MeshFile read_ply(const std::string& path) {
  try {
    return parse(read_whole_file(path));
  } catch (const std::exception& error) {
    throw std::runtime_error("cannot read the mesh '" + path + "': " + error.what());
  }
}

}  // namespace facet_mapping
