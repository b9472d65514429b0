// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The fields of the panel Refine.
#pragma once

#include <QComboBox>
#include <QLabel>
#include <QLineEdit>
#include <QWidget>
#include <vector>

#include <rviz/config.h>

#include "facet_mapping/rviz/refine_settings.h"

namespace facet_mapping {

class RefineForm : public QWidget {
  Q_OBJECT

 public:
  explicit RefineForm(QWidget* parent = nullptr);

  RefineSettings settings() const;
  QString node() const { return node_->text().trimmed(); }
  /// Below the node's name.
  void show_presence(const QString& sentence, bool is_good);

  void load(const rviz::Config& config);
  void save(rviz::Config config) const;

 Q_SIGNALS:
  void changed();
  void node_changed();

 private:  // NOLINT(readability-redundant-access-specifiers): ends the signals for moc
  struct Choice {
    QString word;
    int value;
  };
  enum Column { kLeft = 0, kRight = 2, kWide = 4 };

  QComboBox* add_choice(const QString& label,
                        const QString& tip,
                        int row,
                        Column column,
                        const std::vector<Choice>& choices);
  QLineEdit* add_text(
      const QString& label, const QString& tip, int row, Column column, const QString& if_empty);
  void place(const QString& label, QWidget* field, const QString& tip, int row, Column column);
  void add_extent();
  void add_terms();
  void add_numbers();

  QLineEdit* node_ = nullptr;
  QLabel* presence_ = nullptr;
  QComboBox* region_ = nullptr;
  QComboBox* start_ = nullptr;
  QLineEdit* classes_ = nullptr;
  QComboBox* photometric_ = nullptr;
  QComboBox* semantic_ = nullptr;
  QLineEdit* levels_ = nullptr;
  QLineEdit* iterations_ = nullptr;
  QLineEdit* weight_ = nullptr;
  QLineEdit* smoothing_ = nullptr;
  QLineEdit* thin_plate_ = nullptr;
  QLineEdit* time_budget_ = nullptr;

  struct Saved {
    QString key;
    QComboBox* choice;
    QLineEdit* text;
  };
  std::vector<Saved> saved_;  // all fields, by their key in the configuration
};

}  // namespace facet_mapping
