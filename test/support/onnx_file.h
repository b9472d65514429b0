// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Writes tiny networks as ONNX files: the few protocol buffer fields that they need.
#pragma once

#include <cstdint>
#include <fstream>
#include <string>
#include <vector>

namespace facet_mapping::testing {

/// A message of protocol buffers, field by field.
class ProtoMessage {
 public:
  ProtoMessage& number(int field, std::uint64_t value) {
    varint(static_cast<std::uint64_t>(field) << 3U);
    varint(value);
    return *this;
  }
  ProtoMessage& text(int field, const std::string& value) {
    varint((static_cast<std::uint64_t>(field) << 3U) | 2U);
    varint(value.size());
    bytes_ += value;
    return *this;
  }
  ProtoMessage& message(int field, const ProtoMessage& value) { return text(field, value.bytes_); }
  const std::string& bytes() const { return bytes_; }

 private:
  void varint(std::uint64_t value) {
    for (; value >= 128U; value >>= 7U) {
      bytes_ += static_cast<char>(value | 128U);
    }
    bytes_ += static_cast<char>(value);
  }

  std::string bytes_;
};

inline ProtoMessage onnx_tensor(const std::string& name,
                                const std::vector<int>& shape,
                                const std::vector<float>& values) {
  constexpr int kFloat = 1;
  ProtoMessage tensor;
  for (const int size : shape) {
    tensor.number(1, static_cast<std::uint64_t>(size));
  }
  tensor.number(2, kFloat).text(8, name);
  return tensor.text(9,
                     std::string(reinterpret_cast<const char*>(values.data()),  // little-endian
                                 values.size() * sizeof(float)));
}

inline ProtoMessage onnx_port(const std::string& name, const std::vector<int>& shape) {
  ProtoMessage dimensions;
  for (const int size : shape) {
    dimensions.message(1, ProtoMessage().number(1, static_cast<std::uint64_t>(size)));
  }
  const ProtoMessage tensor = ProtoMessage().number(1, 1).message(2, dimensions);
  return ProtoMessage().text(1, name).message(2, ProtoMessage().message(1, tensor));
}

/// A network of one 1 x 1 convolution: score of class k = weights[k] . channels + biases[k], for
/// inputs of one size.
inline std::string onnx_classifier(const std::vector<std::vector<float>>& weights,
                                   const std::vector<float>& biases,
                                   int width,
                                   int height) {
  const int classes = static_cast<int>(weights.size());
  std::vector<float> flat;
  for (const std::vector<float>& row : weights) {
    flat.insert(flat.end(), row.begin(), row.end());
  }
  constexpr int kInts = 7;
  const ProtoMessage kernel =
      ProtoMessage().text(1, "kernel_shape").number(8, 1).number(8, 1).number(20, kInts);
  const ProtoMessage node = ProtoMessage()
                                .text(1, "image")
                                .text(1, "weights")
                                .text(1, "biases")
                                .text(2, "scores")
                                .text(3, "classify")
                                .text(4, "Conv")
                                .message(5, kernel);
  const ProtoMessage graph = ProtoMessage()
                                 .message(1, node)
                                 .text(2, "classifier")
                                 .message(5, onnx_tensor("weights", {classes, 3, 1, 1}, flat))
                                 .message(5, onnx_tensor("biases", {classes}, biases))
                                 .message(11, onnx_port("image", {1, 3, height, width}))
                                 .message(12, onnx_port("scores", {1, classes, height, width}));
  constexpr int kIrVersion = 7;
  constexpr int kOperators = 11;
  return ProtoMessage()
      .number(1, kIrVersion)
      .message(7, graph)
      .message(8, ProtoMessage().text(1, "").number(2, kOperators))
      .bytes();
}

inline void write_bytes(const std::string& path, const std::string& bytes) {
  std::ofstream(path, std::ios::binary).write(bytes.data(), static_cast<long>(bytes.size()));
}

}  // namespace facet_mapping::testing
