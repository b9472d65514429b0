// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "class_properties.h"

#include <string>

#include "qt_colors.h"

namespace facet_mapping {
ClassProperties::ClassProperties(rviz::Property* parent)
    : QObject(parent),
      root_(new rviz::BoolProperty("Classes",
                                   true,
                                   "The classes met so far. The box here switches all.",
                                   parent,
                                   SLOT(show_or_hide_all()),
                                   this)) {}

void ClassProperties::load(const rviz::Config& config) {
  saved_ = config;
}

void ClassProperties::add(const ClassStyle& style) {
  Entry entry{};
  const QString name = QString::fromStdString(style.name);
  entry.shown = new rviz::BoolProperty(name,
                                       style.visible,
                                       "Whether facets of this class are drawn.",
                                       root_,
                                       SLOT(note_change()),
                                       this);
  entry.color = new rviz::ColorProperty("Color",
                                        to_qt(style.color),
                                        "Taken from the palette topic unless chosen here.",
                                        entry.shown,
                                        SLOT(note_color()),
                                        this);
  entry.alpha = new rviz::FloatProperty(
      "Alpha", style.alpha, "0: transparent, 1: opaque.", entry.shown, SLOT(note_change()), this);
  entry.alpha->setMin(0.0F);
  entry.alpha->setMax(1.0F);
  entry.share = new rviz::StringProperty(
      "Area", "", "Share of this class in the area of the whole mesh.", entry.shown);
  entry.share->setReadOnly(true);
  entry.share->setShouldBeSaved(false);
  load_entry(style, &entry);
  entries_.push_back(entry);
}

void ClassProperties::load_entry(const ClassStyle& style, Entry* entry) {
  const rviz::Config config = saved_.mapGetChild(QString::fromStdString(style.name));
  if (!config.isValid()) {
    return;
  }
  entry->shown->load(config);
  entry->has_own_color =
      config.mapGetChild("Color").isValid() && from_qt(entry->color->getColor()) != style.color;
}

void ClassProperties::save(rviz::Config config) const {
  for (rviz::Config::MapIterator saved = saved_.mapIterator(); saved.isValid(); saved.advance()) {
    if (!config.mapGetChild(saved.currentKey()).isValid()) {
      config.mapMakeChild(saved.currentKey()).copy(saved.currentChild());
    }
  }
}

void ClassProperties::update(ClassTable* classes) {
  is_updating_ = true;
  for (std::size_t slot = 0; slot < classes->styles().size(); ++slot) {
    const ClassStyle& style = classes->styles()[slot];
    if (slot >= entries_.size()) {
      add(style);
    }
    Entry& entry = entries_[slot];
    const QString name = QString::fromStdString(style.name);
    if (entry.shown->getName() != name) {  // another palette, or it came after the first facet
      entry.shown->setName(name);
      entry.has_own_color = false;
      load_entry(style, &entry);
    }
    if (!entry.has_own_color) {
      entry.color->setColor(to_qt(style.color));
    }
    entry.color->setShouldBeSaved(entry.has_own_color);
  }
  is_updating_ = false;
  apply(classes);
}

void ClassProperties::apply(ClassTable* classes) const {
  for (std::size_t slot = 0; slot < entries_.size() && slot < classes->styles().size(); ++slot) {
    ClassStyle& style = classes->style(slot);
    style.visible = entries_[slot].shown->getBool();
    style.alpha = entries_[slot].alpha->getFloat();
    style.color = from_qt(entries_[slot].color->getColor());
  }
}

void ClassProperties::show_shares(const ClassTable& classes, const std::vector<double>& shares) {
  for (std::size_t slot = 0; slot < entries_.size() && slot < shares.size(); ++slot) {
    entries_[slot].share->setString(QString::number(100.0 * shares[slot], 'f', 1) + " %");
    entries_[slot].shown->setHidden(!classes.styles()[slot].in_palette && shares[slot] == 0.0);
  }
}

void ClassProperties::show_or_hide_all() {
  is_updating_ = true;  // one change for the display, not one per class
  for (const Entry& entry : entries_) {
    entry.shown->setBool(root_->getBool());
  }
  is_updating_ = false;
  Q_EMIT changed();
}

void ClassProperties::note_change() {
  if (!is_updating_) {
    Q_EMIT changed();
  }
}

void ClassProperties::note_color() {
  if (is_updating_) {
    return;
  }
  for (Entry& entry : entries_) {
    entry.has_own_color |= sender() == entry.color;
    entry.color->setShouldBeSaved(entry.has_own_color);
  }
  Q_EMIT changed();
}

}  // namespace facet_mapping
