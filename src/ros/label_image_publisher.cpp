// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "facet_mapping/ros/label_image_publisher.h"

#include <utility>

#include <cv_bridge/cv_bridge.h>
#include <sensor_msgs/image_encodings.h>

#include "facet_mapping/labels/label_image.h"
#include "facet_mapping/render/facet_renderer.h"
#include "facet_mapping/render/observed_mesh.h"

namespace facet_mapping {
namespace {

constexpr std::uint32_t kLatestOnly = 1;
constexpr Label kLargestNarrowId = 254;

/// CV_8UC1 with 255 for unlabelled.
cv::Mat narrow(const cv::Mat& ids) {
  cv::Mat narrow_ids;
  ids.convertTo(narrow_ids, CV_8U);  // saturates 65535 to 255
  return narrow_ids;
}

}  // namespace

LabelImagePublisher::LabelImagePublisher(ros::NodeHandle private_nh,
                                         const LabelSet& labels,
                                         std::function<MeshStatePtr()> mesh,
                                         const KeyframeStore* keyframes,
                                         NodeDiagnostics* diagnostics)
    : labels_(labels),
      mesh_(std::move(mesh)),
      keyframes_(keyframes),
      ids_pub_(private_nh.advertise<sensor_msgs::Image>("label_image", kLatestOnly)),
      color_pub_(private_nh.advertise<sensor_msgs::Image>("label_image_color", kLatestOnly)),
      jobs_(1, [diagnostics](const std::string& error) {
        diagnostics->complain("label image failed", error);
      }) {
  for (const ClassInfo& info : labels_.classes()) {  // ignored ones never come out of the mesh
    wide_ids_ = wide_ids_ || (!info.ignore && info.id > kLargestNarrowId);
  }
}

void LabelImagePublisher::update(const std_msgs::Header& header) {
  if (ids_pub_.getNumSubscribers() + color_pub_.getNumSubscribers() > 0) {
    jobs_.post([this, header] { render(header); });
  }
}

void LabelImagePublisher::render(const std_msgs::Header& header) {
  const MeshStatePtr state = mesh_();
  const std::optional<LabeledView> view = keyframes_->newest();
  if (!state || state->mesh.empty() || !view) {
    return;
  }
  const cv::Mat ids =
      label_image(ObservedMesh(state->mesh).render(make_renderer().get(), view->view), state->mesh);
  namespace encodings = sensor_msgs::image_encodings;
  const std::string& encoding = wide_ids_ ? encodings::MONO16 : encodings::MONO8;
  const cv::Mat pixels = wide_ids_ ? ids : narrow(ids);
  ids_pub_.publish(cv_bridge::CvImage(header, encoding, pixels).toImageMsg());
  if (color_pub_.getNumSubscribers() > 0) {
    const cv::Mat color = color_label_image(ids, labels_);
    color_pub_.publish(cv_bridge::CvImage(header, encodings::BGR8, color).toImageMsg());
  }
}

}  // namespace facet_mapping
