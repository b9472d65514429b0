// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The rviz display facet_mapping/LabeledMesh.
#pragma once

#include <memory>
#include <optional>

#include "class_properties.h"
#include "mesh_source.h"
#include "mesh_view.h"
#include <rviz/display.h>
#include <rviz/properties/bool_property.h>
#include <rviz/properties/color_property.h>
#include <rviz/properties/enum_property.h>
#include <rviz/properties/float_property.h>
#include <rviz/properties/ros_topic_property.h>

#include "facet_mapping/rviz/facet_info.h"

namespace facet_mapping {

class LabeledMeshDisplay : public rviz::Display {
  Q_OBJECT

 public:
  LabeledMeshDisplay();
  ~LabeledMeshDisplay() override;

  void load(const rviz::Config& config) override;
  void save(rviz::Config config) const override;
  void update(float wall_dt, float ros_dt) override;
  void reset() override;
  void setTopic(const QString& topic, const QString& datatype) override;

  // For the tools and panels beside it.
  std::string topic() const { return topic_->getTopicStd(); }
  const ChunkStore& store() const { return store_; }
  const ClassTable& classes() const { return classes_; }
  /// The facet that is seen first along a ray of the fixed frame, `eye` the camera's place there;
  /// nothing if there is none.
  std::optional<FacetInfo> inspect(const PickRay& ray, const Eigen::Vector3d& eye) const;
  /// Where the mesh stands at the moment.
  Eigen::Isometry3d fixed_from_mesh() const;
  /// Of the chunks that the camera sees, in the axes of store().frame_id(); empty if there is none.
  Eigen::AlignedBox3d box_in_view(const Ogre::Camera& camera) const;

 protected:
  void onInitialize() override;
  void onEnable() override;
  void onDisable() override;

 private Q_SLOTS:
  void update_topic();
  void update_look();
  void update_classes();

 private:  // NOLINT(readability-redundant-access-specifiers): ends the slots for moc
  void add_look_properties();
  void add_limit_properties();
  void upload_palette();
  MeshLook look() const;
  void place();
  void update_height_range();
  void show_new_classes();
  std::size_t waiting() const;  // chunks
  void report();
  void report_mesh();
  void report_faults();

  rviz::RosTopicProperty* topic_;
  rviz::EnumProperty* mode_ = nullptr;
  rviz::ColorProperty* flat_color_ = nullptr;
  rviz::BoolProperty* auto_height_ = nullptr;
  rviz::FloatProperty* min_height_ = nullptr;
  rviz::FloatProperty* max_height_ = nullptr;
  rviz::FloatProperty* full_views_ = nullptr;
  rviz::EnumProperty* style_ = nullptr;
  rviz::BoolProperty* lighting_ = nullptr;
  rviz::FloatProperty* alpha_ = nullptr;
  rviz::BoolProperty* cull_ = nullptr;
  rviz::BoolProperty* cut_ = nullptr;
  rviz::FloatProperty* cut_height_ = nullptr;
  rviz::FloatProperty* min_confidence_ = nullptr;
  rviz::BoolProperty* unseen_ = nullptr;
  rviz::FloatProperty* max_distance_ = nullptr;
  ClassProperties* class_properties_ = nullptr;

  std::unique_ptr<MeshSource> source_;
  std::unique_ptr<MeshView> view_;
  ChunkStore store_;
  ClassTable classes_;
  float since_report_ = 0.0F;     // seconds
  std::size_t drawn_before_ = 0;  // facets, when memory was given back last
  bool is_shape_new_ = false;     // since the last report
};

}  // namespace facet_mapping
