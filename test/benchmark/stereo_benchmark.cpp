// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Stereo points of one KITTI pair (1242x375, default configuration) on one thread: of the real one
// where FACET_MAPPING_DATA has it, else of a textured plane of that size. The label says which.
#include <cstdlib>
#include <random>
#include <string>

#include <benchmark/benchmark.h>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <tbb/global_control.h>

#include "facet_mapping/points/stereo_pair_check.h"
#include "facet_mapping/points/stereo_points.h"

namespace facet_mapping::benchmarking {
namespace {

constexpr int kWidth = 1242;
constexpr int kHeight = 375;
constexpr double kBaseline = 0.54325;  // metres

struct Pair {
  cv::Mat left;
  cv::Mat right;
  std::string name;
};

/// A road-like plane: the disparity grows down the image.
Pair make_plane() {
  Pair pair;
  pair.name = "synthetic plane";
  pair.left.create(kHeight, kWidth, CV_8UC1);
  std::mt19937 random(1);
  for (auto& pixel : cv::Mat_<std::uint8_t>(pair.left)) {
    pixel = static_cast<std::uint8_t>(random() >> 24U);
  }
  cv::GaussianBlur(pair.left, pair.left, {0, 0}, 1.5);
  cv::Mat map_x(pair.left.size(), CV_32F);
  cv::Mat map_y(pair.left.size(), CV_32F);
  for (int y = 0; y < kHeight; ++y) {
    for (int x = 0; x < kWidth; ++x) {
      map_x.at<float>(y, x) = static_cast<float>(x) + 5.0F + 0.25F * static_cast<float>(y);
      map_y.at<float>(y, x) = static_cast<float>(y);
    }
  }
  cv::remap(pair.left, pair.right, map_x, map_y, cv::INTER_LINEAR, cv::BORDER_REFLECT_101);
  return pair;
}

Pair load_pair() {
  const char* data = std::getenv("FACET_MAPPING_DATA");
  if (data != nullptr) {
    const std::string folder = std::string(data) + "/kitti_drive_0009/";
    Pair pair{cv::imread(folder + "left/000024.png", cv::IMREAD_GRAYSCALE),
              cv::imread(folder + "right/000024.png", cv::IMREAD_GRAYSCALE),
              "KITTI drive 0009, frame 24"};
    if (!pair.left.empty() && pair.left.size() == pair.right.size()) {
      return pair;
    }
  }
  return make_plane();
}

/// While it lives, OpenCV and TBB work on one thread.
class OneThread {
 public:
  OneThread() { cv::setNumThreads(1); }
  ~OneThread() { cv::setNumThreads(before_); }
  OneThread(const OneThread&) = delete;
  OneThread& operator=(const OneThread&) = delete;

 private:
  int before_ = cv::getNumThreads();
  tbb::global_control control_{tbb::global_control::max_allowed_parallelism, 1};
};

void match_only(benchmark::State& state) {
  const OneThread one_thread;
  const Pair pair = load_pair();
  for (auto _ : state) {
    benchmark::DoNotOptimize(stereo_disparity(pair.left, pair.right, {}));
  }
  state.SetLabel(pair.name);
}

void match_and_thin(benchmark::State& state) {
  const OneThread one_thread;
  const Pair pair = load_pair();
  const PinholeCamera camera{pair.left.cols, pair.left.rows, 721.5377, 721.5377, 609.5593, 172.854};
  std::size_t points = 0;
  for (auto _ : state) {
    points = stereo_points(pair.left, pair.right, {}, camera, kBaseline, {}).size();
  }
  state.counters["points"] = static_cast<double>(points);
  state.SetLabel(pair.name);
}

void check_pair(benchmark::State& state) {
  const OneThread one_thread;
  const Pair pair = load_pair();
  for (auto _ : state) {
    benchmark::DoNotOptimize(check_stereo_pair(pair.left, pair.right).matched);
  }
  state.SetLabel(pair.name);
}

BENCHMARK(match_only)
    ->Name("stereo/disparity")
    ->MeasureProcessCPUTime()
    ->Unit(benchmark::kMillisecond);
BENCHMARK(match_and_thin)
    ->Name("stereo/points")
    ->MeasureProcessCPUTime()
    ->Unit(benchmark::kMillisecond);
BENCHMARK(check_pair)
    ->Name("stereo/pair_check")
    ->MeasureProcessCPUTime()
    ->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace facet_mapping::benchmarking
