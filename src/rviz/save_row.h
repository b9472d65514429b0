// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The last row of the panel Refine: where to save the mesh.
#pragma once

#include <QLabel>
#include <QLineEdit>
#include <QPushButton>
#include <QWidget>

namespace facet_mapping {

class SaveRow : public QWidget {
  Q_OBJECT

 public:
  explicit SaveRow(QWidget* parent = nullptr);

  /// On the node's machine.
  QString path() const { return path_->text().trimmed(); }
  void set_path(const QString& path) { path_->setText(path); }
  /// Whether the node can be asked.
  void set_ready(bool is_ready) { save_->setEnabled(is_ready && !path().isEmpty()); }
  void show_answer(const QString& html);

 Q_SIGNALS:
  void changed();
  void save_pressed();

 private:  // NOLINT(readability-redundant-access-specifiers): ends the signals for moc
  void choose_file();

  QLineEdit* path_;
  QPushButton* save_;
  QLabel* answer_;
};

}  // namespace facet_mapping
