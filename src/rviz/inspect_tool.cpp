// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "inspect_tool.h"

#include <QPainter>
#include <QPixmap>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <optional>

#include "labeled_mesh_display.h"
#include "shown_meshes.h"
#include <OgreCamera.h>
#include <OgreRay.h>
#include <OgreViewport.h>
#include <geometry_msgs/PointStamped.h>
#include <pluginlib/class_list_macros.hpp>
#include <rviz/display_context.h>
#include <rviz/load_resource.h>
#include <rviz/render_panel.h>
#include <rviz/view_controller.h>
#include <rviz/view_manager.h>
#include <rviz/viewport_mouse_event.h>

namespace facet_mapping {
namespace {

constexpr int kClickPixels = 3;  // more movement than that is dragging

struct Answer {
  const char* name;
  const char* meaning;
  std::string (*text)(const FacetInfo&);
};

constexpr std::array<Answer, 8> kAnswers{{
    {"Label", "Class: name and id.", class_text},
    {"Confidence", "Margin of the best over the second best class, 0 to 1.", confidence_text},
    {"Normal", "To free space, in the fixed frame.", normal_text},
    {"Slope", "Of the normal from z of the fixed frame: 0 floor, 90 wall.", slope_text},
    {"Area", "", area_text},
    {"Views", "Number of images that see the facet.", views_text},
    {"Chunk", "Cell of the mesh's grid: x, y, z.", chunk_text},
    {"Position", "Where the facet was clicked, in the mesh's frame.", position_text},
}};

QIcon make_icon() {
  QPixmap picture(20, 20);
  picture.fill(Qt::transparent);
  QPainter painter(&picture);
  painter.setRenderHint(QPainter::Antialiasing);
  const std::array<QPointF, 3> corners{QPointF(2.0, 16.0), QPointF(18.0, 13.0), QPointF(9.0, 2.0)};
  painter.setBrush(QColor(240, 220, 40));
  painter.setPen(QPen(QColor(60, 60, 60), 1.5));
  painter.drawPolygon(corners.data(), static_cast<int>(corners.size()));
  return {picture};
}

PickRay ray_through(const rviz::ViewportMouseEvent& event) {
  const Ogre::Ray ray = event.viewport->getCamera()->getCameraToViewportRay(
      static_cast<float>(event.x) / static_cast<float>(event.viewport->getActualWidth()),
      static_cast<float>(event.y) / static_cast<float>(event.viewport->getActualHeight()));
  const Ogre::Vector3& from = ray.getOrigin();
  const Ogre::Vector3& along = ray.getDirection();
  return {Eigen::Vector3d(from.x, from.y, from.z),
          Eigen::Vector3d(along.x, along.y, along.z).normalized()};
}

}  // namespace

InspectTool::InspectTool() {
  shortcut_key_ = 'l';
  topic_ = new rviz::StringProperty("Topic",
                                    "clicked_facet",
                                    "Each answer's position is published there (PointStamped).",
                                    getPropertyContainer(),
                                    SLOT(advertise()),
                                    this);
  const auto add = [this](const char* name, const char* meaning) {
    auto* property = new rviz::StringProperty(name, "", meaning, getPropertyContainer());
    property->setReadOnly(true);
    property->setShouldBeSaved(false);
    return property;
  };
  display_ = add("Display", "Whose mesh it is.");
  for (const Answer& answer : kAnswers) {
    answer_.push_back(add(answer.name, answer.meaning));
  }
}

InspectTool::~InspectTool() = default;

void InspectTool::onInitialize() {
  setName("Inspect Facet");
  setIcon(make_icon());
  setCursor(rviz::getDefaultCursor());
  highlight_ = std::make_unique<FacetHighlight>(scene_manager_);
  advertise();
}

void InspectTool::advertise() {
  try {
    publisher_ = nh_.advertise<geometry_msgs::PointStamped>(topic_->getStdString(), 1);
  } catch (const ros::Exception& error) {
    publisher_.shutdown();
    setStatus(QString("Inspect Facet publishes nothing: ") + error.what());
  }
}

void InspectTool::activate() {
  setStatus("Click a facet to see what is known of it; drag to move the view.");
}

void InspectTool::deactivate() {
  marked_ = nullptr;
  highlight_->hide();
}

void InspectTool::update(float /*wall_dt*/, float /*ros_dt*/) {
  if (marked_ == nullptr) {
    return;
  }
  const std::vector<LabeledMeshDisplay*> meshes = shown_meshes(*context_);
  if (std::find(meshes.begin(), meshes.end(), marked_) == meshes.end()) {
    clear_answer("");
  } else if (marked_->store().map_id() != map_id_) {
    clear_answer("the mesh of the facet is gone");
  } else {
    highlight_->place(marked_->fixed_from_mesh());  // it may move in the fixed frame
  }
}

int InspectTool::processMouseEvent(rviz::ViewportMouseEvent& event) {
  if (event.leftDown()) {
    pressed_x_ = event.x;
    pressed_y_ = event.y;
  }
  const bool is_click = event.leftUp() && std::abs(event.x - pressed_x_) <= kClickPixels &&
                        std::abs(event.y - pressed_y_) <= kClickPixels;
  if (rviz::ViewController* view = event.panel->getViewController()) {
    view->handleMouseEvent(event);
  }
  if (is_click) {
    const Ogre::Vector3& eye = event.viewport->getCamera()->getDerivedPosition();
    inspect(ray_through(event), {eye.x, eye.y, eye.z});
  }
  return Render;
}

void InspectTool::inspect(const PickRay& ray, const Eigen::Vector3d& eye) {
  const std::vector<LabeledMeshDisplay*> meshes = shown_meshes(*context_);
  std::optional<FacetInfo> nearest;
  const LabeledMeshDisplay* display = nullptr;
  for (const LabeledMeshDisplay* mesh : meshes) {
    std::optional<FacetInfo> facet = mesh->inspect(ray, eye);
    if (facet && (!nearest || facet->distance < nearest->distance)) {
      nearest = std::move(facet);
      display = mesh;
    }
  }
  if (!nearest) {
    clear_answer(meshes.empty() ? "no display facet_mapping/LabeledMesh is switched on"
                                : "no facet there");
    return;
  }
  show(*display, *nearest);
  publish(*nearest);
}

void InspectTool::show(const LabeledMeshDisplay& display, const FacetInfo& facet) {
  display_->setString(display.getName());
  for (std::size_t k = 0; k < kAnswers.size(); ++k) {
    answer_[k]->setStdString(kAnswers[k].text(facet));
  }
  marked_ = &display;
  map_id_ = display.store().map_id();
  highlight_->show(facet);
  highlight_->place(display.fixed_from_mesh());
  const std::string text = describe(facet);
  setStatus(QString::fromStdString(text));
  // To be kept and copied from.
  ROS_INFO_STREAM("Facet of " << display.getNameStd() << ": " << text);
}

void InspectTool::publish(const FacetInfo& facet) {
  if (!publisher_) {
    return;
  }
  geometry_msgs::PointStamped point;
  point.header.frame_id = facet.frame_id;
  point.header.stamp = ros::Time::now();
  point.point.x = facet.position.x();
  point.point.y = facet.position.y();
  point.point.z = facet.position.z();
  publisher_.publish(point);
}

void InspectTool::clear_answer(const QString& text) {
  marked_ = nullptr;
  highlight_->hide();
  display_->setString("");
  for (rviz::StringProperty* property : answer_) {
    property->setString("");
  }
  setStatus(text);
}

}  // namespace facet_mapping

PLUGINLIB_EXPORT_CLASS(facet_mapping::InspectTool, rviz::Tool)
