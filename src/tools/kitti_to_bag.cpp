// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// kitti_to_bag: a dataset folder as a bag.
#include <filesystem>
#include <iostream>
#include <string>

#include "tool_main.h"

#include "facet_mapping/io/dataset.h"
#include "facet_mapping/io/progress_bar.h"
#include "facet_mapping/ros/dataset_bag.h"

namespace {

using namespace facet_mapping;

struct Options {
  std::string folder;
  std::string bag;
  bool no_right = false;
  bool no_scans = false;
  bool no_labels = false;
  DatasetBagOptions bag_options;
};

void add_options(CLI::App& app, Options& options) {
  app.add_option("FOLDER",
                 options.folder,
                 "Dataset folder: KITTI odometry sequence, KITTI raw drive, or left/ right/ "
                 "calib.txt poses.txt times.txt")
      ->required();
  app.add_option("OUTPUT.bag", options.bag, "Bag to write (replaced if it exists)")->required();
  app.add_option("--prefix", options.bag_options.topic_prefix, "Beginning of the topic names")
      ->capture_default_str();
  app.add_option("--first", options.bag_options.first_frame, "First frame, counted from 0");
  app.add_option(
      "--last", options.bag_options.last_frame, "Last frame (default: the last there is)");
  app.add_option("--epoch",
                 options.bag_options.epoch,
                 "Unix time of the dataset's time 0, for folders that do not say it")
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
  app.add_flag("--no-right", options.no_right, "Leave the right camera out");
  app.add_flag("--no-scans", options.no_scans, "Leave the LiDAR out, to evaluate against it later");
  app.add_flag("--no-labels", options.no_labels, "Leave the segmentation out");
  app.footer(
      "Topics: PREFIX/camera_color_left/{image_raw,camera_info,segmentation},\n"
      "PREFIX/camera_color_right/{image_raw,camera_info}, PREFIX/velo/pointcloud, /tf, "
      "/tf_static.\n"
      "Frames: map -> base_link -> camera_color_left (optical) -> camera_color_right, "
      "velo_link.\n\n"
      "Example: kitti_to_bag ~/kitti/2011_09_26/2011_09_26_drive_0009_sync drive.bag");
}

// What is there and what is not, so that nothing is missing silently.
void print_summary(const Dataset& dataset,
                   const DatasetBagReport& report,
                   const DatasetBagOptions& options,
                   const std::string& bag) {
  std::cout << report.frames << " frames, " << report.messages << " messages, "
            << std::filesystem::file_size(bag) / 1000000 << " MB in " << bag << "\n";
  const auto say_missing = [&](bool wanted, std::size_t found, const char* what) {
    if (wanted && found < report.frames) {
      std::cout << report.frames - found << " of " << report.frames << " frames have no " << what
                << "\n";
    }
  };
  say_missing(options.with_right, dataset.has_right ? report.frames : 0, "right image");
  say_missing(options.with_scans, report.scans, "LiDAR scan");
  say_missing(options.with_labels, report.label_images, "segmentation image");
}

void run(Options& options) {
  options.bag_options.with_right = !options.no_right;
  options.bag_options.with_scans = !options.no_scans;
  options.bag_options.with_labels = !options.no_labels;
  const Dataset dataset = read_dataset(options.folder);
  ProgressBar bar("frames");
  const DatasetBagReport report = write_dataset_bag(
      dataset, options.bag, options.bag_options, [&bar](std::size_t done, std::size_t total) {
        bar.update(done, total);
      });
  print_summary(dataset, report, options.bag_options, options.bag);
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app("Writes a KITTI folder as a ROS bag with the usual topics.", "kitti_to_bag");
  Options options;
  add_options(app, options);
  return run_tool(app, argc, argv, [&options] { run(options); });
}
