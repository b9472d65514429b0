// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "save_row.h"

#include <QFileDialog>
#include <QGridLayout>
#include <QPointer>

namespace facet_mapping {

SaveRow::SaveRow(QWidget* parent)
    : QWidget(parent),
      path_(new QLineEdit("~/refined.ply", this)),
      save_(new QPushButton("&Save mesh", this)),
      answer_(new QLabel(this)) {
  auto* choose = new QPushButton("...", this);
  choose->setFixedWidth(30);
  choose->setToolTip("Choose a file.");
  path_->setToolTip("PLY file on the node's machine; ~ is the home folder of the node.");
  save_->setToolTip("Writes the node's mesh as PLY.");
  answer_->setWordWrap(true);
  answer_->setTextInteractionFlags(Qt::TextSelectableByMouse);
  answer_->hide();
  auto* grid = new QGridLayout(this);
  grid->setContentsMargins(0, 0, 0, 0);
  grid->addWidget(path_, 0, 0);
  grid->addWidget(choose, 0, 1);
  grid->addWidget(save_, 0, 2);
  grid->addWidget(answer_, 1, 0, 1, 3);
  connect(path_, &QLineEdit::textEdited, this, &SaveRow::changed);
  connect(choose, &QPushButton::clicked, this, &SaveRow::choose_file);
  connect(save_, &QPushButton::clicked, this, &SaveRow::save_pressed);
}

void SaveRow::show_answer(const QString& html) {
  answer_->setText(html);
  answer_->show();
}

void SaveRow::choose_file() {
  const QPointer<SaveRow> self(this);  // another configuration may be loaded meanwhile
  const QString path =
      QFileDialog::getSaveFileName(this, "File for the mesh", path_->text(), "PLY (*.ply)");
  if (self && !path.isEmpty()) {
    path_->setText(path);
    Q_EMIT changed();
  }
}

}  // namespace facet_mapping
