// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "sweep_directions.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <optional>

#include <Eigen/Cholesky>

namespace facet_mapping::detail {
namespace {

constexpr std::size_t kImages = 4;        // whose pieces count
constexpr int kPiecePx = 14;              // side of a piece
constexpr double kFilled = 0.7;           // share of its pixels that must have a depth
constexpr double kLargestError = 0.02;    // of a piece from its plane, share of the inverse depth
constexpr double kSameDirection = 0.966;  // cosine of 15 degrees
constexpr double kOtherDirection = 0.87;  // cosine of 30 degrees
constexpr double kFacing = 0.94;          // cosine of 20 degrees
constexpr double kLeastShare = 0.06;      // of the pieces that must vote for a direction
constexpr std::size_t kLeastPieces = 10;
constexpr double kLeftOut = 0.05;  // share of the nearest and of the farthest pieces
constexpr double kMargin = 1.25;   // the planes reach so much nearer and farther

/// Inverse depths on a plane: gradient . (x, y, 1), the pixel counted from the middle.
std::optional<Eigen::Vector3d> fit_piece(const cv::Mat& inverse_depth, const cv::Rect& piece) {
  Eigen::Matrix3d matrix = Eigen::Matrix3d::Zero();
  Eigen::Vector3d right = Eigen::Vector3d::Zero();
  double squares = 0.0;
  int count = 0;
  for (int y = 0; y < piece.height; ++y) {
    const auto* row = inverse_depth.ptr<float>(piece.y + y) + piece.x;
    for (int x = 0; x < piece.width; ++x) {
      if (std::isfinite(row[x])) {
        const int across = x - piece.width / 2;
        const int down = y - piece.height / 2;
        const Eigen::Vector3d place(across, down, 1.0);
        matrix += place * place.transpose();
        right += row[x] * place;
        squares += static_cast<double>(row[x]) * row[x];
        ++count;
      }
    }
  }
  if (count < kFilled * piece.area()) {
    return std::nullopt;
  }
  const Eigen::Vector3d plane = matrix.ldlt().solve(right);
  const double error = std::sqrt(std::max(0.0, squares - plane.dot(right)) / count);
  if (!(error < kLargestError * plane.z())) {
    return std::nullopt;
  }
  return plane;
}

using Pieces = std::vector<SceneDirections::Piece>;

/// The pieces of about the same normal as the one that most agree with.
struct Direction {
  Eigen::Vector3d normal_sum = Eigen::Vector3d::Zero();
  std::size_t votes = 0;
};

Direction most_voted(const Pieces& pieces) {
  Direction best;
  for (const SceneDirections::Piece& candidate : pieces) {
    Direction direction;
    for (const SceneDirections::Piece& piece : pieces) {
      if (piece.normal.dot(candidate.normal) > kSameDirection) {
        direction.normal_sum += piece.normal;
        ++direction.votes;
      }
    }
    best = direction.votes > best.votes ? direction : best;
  }
  return best;
}

/// Where the pieces of a direction are; nothing if too few are in front of it.
std::optional<InverseRange> find_distances(const Pieces& pieces,
                                           const Eigen::Vector3d& normal,
                                           const Eigen::Vector3d& eye) {
  std::vector<double> inverse;
  for (const SceneDirections::Piece& piece : pieces) {
    const double distance = normal.dot(piece.center - eye);
    if (piece.normal.dot(normal) > kSameDirection && distance > 0.0) {
      inverse.push_back(1.0 / distance);
    }
  }
  if (inverse.size() < kLeastPieces) {
    return std::nullopt;
  }
  std::sort(inverse.begin(), inverse.end());
  const auto left_out = static_cast<std::size_t>(kLeftOut * static_cast<double>(inverse.size()));
  return InverseRange{inverse[left_out] / kMargin,
                      inverse[inverse.size() - 1 - left_out] * kMargin};
}

}  // namespace

void SceneDirections::add(const SweepImage& image) {
  std::vector<Piece> pieces;
  const PinholeCamera& camera = image.small_view.camera;
  for (int y = 0; y + kPiecePx <= image.inverse_depth.rows; y += kPiecePx) {
    for (int x = 0; x + kPiecePx <= image.inverse_depth.cols; x += kPiecePx) {
      const auto plane = fit_piece(image.inverse_depth, {x, y, kPiecePx, kPiecePx});
      if (!plane) {
        continue;
      }
      const Eigen::Vector2d middle(x + kPiecePx / 2, y + kPiecePx / 2);
      const Eigen::Vector3d ray = camera.ray(middle);
      Eigen::Vector3d normal(plane->x() * camera.fx, plane->y() * camera.fy, 0.0);
      normal.z() = plane->z() - normal.dot(ray);
      pieces.push_back({(image.view.world_from_cam.linear() * normal).normalized(),
                        image.view.world_from_cam * (ray / plane->z())});
    }
  }
  images_.push_back(std::move(pieces));
  if (images_.size() > kImages) {
    images_.pop_front();
  }
}

std::vector<PlaneDirection> SceneDirections::strongest(const View& view, int most) const {
  Pieces pieces;
  const Eigen::Vector3d axis = view.world_from_cam.linear().col(2);
  for (const Pieces& image : images_) {
    std::copy_if(image.begin(), image.end(), std::back_inserter(pieces), [&](const Piece& piece) {
      return piece.normal.dot(axis) < kFacing;
    });
  }
  const double least =
      std::max(static_cast<double>(kLeastPieces), kLeastShare * static_cast<double>(pieces.size()));
  std::vector<PlaneDirection> found;
  while (found.size() < static_cast<std::size_t>(most)) {
    const Direction direction = most_voted(pieces);
    if (static_cast<double>(direction.votes) < least) {
      break;
    }
    const Eigen::Vector3d normal = direction.normal_sum.normalized();
    const auto distances = find_distances(pieces, normal, view.center());
    if (distances) {
      found.push_back({view.world_from_cam.linear().transpose() * normal, *distances});
    }
    pieces.erase(std::remove_if(pieces.begin(),
                                pieces.end(),
                                [&](const Piece& piece) {
                                  return piece.normal.dot(normal) > kOtherDirection;
                                }),
                 pieces.end());
  }
  return found;
}

}  // namespace facet_mapping::detail
