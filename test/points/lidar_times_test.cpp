// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// What drivers say about the time of a point, in every unit and reference.
#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <stdexcept>
#include <string>

#include <gtest/gtest.h>

#include "facet_mapping/points/lidar_scan.h"

namespace facet_mapping {
namespace {

constexpr double kStamp = 1.7e9 + 0.25;
const double kNan = std::numeric_limits<double>::quiet_NaN();

/// Times of an even scan, seconds, shuffled.
std::vector<double> even_scan(double first, double last, int count = 2000) {
  std::vector<double> times;
  for (int i = 0; i < count; ++i) {
    times.push_back(first + (last - first) * i / (count - 1));
  }
  std::mt19937 random(3);
  std::shuffle(times.begin(), times.end(), random);
  return times;
}

std::vector<double> scaled(std::vector<double> times, double factor, double shift = 0.0) {
  for (double& time : times) {
    time = (time + shift) * factor;
  }
  return times;
}

void expect_near(const std::vector<double>& a, const std::vector<double>& b, double tolerance) {
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t i = 0; i < a.size(); ++i) {
    ASSERT_NEAR(a[i], b[i], tolerance);
  }
}

struct Case {
  TimeUnit unit;
  double first;
  double last;
};

class PointTimesOfUnit : public testing::TestWithParam<Case> {};

TEST_P(PointTimesOfUnit, AreFoundRelativeAndAbsolute) {
  const std::vector<double> offsets = even_scan(GetParam().first, GetParam().last);
  const double units = 1.0 / seconds_per(GetParam().unit);
  const PointTimes relative = point_times(scaled(offsets, units), kStamp);
  EXPECT_EQ(relative.unit, GetParam().unit);
  EXPECT_FALSE(relative.absolute);
  EXPECT_EQ(relative.unusable, 0U);
  expect_near(relative.offsets_s, offsets, 1e-9);
  const PointTimes absolute = point_times(scaled(offsets, units, kStamp), kStamp);
  EXPECT_EQ(absolute.unit, GetParam().unit);
  EXPECT_TRUE(absolute.absolute);
  expect_near(absolute.offsets_s, offsets, 1e-6);  // of a double with a Unix time
}

INSTANTIATE_TEST_SUITE_P(Units,
                         PointTimesOfUnit,
                         testing::Values(Case{TimeUnit::kSeconds, 0.0, 0.1},
                                         Case{TimeUnit::kSeconds, -0.1, 0.0},
                                         Case{TimeUnit::kSeconds, -0.05, 0.05},
                                         Case{TimeUnit::kSeconds, 0.0, 0.0013},
                                         Case{TimeUnit::kMilliseconds, 0.0, 0.1},
                                         Case{TimeUnit::kMicroseconds, 0.0, 0.1},
                                         Case{TimeUnit::kNanoseconds, 0.0, 0.1},
                                         Case{TimeUnit::kNanoseconds, 0.0, 0.0013}));

TEST(PointTimes, UsualUnitDecidesWhereTwoFit) {
  const std::vector<double> packet_ns = scaled(even_scan(0.0, 4e-4), 1e9);  // or 0.4 s in us
  EXPECT_EQ(point_times(packet_ns, kStamp).unit, TimeUnit::kMicroseconds);
  PointTimeConfig config;
  config.usual_unit = TimeUnit::kNanoseconds;
  EXPECT_EQ(point_times(packet_ns, kStamp, config).unit, TimeUnit::kNanoseconds);
  // A whole turn in 0.1 ms is none: these are microseconds after all.
  EXPECT_EQ(point_times(scaled(even_scan(0.0, 0.1), 1e6), kStamp, config).unit,
            TimeUnit::kMicroseconds);
  config.unit = TimeUnit::kNanoseconds;
  EXPECT_EQ(point_times(scaled(even_scan(0.0, 0.1), 1e6), kStamp, config).unit,
            TimeUnit::kNanoseconds);
}

TEST(PointTimes, ZerosAndOtherConstantsAreNoMotion) {
  for (const bool absolute : {false, true}) {
    PointTimeConfig config;
    config.usually_absolute = absolute;
    const PointTimes times = point_times(std::vector<double>(50, 0.0), kStamp, config);
    EXPECT_TRUE(times.constant);
    expect_near(times.offsets_s, std::vector<double>(50, 0.0), 0.0);
  }
  const PointTimes times = point_times(std::vector<double>(50, kStamp + 0.01), kStamp);
  EXPECT_TRUE(times.constant);
  expect_near(times.offsets_s, std::vector<double>(50, 0.01), 1e-6);
}

TEST(PointTimes, RubbishAmongGoodTimesIsMarked) {
  const std::vector<double> offsets = even_scan(0.0, 0.1);
  std::vector<double> raw = scaled(offsets, 1.0, kStamp);
  raw[0] = kNan;
  raw[1] = 0.0;
  raw[2] = std::numeric_limits<double>::infinity();
  raw[3] = -1e300;
  const PointTimes times = point_times(raw, kStamp);
  EXPECT_EQ(times.unusable, 4U);
  for (std::size_t i = 0; i < raw.size(); ++i) {
    EXPECT_EQ(std::isfinite(times.offsets_s[i]), i > 3) << i;
  }
}

TEST(PointTimes, RefusesWhatSaysNothing) {
  const auto refused = [](const std::vector<double>& raw, const PointTimeConfig& config = {}) {
    try {
      point_times(raw, kStamp, config);
    } catch (const std::invalid_argument& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  EXPECT_NE(refused(std::vector<double>(10, kNan)).find("finite"), std::string::npos);
  // The clock of the sensor counts from its start.
  EXPECT_NE(refused(even_scan(5321.0, 5321.1)).find("clock"), std::string::npos);
  // The clock of the sensor is TAI.
  EXPECT_NE(refused(scaled(even_scan(0.0, 0.1), 1.0, kStamp + 37.0)).find("clock"),
            std::string::npos);
  PointTimeConfig config;
  config.unit = TimeUnit::kSeconds;
  EXPECT_NE(refused(scaled(even_scan(0.0, 0.1), 1e9), config).find(" in s"), std::string::npos);
  config.max_scan_s = 0.0;
  EXPECT_NE(refused({0.0}, config).find("max_scan_s"), std::string::npos);
  EXPECT_TRUE(point_times({}, kStamp).offsets_s.empty());
}

}  // namespace
}  // namespace facet_mapping
