// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The tree of classes among a display's properties: checkbox, colour, opacity, share of area.
#pragma once

#include <QObject>
#include <cstddef>
#include <vector>

#include <rviz/config.h>
#include <rviz/properties/bool_property.h>
#include <rviz/properties/color_property.h>
#include <rviz/properties/float_property.h>
#include <rviz/properties/string_property.h>

#include "facet_mapping/rviz/class_table.h"

namespace facet_mapping {

class ClassProperties : public QObject {
  Q_OBJECT

 public:
  explicit ClassProperties(rviz::Property* parent);

  /// What the user chose before; applied to each class as soon as it is known.
  void load(const rviz::Config& config);
  /// Adds what was chosen for classes that have not been met.
  void save(rviz::Config config) const;
  /// Adds what is new in the table and takes over its names and colours. What the user has set
  /// stays and is written into the table.
  void update(ClassTable* classes);
  /// By slot, 0..1. Classes of an earlier palette that the mesh does not have leave the tree.
  void show_shares(const ClassTable& classes, const std::vector<double>& shares);
  /// Writes the user's choices into the table.
  void apply(ClassTable* classes) const;

 Q_SIGNALS:
  void changed();

 private Q_SLOTS:
  void show_or_hide_all();
  void note_change();
  void note_color();

 private:  // NOLINT(readability-redundant-access-specifiers): ends the slots for moc
  struct Entry {
    rviz::BoolProperty* shown;
    rviz::ColorProperty* color;
    rviz::FloatProperty* alpha;
    rviz::StringProperty* share;
    bool has_own_color = false;  // chosen by the user, not by the palette
  };

  void add(const ClassStyle& style);
  void load_entry(const ClassStyle& style, Entry* entry);

  rviz::BoolProperty* root_;
  std::vector<Entry> entries_;  // by slot
  rviz::Config saved_;
  bool is_updating_ = false;
};

}  // namespace facet_mapping
