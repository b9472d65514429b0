// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "timestamps.h"

#include <cmath>
#include <cstdio>
#include <ctime>
#include <fstream>

namespace facet_mapping {
namespace {

// Whole and fractional seconds apart: nanoseconds do not fit a double of Unix time.
struct Moment {
  std::time_t seconds = 0;
  double fraction = 0.0;
};

// "2011-09-26 13:02:25.964389445", taken as UTC.
bool parse_moment(const std::string& line, Moment& moment) {
  std::tm time{};
  double seconds = -1.0;
  const int fields = std::sscanf(line.c_str(),
                                 "%d-%d-%d %d:%d:%lf",
                                 &time.tm_year,
                                 &time.tm_mon,
                                 &time.tm_mday,
                                 &time.tm_hour,
                                 &time.tm_min,
                                 &seconds);
  if (fields != 6 || !(seconds >= 0.0 && seconds < 61.0)) {
    return false;
  }
  time.tm_year -= 1900;
  time.tm_mon -= 1;
  time.tm_sec = static_cast<int>(seconds);
  moment.seconds = timegm(&time);
  moment.fraction = seconds - std::floor(seconds);
  return true;
}

}  // namespace

std::vector<double> read_timestamps(const std::string& path, double& epoch, Problems& problems) {
  std::ifstream input(path);
  if (!input) {
    problems.add_missing(path);
  }
  std::vector<double> times;
  Moment first;
  int number = 0;
  for (std::string line; std::getline(input, line);) {
    ++number;
    Moment moment;
    if (line.find_first_not_of(" \t\r") == std::string::npos) {
      continue;
    }
    if (!parse_moment(line, moment)) {
      problems.add(path + " line " + std::to_string(number) +
                   " is no time such as '2011-09-26 13:02:25.964389445'");
    }
    first = times.empty() ? moment : first;
    times.push_back(static_cast<double>(moment.seconds - first.seconds) +
                    (moment.fraction - first.fraction));
    if (times.size() > 1 && times.back() <= times[times.size() - 2]) {
      problems.add(path + " line " + std::to_string(number) + " is not later than the line above");
    }
  }
  epoch = static_cast<double>(first.seconds) + first.fraction;
  return times;
}

}  // namespace facet_mapping
