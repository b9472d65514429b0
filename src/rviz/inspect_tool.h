// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The rviz tool facet_mapping/InspectFacet.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "facet_highlight.h"
#include <ros/node_handle.h>
#include <ros/publisher.h>
#include <rviz/properties/string_property.h>
#include <rviz/tool.h>

#include "facet_mapping/rviz/facet_info.h"
#include "facet_mapping/rviz/facet_pick.h"

namespace facet_mapping {

class LabeledMeshDisplay;

/// A click tells what is known of a facet; dragging moves the view as without the tool.
class InspectTool : public rviz::Tool {
  Q_OBJECT

 public:
  InspectTool();
  ~InspectTool() override;

  void onInitialize() override;
  void activate() override;
  void deactivate() override;
  void update(float wall_dt, float ros_dt) override;
  int processMouseEvent(rviz::ViewportMouseEvent& event) override;

 private Q_SLOTS:
  void advertise();

 private:  // NOLINT(readability-redundant-access-specifiers): ends the slots for moc
  void inspect(const PickRay& ray, const Eigen::Vector3d& eye);
  void show(const LabeledMeshDisplay& display, const FacetInfo& facet);
  void publish(const FacetInfo& facet);
  void clear_answer(const QString& text);

  rviz::StringProperty* topic_;
  rviz::StringProperty* display_;
  std::vector<rviz::StringProperty*> answer_;  // in the order of the texts of facet_info.h
  ros::NodeHandle nh_;
  ros::Publisher publisher_;
  std::unique_ptr<FacetHighlight> highlight_;
  const LabeledMeshDisplay* marked_ = nullptr;  // whose facet is highlighted; may be gone
  std::string map_id_;                          // of its mesh
  int pressed_x_ = 0;                           // pixels
  int pressed_y_ = 0;
};

}  // namespace facet_mapping
