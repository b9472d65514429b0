// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Notices when stamps run backwards: a bag played in a loop, a restarted simulation.
#pragma once

#include <map>
#include <string>

#include <ros/time.h>

namespace facet_mapping {

class TimeJumpDetector {
 public:
  /// Smaller steps back are jitter between messages, not a jump.
  explicit TimeJumpDetector(double tolerance_s = 1.0) : tolerance_s_(tolerance_s) {}

  /// Takes the stamp of a message of `source`; true if it lies before the last one by more than
  /// the tolerance. After a jump every source starts anew, so that one jump is reported once.
  bool jumped_back(const std::string& source, const ros::Time& stamp) {
    const auto last = last_.find(source);
    const bool jumped = last != last_.end() && (last->second - stamp).toSec() > tolerance_s_;
    if (jumped) {
      jump_s_ = (last->second - stamp).toSec();
      last_.clear();
    }
    last_[source] = stamp;
    return jumped;
  }

  /// Size of the last jump in seconds.
  double jump_s() const { return jump_s_; }

 private:
  double tolerance_s_;
  double jump_s_ = 0.0;
  std::map<std::string, ros::Time> last_;
};

}  // namespace facet_mapping
