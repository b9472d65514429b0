// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "labeled_mesh_display.h"

#include <algorithm>

#ifdef __GLIBC__
#include <malloc.h>
#endif

#include "qt_colors.h"
#include <pluginlib/class_list_macros.hpp>
#include <rviz/display_context.h>
#include <rviz/frame_manager.h>

namespace facet_mapping {
namespace {

// Uploading takes at most as long as the turn before took, within these bounds (seconds): the
// window stays alive, and a large mesh still comes within a few frames.
constexpr double kMinUploadTime = 0.01;
constexpr double kMaxUploadTime = 0.15;
constexpr std::size_t kManyFacets = 200000;  // less leaves no holes worth the time
constexpr float kReportInterval = 0.5F;      // seconds

/// A message's many arrays leave holes behind, which glibc would keep for good.
void give_back_memory() {
#ifdef __GLIBC__
  malloc_trim(0);
#endif
}

}  // namespace

LabeledMeshDisplay::LabeledMeshDisplay() {
  topic_ = new rviz::RosTopicProperty(
      "Topic",
      "",
      QString::fromStdString(ros::message_traits::datatype<LabeledMesh>()),
      "facet_mapping/LabeledMesh topic; the palette and get_mesh beside it are used, too.",
      this,
      SLOT(update_topic()));
  add_look_properties();
  add_limit_properties();
  class_properties_ = new ClassProperties(this);
  connect(class_properties_, SIGNAL(changed()), this, SLOT(update_classes()));
}

LabeledMeshDisplay::~LabeledMeshDisplay() = default;

void LabeledMeshDisplay::add_look_properties() {
  const char* slot = SLOT(update_look());
  mode_ = new rviz::EnumProperty("Color Mode", "class", "What the colours mean.", this, slot);
  mode_->addOption("class", static_cast<int>(ColorMode::kClass));
  mode_->addOption("confidence", static_cast<int>(ColorMode::kConfidence));
  mode_->addOption("normal", static_cast<int>(ColorMode::kNormal));
  mode_->addOption("height", static_cast<int>(ColorMode::kHeight));
  mode_->addOption("views", static_cast<int>(ColorMode::kViews));
  mode_->addOption("chunk", static_cast<int>(ColorMode::kChunk));
  mode_->addOption("flat", static_cast<int>(ColorMode::kFlat));
  flat_color_ =
      new rviz::ColorProperty("Color", QColor(200, 200, 200), "Mode flat.", mode_, slot, this);
  auto_height_ = new rviz::BoolProperty(
      "Auto Height", true, "Mode height: the ramp spans the mesh.", mode_, slot, this);
  min_height_ = new rviz::FloatProperty(
      "Min Height", 0.0F, "Mode height: lower end, z of the fixed frame [m].", mode_, slot, this);
  max_height_ = new rviz::FloatProperty(
      "Max Height", 10.0F, "Mode height: upper end, z of the fixed frame [m].", mode_, slot, this);
  full_views_ = new rviz::FloatProperty(
      "Full Views", 20.0F, "Mode views: number of images at the upper end.", mode_, slot, this);
  full_views_->setMin(1.0F);
  style_ = new rviz::EnumProperty("Style", "faces", "Faces, their edges, or both.", this, slot);
  style_->addOption("faces", static_cast<int>(MeshStyle::kFaces));
  style_->addOption("wireframe", static_cast<int>(MeshStyle::kWireframe));
  style_->addOption("both", static_cast<int>(MeshStyle::kBoth));
  lighting_ = new rviz::BoolProperty(
      "Lighting", true, "Facets that face the eye are brighter.", this, slot);
  alpha_ = new rviz::FloatProperty("Alpha", 1.0F, "Opacity of the whole mesh.", this, slot);
  alpha_->setMin(0.0F);
  alpha_->setMax(1.0F);
  cull_ = new rviz::BoolProperty(
      "Cull Back Faces", false, "Draw only facets seen from free space.", this, slot);
}

void LabeledMeshDisplay::add_limit_properties() {
  const char* slot = SLOT(update_look());
  cut_ = new rviz::BoolProperty(
      "Cut", false, "Leave out what lies above a height, to look inside.", this, slot);
  cut_height_ =
      new rviz::FloatProperty("Height", 3.0F, "z of the fixed frame [m].", cut_, slot, this);
  min_confidence_ = new rviz::FloatProperty(
      "Min Confidence", 0.0F, "Facets below (0..1) are left out.", this, slot);
  min_confidence_->setMin(0.0F);
  min_confidence_->setMax(1.0F);
  unseen_ = new rviz::BoolProperty(
      "Unseen Facets",
      false,
      "Draw also what only closes the surface through space that nobody saw (views 0).",
      this,
      slot);
  max_distance_ =
      new rviz::FloatProperty("Max Distance",
                              0.0F,
                              "From the eye [m]; what is farther is left out. 0: no limit.",
                              this,
                              slot);
  max_distance_->setMin(0.0F);
}

void LabeledMeshDisplay::onInitialize() {
  source_ = std::make_unique<MeshSource>(threaded_nh_);
  view_ = std::make_unique<MeshView>(scene_node_);
  update_look();
}

void LabeledMeshDisplay::load(const rviz::Config& config) {
  class_properties_->load(config.mapGetChild("Classes"));
  Display::load(config);
}

void LabeledMeshDisplay::save(rviz::Config config) const {
  Display::save(config);
  class_properties_->save(config.mapMakeChild("Classes"));
}

void LabeledMeshDisplay::setTopic(const QString& topic, const QString& /*datatype*/) {
  topic_->setString(topic);
}

void LabeledMeshDisplay::onEnable() {
  update_topic();
}

void LabeledMeshDisplay::onDisable() {
  source_->unsubscribe();
  store_.clear();
  view_->update(&store_, &classes_, 0.0);
}

void LabeledMeshDisplay::reset() {
  Display::reset();
  if (isEnabled() && source_) {
    update_topic();  // a new subscriber is sent the full mesh
  }
}

void LabeledMeshDisplay::update_topic() {
  if (!source_) {
    return;
  }
  store_.clear();
  source_->unsubscribe();
  clearStatuses();
  if (!isEnabled()) {
    return;
  }
  try {
    source_->subscribe(topic_->getTopicStd());
  } catch (const ros::Exception& error) {
    setStatus(rviz::StatusProperty::Error, "Topic", error.what());
  }
  since_report_ = kReportInterval;
}

Eigen::AlignedBox3d LabeledMeshDisplay::box_in_view(const Ogre::Camera& camera) const {
  return view_ ? view_->box_in_view(camera) : Eigen::AlignedBox3d();
}

MeshLook LabeledMeshDisplay::look() const {
  MeshLook look;
  look.mode = static_cast<ColorMode>(mode_->getOptionInt());
  look.style = static_cast<MeshStyle>(style_->getOptionInt());
  look.lighting = lighting_->getBool();
  look.cull_back_faces = cull_->getBool();
  look.alpha = alpha_->getFloat();
  look.min_confidence = min_confidence_->getFloat();
  look.unseen_facets = unseen_->getBool();
  look.max_distance = max_distance_->getFloat();
  look.cut = cut_->getBool();
  look.cut_height = cut_height_->getFloat();
  const float low = min_height_->getFloat();
  look.height_range = {low, std::max(max_height_->getFloat(), low + 1.0e-3F)};
  look.full_views = full_views_->getFloat();
  look.flat_color = from_qt(flat_color_->getColor());
  return look;
}

void LabeledMeshDisplay::update_look() {
  if (view_) {
    view_->material().set_look(look(), classes_.is_translucent());
    context_->queueRender();
  }
}

void LabeledMeshDisplay::update_classes() {
  class_properties_->apply(&classes_);
  upload_palette();
}

void LabeledMeshDisplay::upload_palette() {
  if (view_) {
    view_->material().set_palette(classes_.texels());
    update_look();  // a translucent class needs blending
  }
}

void LabeledMeshDisplay::show_new_classes() {
  class_properties_->update(&classes_);
  is_shape_new_ = true;  // a class that is named now is to be seen in the tree
  upload_palette();
}

void LabeledMeshDisplay::update(float wall_dt, float /*ros_dt*/) {
  const std::size_t known_classes = classes_.styles().size();
  const MeshSource::News news = source_->poll(&store_, &classes_);
  const double seconds = std::clamp(static_cast<double>(wall_dt), kMinUploadTime, kMaxUploadTime);
  if (view_->update(&store_, &classes_, seconds)) {
    is_shape_new_ = true;
    context_->queueRender();
  }
  if (news.palette || classes_.styles().size() != known_classes) {
    show_new_classes();
  }
  place();
  since_report_ += wall_dt;
  if (since_report_ >= kReportInterval) {
    since_report_ = 0.0F;
    report();
  }
}

void LabeledMeshDisplay::place() {
  if (!store_.has_mesh()) {
    return;
  }
  Ogre::Vector3 position;
  Ogre::Quaternion orientation;
  std::string problem;
  rviz::FrameManager* frames = context_->getFrameManager();
  // The mesh belongs to its frame, not to a moment: the newest transform is the right one.
  if (frames->getTransform(store_.frame_id(), ros::Time(), position, orientation)) {
    scene_node_->setPosition(position);
    scene_node_->setOrientation(orientation);
    setStatus(rviz::StatusProperty::Ok, "Transform", QString::fromStdString(store_.frame_id()));
    return;
  }
  if (!frames->frameHasProblems(store_.frame_id(), ros::Time(), problem)) {
    problem = "no transform from frame '" + store_.frame_id() + "' to the fixed frame";
  }
  setStatus(rviz::StatusProperty::Error, "Transform", QString::fromStdString(problem));
}

void LabeledMeshDisplay::update_height_range() {
  const Eigen::AlignedBox3d box = view_->box();
  if (!auto_height_->getBool() || box.isEmpty()) {
    return;
  }
  const Eigen::AlignedBox3d in_fixed_frame = box.transformed(fixed_from_mesh());
  min_height_->setFloat(static_cast<float>(in_fixed_frame.min().z()));
  max_height_->setFloat(static_cast<float>(in_fixed_frame.max().z()));
}

std::size_t LabeledMeshDisplay::waiting() const {
  return store_.waiting() + view_->waiting();
}

void LabeledMeshDisplay::report() {
  if (is_shape_new_ && waiting() == 0) {
    is_shape_new_ = false;
    if (view_->drawn() > drawn_before_ + kManyFacets) {
      drawn_before_ = view_->drawn();
      give_back_memory();
    }
    class_properties_->show_shares(classes_, area_shares(view_->area_by_slot_m2()));
  }
  update_height_range();
  if (topic_->getTopicStd().empty()) {
    setStatus(rviz::StatusProperty::Error, "Topic", "no topic is set");
  } else if (source_->publishers() == 0) {
    setStatus(rviz::StatusProperty::Warn, "Topic", "nobody publishes " + topic_->getTopic());
  } else if (source_->messages() == 0 && !store_.has_mesh()) {
    setStatus(rviz::StatusProperty::Warn, "Topic", "no message received yet");
  } else {
    setStatus(rviz::StatusProperty::Ok,
              "Topic",
              QString::number(source_->messages()) + " messages received");
  }
  report_mesh();
  report_faults();
}

void LabeledMeshDisplay::report_mesh() {
  if (!store_.has_mesh()) {
    deleteStatus("Mesh");
    return;
  }
  QString text = QString("%1 facets in %2 chunks, sequence %3")
                     .arg(view_->facets())
                     .arg(store_.size())
                     .arg(store_.sequence());
  if (waiting() > 0) {
    text += QString(", %1 chunks still to draw").arg(waiting());
  } else if (view_->facets() == 0) {
    text = "the mesh is empty";
  }
  setStatus(rviz::StatusProperty::Ok, "Mesh", text);
  if (source_->has_palette()) {
    setStatus(rviz::StatusProperty::Ok, "Palette", "received");
  } else {
    setStatus(rviz::StatusProperty::Warn,
              "Palette",
              "no palette beside the mesh: classes have no names and colours");
  }
}

void LabeledMeshDisplay::report_faults() {
  if (!source_->problem().empty()) {
    setStatus(rviz::StatusProperty::Warn, "Sequence", QString::fromStdString(source_->problem()));
  } else if (source_->is_waiting_for_full()) {
    setStatus(rviz::StatusProperty::Warn, "Sequence", "asking get_mesh for the whole mesh");
  } else if (source_->gaps() > 0) {
    setStatus(rviz::StatusProperty::Ok,
              "Sequence",
              QString("complete again after %1 gaps").arg(source_->gaps()));
  }
  const std::size_t bad_facets = view_->bad_facets();
  const std::size_t bad_chunks = view_->chunks_with_bad_attributes();
  if (bad_facets > 0 || bad_chunks > 0) {
    setStatus(
        rviz::StatusProperty::Warn,
        "Facets",
        QString("%1 facets left out (index out of range or vertex not finite), arrays of wrong "
                "length in %2 chunks: the publisher is at fault")
            .arg(bad_facets)
            .arg(bad_chunks));
  } else {
    deleteStatus("Facets");
  }
}

}  // namespace facet_mapping

PLUGINLIB_EXPORT_CLASS(facet_mapping::LabeledMeshDisplay, rviz::Display)
