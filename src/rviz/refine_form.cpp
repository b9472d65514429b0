// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "refine_form.h"

#include <QGridLayout>

namespace facet_mapping {
namespace {

using Request = Refine::Request;

const char* const kLaunchFilesNode = "/refiner";
constexpr int kFieldWidth = 80;                // pixels, at least
const char* const kNodeParameter = "default";  // what a field shows that is left to the node

/// "Se&mantic" is saved as "Semantic".
QString key_of(const QString& label) {
  return QString(label).remove('&');
}

}  // namespace

RefineForm::RefineForm(QWidget* parent) : QWidget(parent) {
  auto* grid = new QGridLayout(this);
  grid->setContentsMargins(0, 0, 0, 0);
  grid->setVerticalSpacing(2);
  grid->setColumnStretch(1, 1);
  grid->setColumnStretch(3, 1);
  add_extent();
  add_terms();
  add_numbers();
}

void RefineForm::place(
    const QString& label, QWidget* field, const QString& tip, int row, Column column) {
  auto* name = new QLabel(label, this);
  name->setBuddy(field);
  name->setToolTip(tip);
  field->setToolTip(tip);
  field->setMinimumWidth(kFieldWidth);
  field->setSizePolicy(QSizePolicy::Ignored, QSizePolicy::Fixed);
  auto* grid = static_cast<QGridLayout*>(layout());
  const bool is_wide = column == kWide;
  grid->addWidget(name, row, is_wide ? 0 : column);
  grid->addWidget(field, row, is_wide ? 1 : column + 1, 1, is_wide ? 3 : 1);
}

QComboBox* RefineForm::add_choice(const QString& label,
                                  const QString& tip,
                                  int row,
                                  Column column,
                                  const std::vector<Choice>& choices) {
  auto* field = new QComboBox(this);
  field->setSizeAdjustPolicy(QComboBox::AdjustToMinimumContentsLengthWithIcon);
  for (const Choice& choice : choices) {
    field->addItem(choice.word, choice.value);
  }
  place(label, field, tip, row, column);
  saved_.push_back({key_of(label), field, nullptr});
  connect(field, QOverload<int>::of(&QComboBox::activated), this, &RefineForm::changed);
  return field;
}

QLineEdit* RefineForm::add_text(
    const QString& label, const QString& tip, int row, Column column, const QString& if_empty) {
  auto* field = new QLineEdit(this);
  field->setPlaceholderText(if_empty);
  place(label, field, tip, row, column);
  saved_.push_back({key_of(label), nullptr, field});
  connect(field, &QLineEdit::textEdited, this, &RefineForm::changed);
  return field;
}

void RefineForm::add_extent() {
  node_ = add_text("&Node", "Name of the refine node.", 0, kWide, "name of the refine node");
  node_->setText(kLaunchFilesNode);
  connect(node_, &QLineEdit::editingFinished, this, &RefineForm::node_changed);
  presence_ = new QLabel(this);
  presence_->setWordWrap(true);
  static_cast<QGridLayout*>(layout())->addWidget(presence_, 1, 1, 1, 3);
  region_ = add_choice("Re&gion",
                       "Refine all, or the box around the parts of the mesh in the present view.",
                       2,
                       kWide,
                       {{"all", 0}, {"what the view shows", 1}});
  classes_ = add_text("C&lasses",
                      "Refine only facets of these classes: names or ids between commas.",
                      3,
                      kWide,
                      "all");
  start_ =
      add_choice("St&art from",
                 "The mapper's newest mesh, or that with all that was refined.",
                 4,
                 kWide,
                 {{"the map", Request::START_MAP}, {"what was refined", Request::START_REFINED}});
}

void RefineForm::add_terms() {
  photometric_ =
      add_choice("Ph&otometric",
                 "Whether images that see the same place should look alike through the mesh.",
                 5,
                 kLeft,
                 {{kNodeParameter, Request::DEFAULT}, {"on", Request::ON}, {"off", Request::OFF}});
  semantic_ = add_choice("Se&mantic",
                         "How the segmentation moves the mesh: along its normals (normal), also "
                         "along the surface (full), so that contours move the shape and other "
                         "borders slide (split), between views (pairwise).",
                         5,
                         kRight,
                         {{kNodeParameter, Request::SEMANTIC_DEFAULT},
                          {"off", Request::SEMANTIC_OFF},
                          {"normal", Request::SEMANTIC_NORMAL},
                          {"full", Request::SEMANTIC_FULL},
                          {"split", Request::SEMANTIC_SPLIT},
                          {"pairwise", Request::SEMANTIC_PAIRWISE}});
}

void RefineForm::add_numbers() {
  const QString empty = " Empty: the node's parameter.";
  levels_ = add_text("Le&vels", "Of the image pyramid." + empty, 6, kLeft, kNodeParameter);
  iterations_ = add_text("&Iterations", "Per level." + empty, 6, kRight, kNodeParameter);
  weight_ = add_text("Sem. &weight",
                     "Of the semantic energy beside the photometric one." + empty,
                     7,
                     kLeft,
                     kNodeParameter);
  smoothing_ = add_text(
      "Smoo&thing", "Of the umbrella operator, 0 to 1." + empty, 7, kRight, kNodeParameter);
  thin_plate_ = add_text("Thin plat&e",
                         "Weight of the second-order smoothing, 0 to 1." + empty,
                         8,
                         kLeft,
                         kNodeParameter);
  time_budget_ = add_text(
      "&Budget [s]", "Wall time; then the best mesh so far is the result.", 8, kRight, "no limit");
}

RefineSettings RefineForm::settings() const {
  const auto value = [](const QComboBox* field) {
    return static_cast<std::uint8_t>(field->currentData().toInt());
  };
  RefineSettings settings;
  settings.visible_region = value(region_) != 0;
  settings.classes = classes_->text().toStdString();
  settings.start = value(start_);
  settings.photometric = value(photometric_);
  settings.semantic_mode = value(semantic_);
  settings.levels = levels_->text().toStdString();
  settings.iterations = iterations_->text().toStdString();
  settings.semantic_weight = weight_->text().toStdString();
  settings.smoothing = smoothing_->text().toStdString();
  settings.thin_plate = thin_plate_->text().toStdString();
  settings.time_budget = time_budget_->text().toStdString();
  return settings;
}

void RefineForm::show_presence(const QString& sentence, bool is_good) {
  if (presence_->text() == sentence) {
    return;
  }
  presence_->setText(sentence);
  QPalette colors = palette();
  if (!is_good) {
    colors.setColor(QPalette::WindowText, QColor(200, 40, 40));
  }
  presence_->setPalette(colors);
}

void RefineForm::load(const rviz::Config& config) {
  for (const Saved& field : saved_) {
    QString word;
    if (!config.mapGetString(field.key, &word)) {
      continue;
    }
    if (field.text != nullptr) {
      field.text->setText(word);
    } else if (const int index = field.choice->findText(word); index >= 0) {
      field.choice->setCurrentIndex(index);
    }
  }
  Q_EMIT node_changed();
}

void RefineForm::save(rviz::Config config) const {
  for (const Saved& field : saved_) {
    config.mapSetValue(field.key,
                       field.text != nullptr ? field.text->text() : field.choice->currentText());
  }
}

}  // namespace facet_mapping
