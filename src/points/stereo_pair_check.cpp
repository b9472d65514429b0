// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "facet_mapping/points/stereo_pair_check.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <sstream>
#include <vector>

#include "stereo_checks.h"
#include <opencv2/imgproc.hpp>

#include "facet_mapping/geometry/median.h"

namespace facet_mapping {
namespace {

constexpr int kMostCorners = 120;
constexpr std::size_t kLeastCorners = 30;  // fewer say nothing
constexpr double kCornerQuality = 0.02;
constexpr double kCornerDistance = 12.0;  // pixels
constexpr int kPatchRadius = 6;           // pixels
constexpr int kWideImage = 800;           // pixels; wider ones are checked at half size
constexpr double kLeastCorrelation = 0.85;
constexpr double kLeastMargin = 0.05;   // of the best over the second-best correlation
constexpr int kPeakRadius = 3;          // pixels that belong to the best
constexpr double kSurelyShifted = 1.5;  // pixels; smaller disparities have no sure sign
constexpr double kSwappedShare = 0.5;

/// A corner of the left image found in the right one.
struct Match {
  double disparity = 0.0;   // pixels
  double row_error = 0.0;   // pixels
  double brightness = 1.0;  // right to left
};

std::string text(double value) {
  std::ostringstream stream;
  stream.precision(3);
  stream << value;
  return stream.str();
}

double contrast(const cv::Mat& image) {
  cv::Scalar mean;
  cv::Scalar deviation;
  cv::meanStdDev(image, mean, deviation);
  return deviation[0];
}

double median_or_zero(const std::vector<double>& values) {
  return values.empty() ? 0.0 : median(values);
}

/// Offset of a parabola's peak through three neighbours, in [-0.5, 0.5].
double peak_offset(double before, double at, double after) {
  const double curvature = before - 2.0 * at + after;
  return curvature < 0.0 ? std::clamp(0.5 * (before - after) / curvature, -0.5, 0.5) : 0.0;
}

/// Where `patch` lies in `area` beyond doubt, its upper left pixel.
std::optional<cv::Point2d> find_patch(const cv::Mat& patch, const cv::Mat& area) {
  cv::Mat scores;
  cv::matchTemplate(area, patch, scores, cv::TM_CCOEFF_NORMED);
  double best = 0.0;
  cv::Point at;
  cv::minMaxLoc(scores, nullptr, &best, nullptr, &at);
  const bool inside = at.x > 0 && at.y > 0 && at.x + 1 < scores.cols && at.y + 1 < scores.rows;
  if (best < kLeastCorrelation || !inside) {
    return std::nullopt;
  }
  const cv::Point2d found(
      at.x + peak_offset(scores.at<float>(at.y, at.x - 1), best, scores.at<float>(at.y, at.x + 1)),
      at.y + peak_offset(scores.at<float>(at.y - 1, at.x), best, scores.at<float>(at.y + 1, at.x)));
  const cv::Point radius(kPeakRadius, kPeakRadius);
  scores(cv::Rect(at - radius, at + radius + cv::Point(1, 1)) & cv::Rect({0, 0}, scores.size())) =
      -1.0;
  double second = 0.0;
  cv::minMaxLoc(scores, nullptr, &second);
  return best - second >= kLeastMargin ? std::optional<cv::Point2d>(found) : std::nullopt;
}

std::optional<Match> match_corner(const cv::Mat& left,
                                  const cv::Mat& right,
                                  const cv::Point& corner,
                                  const cv::Size& reach) {
  const cv::Rect image({0, 0}, left.size());
  const cv::Point radius(kPatchRadius, kPatchRadius);
  const cv::Rect patch(corner - radius, corner + radius + cv::Point(1, 1));
  const cv::Point margin(reach);
  const cv::Rect area = cv::Rect(patch.tl() - margin, patch.br() + margin) & image;
  if ((patch & image) != patch) {
    return std::nullopt;
  }
  const auto found = find_patch(left(patch), right(area));
  if (!found) {
    return std::nullopt;
  }
  const cv::Point2d in_right = *found + cv::Point2d(area.tl());
  const cv::Rect right_patch(cv::Point(cvRound(in_right.x), cvRound(in_right.y)), patch.size());
  return Match{patch.x - in_right.x,
               in_right.y - patch.y,
               (cv::mean(right(right_patch & image))[0] + 1.0) / (cv::mean(left(patch))[0] + 1.0)};
}

/// Fills the figures of the report.
void match_corners(const cv::Mat& left,
                   const cv::Mat& right,
                   double scale,
                   const StereoPairCheckConfig& config,
                   StereoPairReport* report) {
  std::vector<cv::Point2f> corners;
  cv::goodFeaturesToTrack(left, corners, kMostCorners, kCornerQuality, kCornerDistance);
  const cv::Size reach(cvRound(config.search_px / scale), cvRound(config.search_rows_px / scale));
  std::vector<double> row_errors;
  std::vector<double> brightness;
  std::size_t swapped = 0;
  for (const cv::Point2f& corner : corners) {
    if (const auto match = match_corner(left, right, corner, reach)) {
      row_errors.push_back(scale * std::abs(match->row_error));
      brightness.push_back(match->brightness);
      swapped += scale * match->disparity < -kSurelyShifted ? 1 : 0;
    }
  }
  report->corners = corners.size();
  report->matched = row_errors.size();
  report->swapped_share =
      row_errors.empty() ? 0.0
                         : static_cast<double>(swapped) / static_cast<double>(row_errors.size());
  report->row_error_px = median_or_zero(row_errors);
  report->brightness_ratio = brightness.empty() ? 1.0 : median_or_zero(brightness);
}

void set_problem(StereoPairReport* report, StereoPairProblem problem, const std::string& sentence) {
  report->problem = problem;
  report->sentence = sentence;
}

void judge(const StereoPairCheckConfig& config, StereoPairReport* report) {
  const auto matched = static_cast<double>(report->matched);
  const double ratio = report->brightness_ratio;
  const std::string found = std::to_string(report->matched) + " of " +
                            std::to_string(report->corners) + " corners of the left image";
  if (report->corners < kLeastCorners) {
    return;
  }
  if (matched < config.least_matched_share * static_cast<double>(report->corners)) {
    set_problem(report,
                StereoPairProblem::kNoMatch,
                "only " + found + " are found in the right one: the two do not show the same " +
                    "scene at the same moment; check that both cameras are triggered together, "
                    "rectified and exposed alike");
  } else if (report->swapped_share > kSwappedShare) {
    set_problem(report,
                StereoPairProblem::kSwapped,
                text(100.0 * report->swapped_share) + " % of the corners found in both images " +
                    "lie farther to the right in the right one: left and right are swapped; "
                    "exchange the left/ and right/ topics");
  } else if (report->row_error_px > config.largest_row_error_px) {
    set_problem(report,
                StereoPairProblem::kRowsDiffer,
                "corners lie on different rows of the two images, by " +
                    text(report->row_error_px) + " px (median): the pair is not rectified, its " +
                    "calibration is outdated or the images are not of the same moment; feed "
                    "rectified images (stereo_image_proc) of synchronised cameras");
  } else if (std::max(ratio, 1.0 / ratio) > config.largest_brightness_ratio) {
    set_problem(report,
                StereoPairProblem::kExposure,
                "the right image is " + text(ratio) + " times as bright as the left one, which " +
                    "costs matches: let both cameras share exposure and gain");
  }
}

/// Whether an image is blank; then the report says so.
bool is_blank(const cv::Mat& image,
              const std::string& name,
              const StereoPairCheckConfig& config,
              StereoPairReport* report) {
  const double found = image.empty() ? 0.0 : contrast(image);
  if (found >= config.least_contrast) {
    return false;
  }
  set_problem(report,
              StereoPairProblem::kBlank,
              "the " + name + " image is blank (grey values vary by " + text(found) +
                  " only): check lens cap, exposure and driver");
  return true;
}

}  // namespace

StereoPairReport check_stereo_pair(const cv::Mat& left,
                                   const cv::Mat& right,
                                   const StereoPairCheckConfig& config) {
  detail::check_stereo_pair(left, right);
  StereoPairReport report;
  if (is_blank(left, "left", config, &report) || is_blank(right, "right", config, &report)) {
    return report;
  }
  cv::Mat small_left = left;
  cv::Mat small_right = right;
  double scale = 1.0;
  if (left.cols > kWideImage) {
    scale = 2.0;
    cv::resize(left, small_left, {}, 0.5, 0.5, cv::INTER_AREA);
    cv::resize(right, small_right, {}, 0.5, 0.5, cv::INTER_AREA);
  }
  if (std::min(small_left.cols, small_left.rows) > 2 * kPatchRadius + 2) {
    match_corners(small_left, small_right, scale, config, &report);
    judge(config, &report);
  }
  return report;
}

}  // namespace facet_mapping
