// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "shared_parameters.h"

namespace facet_mapping {

void add_label_file(ParameterTable* table, std::string* value) {
  table->add("label_file",
             value,
             "class list: a path, or a shipped one (cityscapes, kitti360, semantic_kitti, ade20k)");
}

void add_segmentation(ParameterTable* table, SegmentationInput* config) {
  add_label_file(table, &config->label_file);
  table->add("use_segmentation",
             &config->use_segmentation,
             "wait for `segmentation`; false: geometry without classes");
  table->add_choice<ImageTransport>(
      "segmentation_transport",
      &config->transport,
      {{"raw", ImageTransport::kRaw}, {"compressed", ImageTransport::kCompressed}},
      "compressed: PNG on `segmentation/compressed` (lossy formats are refused)");
  table->add("resize_segmentation",
             &config->resize,
             "resample label images of another size, but the same shape, to the nearest pixel");
  table->add("segmentation_timeout_s",
             &config->timeout_s,
             "s",
             "wall time that an image waits for its segmentation before it goes on unlabelled",
             kNotNegative);
  table->add(
      "cache_s", &config->cache_s, "s", "wall time that incomplete frames are kept", kPositive);
  table->add("min_confidence",
             &config->min_confidence,
             "",
             "above 0: pixels below this on `segmentation_confidence` are unlabelled",
             kUnit);
  table->add_check([config]() -> std::string {
    return config->timeout_s <= config->cache_s
               ? ""
               : "'segmentation_timeout_s' must not be above 'cache_s'";
  });
}

void add_pose(ParameterTable* table, PoseInput* config) {
  table->add("map_frame", &config->map_frame, "fixed frame of the map, root of the mesh");
  table->add("tf_timeout_s",
             &config->tf_timeout_s,
             "s",
             "wall time that a frame waits for its transform before it is dropped",
             kNotNegative);
  table->add("tf_queue_size",
             &config->tf_queue_size,
             "frames",
             "frames that may wait for their transform at once",
             {1, 100000});
  table->add_choice<TimeJumpPolicy>(
      "on_time_jump",
      &config->on_time_jump,
      {{"reset", TimeJumpPolicy::kReset}, {"ignore", TimeJumpPolicy::kIgnore}},
      "what to do when stamps jump back (a bag in a loop): forget everything, or go on");
  table->add_check([config]() -> std::string {
    return config->map_frame.empty() ? "'map_frame' is empty; give the fixed frame, e.g. map" : "";
  });
}

void add_sky(ParameterTable* table, SkyConfig* config) {
  table->add("sky/cell_px",
             &config->cell_px,
             "px",
             "one carving ray per square of this size that is sky all over; 0: none",
             {0, 1000});
  table->add("sky/range_m", &config->range_m, "m", "where the rays toward the sky end", kPositive);
}

void add_moving_camera(ParameterTable* table, MovingCameraConfig* config) {
  add_segmentation(table, &config->segmentation);
  add_pose(table, &config->pose);
  table->add("queue_size",
             &config->queue_size,
             "images",
             "images that may wait for the worker; further ones are dropped and counted",
             {1, 100000});
  table->add(
      "flush_after_s",
      &config->flush_after_s,
      "s",
      "after so long without motion (stamps) or images (wall time) points wait no longer for "
      "further views",
      kPositive);
  add_sky(table, &config->sky);
}

void add_output(ParameterTable* table, MeshOutput* config) {
  table->add("chunk_size_m",
             &config->chunk_size_m,
             "m",
             "edge of the grid cells in which the mesh is published",
             {0.1, kInfinity});
  table->add("marker_max_triangles",
             &config->marker_max_triangles,
             "triangles",
             "above this the marker is decimated (the mesh never is)",
             {100, 1e8});
}

}  // namespace facet_mapping
