// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// street_to_bag: a drive along the synthetic street as a dataset folder and a bag.
#include <algorithm>
#include <cstdio>
#include <exception>
#include <string>

#include <CLI/CLI.hpp>
#include <unistd.h>

#include "facet_mapping/io/dataset.h"
#include "facet_mapping/ros/dataset_bag.h"
#include "facet_mapping/synthetic/street_dataset.h"

namespace {

using namespace facet_mapping;

constexpr int kDefaultFrames = 40;

struct Options {
  std::string folder;
  bool no_bag = false;
  bool no_scans = false;
  bool no_shadows = false;
  StreetConfig street;
  StreetDatasetConfig dataset;
  DatasetBagOptions bag;
};

void add_street_options(CLI::App* app, Options* options) {
  StreetConfig& street = options->street;
  app->add_option("--frames", street.frames, "frames; default: all that fit --length, or 40")
      ->check(CLI::PositiveNumber);
  app->add_option(
         "--length", street.length_m, "metres of street; default: what --frames need, at least 60")
      ->check(CLI::Range(20.0, 5000.0));
  app->add_option("--seed", street.seed, "another seed, another street")->capture_default_str();
  app->add_option(
         "--bend", street.bend_rad, "largest heading of the S-curve, radians; 0 = straight")
      ->check(CLI::Range(-0.5, 0.5))
      ->capture_default_str();
  app->add_option("--spacing", street.frame_spacing_m, "metres between frames")
      ->check(CLI::Range(0.01, 100.0))
      ->capture_default_str();
  app->add_option("--cars", street.car_density, "share of parking places that are taken")
      ->check(CLI::Range(0.0, 1.0))
      ->capture_default_str();
}

void add_dataset_options(CLI::App* app, Options* options) {
  StreetDatasetConfig& dataset = options->dataset;
  app->add_option("--noise",
                  dataset.label_noise,
                  "errors of the segmentation: 0 = none, 1 = a small network's")
      ->check(CLI::Range(0.0, 100.0))
      ->capture_default_str();
  app->add_option("--noise-seed", dataset.seed, "seed of all noise")->capture_default_str();
  app->add_flag("--full-size", dataset.full_size, "1242 x 375 pixels instead of 621 x 188");
  app->add_option("--supersampling", dataset.view.supersampling, "samples per pixel and axis, odd")
      ->capture_default_str();
  app->add_flag("--no-shadows", options->no_shadows, "sun without shadows");
  app->add_flag("--no-scans", options->no_scans, "no LiDAR");
  app->add_option("--beams", dataset.lidar.beams, "LiDAR beams")
      ->check(CLI::Range(1, 1024))
      ->capture_default_str();
  app->add_flag("--no-bag", options->no_bag, "the dataset folder alone");
  app->add_option("--topic-prefix", options->bag.topic_prefix)->capture_default_str();
}

/// Fills in what was left out of --frames and --length.
void complete(const CLI::App& app, Options* options) {
  StreetConfig& street = options->street;
  const bool has_length = app.count("--length") > 0;
  if (app.count("--frames") == 0 && !has_length) {
    street.frames = kDefaultFrames;
  }
  if (!has_length) {
    street.length_m = std::max(
        street.length_m, (street.frames - 1) * street.frame_spacing_m + kStreetEndMargin + 0.01);
  }
  options->dataset.scans = !options->no_scans;
  options->dataset.view.shadows = !options->no_shadows;
}

/// One line that counts up; on a file or pipe only its end.
void print_progress(const char* what, std::size_t done, std::size_t total) {
  const bool terminal = isatty(STDERR_FILENO) != 0;
  if (terminal || done == total) {
    std::fprintf(stderr, "%s%s: %zu of %zu frames", terminal ? "\r" : "", what, done, total);
    std::fputs(done == total ? "\n" : "", stderr);
  }
}

void run(const Options& options) {
  const Street street = make_street(options.street);
  std::fprintf(stderr,
               "street: %.0f m, %zu facets, %zu frames\n",
               options.street.length_m,
               street.mesh.triangles.size(),
               street.trajectory.size());
  write_street_dataset(
      street, options.dataset, options.folder, [](std::size_t done, std::size_t total) {
        print_progress("dataset", done, total);
      });
  if (options.no_bag) {
    std::printf("%s\n", options.folder.c_str());
    return;
  }
  const std::string bag = options.folder + "/street.bag";
  write_dataset_bag(
      read_dataset(options.folder), bag, options.bag, [](std::size_t done, std::size_t total) {
        print_progress("bag", done, total);
      });
  std::printf("%s\n", bag.c_str());
}

}  // namespace

int main(int argc, char** argv) {
  Options options;
  CLI::App app{
      "Writes a drive along a synthetic street, with exact depth, labels and mesh, into "
      "OUTPUT_FOLDER: a dataset (left/ right/ labels/ gt_label/ gt_depth/ velodyne/ ...), "
      "ground_truth.ply and street.bag."};
  app.add_option("OUTPUT_FOLDER", options.folder, "made if missing")->required();
  add_street_options(&app, &options);
  add_dataset_options(&app, &options);
  CLI11_PARSE(app, argc, argv);
  try {
    complete(app, &options);
    run(options);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "street_to_bag: %s\n", error.what());
    return 1;
  }
  return 0;
}
