// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <stdexcept>

#include "shared_parameters.h"

#include "facet_mapping/ros/segmenter_node_config.h"

namespace facet_mapping {
namespace {

void add_colors(ParameterTable* table, NetworkConfig* c) {
  const char* const names[] = {"red", "green", "blue"};
  for (int k = 0; k < 3; ++k) {
    table->add(std::string("network/mean_") + names[k],
               &c->mean[k],
               "",
               "subtracted from the 8-bit values of this colour",
               {-1e6, 1e6});
  }
  for (int k = 0; k < 3; ++k) {
    table->add(std::string("network/deviation_") + names[k],
               &c->deviation[k],
               "",
               "then they are divided by this",
               kPositive);
  }
}

void add_network(ParameterTable* table, SegmenterNodeConfig* config) {
  NetworkConfig* c = &config->network;
  table->add(
      "network/input_width", &c->input_width, "px", "images are resized to this", {1, 16384});
  table->add(
      "network/input_height", &c->input_height, "px", "images are resized to this", {1, 16384});
  add_colors(table, c);
  table->add_choice<ChannelOrder>("network/channel_order",
                                  &c->channel_order,
                                  {{"rgb", ChannelOrder::kRgb}, {"bgr", ChannelOrder::kBgr}},
                                  "order of the network's input channels");
  table->add("network/output", &c->output, "name of the output to use; empty: the first");
  table->add(
      "network/class_map",
      &c->class_map,
      "YAML file with the class id of each channel; empty: the list's classes in their order");
  table->add("network/scales",
             &config->scales,
             "probabilities are averaged over these multiples of the input size, as texts");
  table->add_check([config]() -> std::string {
    try {
      return numbers_from(config->scales).empty() ? "'network/scales' is empty" : "";
    } catch (const std::invalid_argument& e) {
      return e.what();
    }
  });
}

}  // namespace

std::vector<double> numbers_from(const std::vector<std::string>& texts) {
  std::vector<double> numbers;
  for (const std::string& text : texts) {
    std::size_t used = 0;
    try {
      numbers.push_back(std::stod(text, &used));
    } catch (const std::logic_error&) {
      used = 0;
    }
    if (used == 0 || used != text.size()) {
      throw std::invalid_argument("'network/scales': '" + text +
                                  "' is no number; write e.g. ['0.75', '1.0']");
    }
  }
  return numbers;
}

ParameterTable parameter_table(SegmenterNodeConfig* config) {
  ParameterTable table;
  add_label_file(&table, &config->label_file);
  table.add_choice<SegmenterBackend>(
      "backend",
      &config->backend,
      {{"network", SegmenterBackend::kNetwork}, {"forest", SegmenterBackend::kForest}},
      "an ONNX network, or a forest of train_segmenter");
  table.add("model", &config->model, "path of the network's or the forest's file");
  table.add("min_confidence",
            &config->min_confidence,
            "",
            "pixels whose most likely class is less probable are unlabelled",
            kUnit);
  table.add("max_rate_hz",
            &config->max_rate_hz,
            "Hz",
            "images that come faster, by their stamps, are skipped; 0: none",
            kNotNegative);
  table.add("queue_size",
            &config->queue_size,
            "images",
            "images that may wait; a further one replaces the oldest, which is counted",
            {1, 100000});
  add_network(&table, config);
  table.add("forest/smoothing_cells",
            &config->forest.smoothing_cells,
            "cells",
            "radius of the edge-preserving smoothing; 0: none",
            {0, 100});
  table.add("forest/smoothing_edge",
            &config->forest.smoothing_edge,
            "",
            "grey steps (of 1) well above this keep their two sides apart",
            kPositive);
  table.add_check([config]() -> std::string {
    return config->model.empty() ? "'model' is empty; give the path of a network or a forest" : "";
  });
  return table;
}

}  // namespace facet_mapping
