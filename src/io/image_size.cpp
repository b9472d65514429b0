// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "image_size.h"

#include <array>
#include <fstream>
#include <optional>

#include "facet_mapping/io/dataset.h"

namespace facet_mapping {
namespace {

constexpr int kEnd = std::ifstream::traits_type::eof();

int read_big_endian(std::istream& input, int bytes) {
  int value = 0;
  for (int k = 0; k < bytes; ++k) {
    value = value * 256 + (input.get() & 0xFF);
  }
  return value;
}

bool starts_with(std::istream& input, const std::string& signature) {
  std::string start(signature.size(), '\0');
  input.read(start.data(), static_cast<std::streamsize>(start.size()));
  const bool is_same = input && start == signature;
  input.clear();
  input.seekg(0);
  return is_same;
}

std::optional<cv::Size> png_size(std::istream& input) {
  constexpr std::streamoff kWidthAt = 16;  // signature, length and name of the chunk IHDR
  input.seekg(kWidthAt);
  const int width = read_big_endian(input, 4);
  const int height = read_big_endian(input, 4);
  return input ? std::optional(cv::Size(width, height)) : std::nullopt;
}

// SOF0 .. SOF15 without DHT, JPG and DAC, which lie between them.
bool is_frame_header(int marker) {
  return marker >= 0xC0 && marker <= 0xCF && marker != 0xC4 && marker != 0xC8 && marker != 0xCC;
}

// The next marker; fill bytes may stand before it.
int next_marker(std::istream& input) {
  int byte = input.get();
  while (byte == 0xFF) {
    byte = input.get();
  }
  return byte;
}

std::optional<cv::Size> jpeg_size(std::istream& input) {
  input.seekg(2);
  while (input.get() == 0xFF) {
    const int marker = next_marker(input);
    const int length = read_big_endian(input, 2);
    if (marker == kEnd || length < 2) {
      return std::nullopt;
    }
    if (is_frame_header(marker)) {
      input.get();  // bits per sample
      const int height = read_big_endian(input, 2);
      const int width = read_big_endian(input, 2);
      return input ? std::optional(cv::Size(width, height)) : std::nullopt;
    }
    input.seekg(length - 2, std::ios::cur);
  }
  return std::nullopt;
}

std::optional<cv::Size> size_in_header(const std::string& path) {
  std::ifstream input(path, std::ios::binary);
  std::optional<cv::Size> size;
  if (starts_with(input, "\x89PNG\r\n\x1A\n")) {
    size = png_size(input);
  } else if (starts_with(input, "\xFF\xD8\xFF")) {
    size = jpeg_size(input);
  }
  return size && size->width > 0 && size->height > 0 ? size : std::nullopt;
}

}  // namespace

cv::Size read_image_size(const std::string& path) {
  const std::optional<cv::Size> size = size_in_header(path);
  return size ? *size : read_gray(path).size();
}

}  // namespace facet_mapping
