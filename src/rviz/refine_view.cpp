// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "refine_view.h"

#include <QVBoxLayout>
#include <algorithm>
#include <cmath>

namespace facet_mapping {
namespace {

constexpr int kBarSteps = 1000;
const char* const kGood = "#1e8c3c";
const char* const kStopped = "#b07800";
const char* const kBad = "#c82828";

QString bold(const QString& word, const char* color, const QString& rest) {
  return QString("<span style='color:%1'><b>%2</b></span> %3")
      .arg(color, word.toHtmlEscaped(), rest.toHtmlEscaped());
}

QString table_html(const std::vector<ReportLine>& lines) {
  QString rows;
  for (const ReportLine& line : lines) {
    rows += QString("<tr><td>%1&nbsp;&nbsp;</td><td>%2</td></tr>")
                .arg(QString::fromStdString(line.what).toHtmlEscaped(),
                     QString::fromStdString(line.value).toHtmlEscaped());
  }
  return rows.isEmpty() ? "" : "<table cellspacing='0'>" + rows + "</table>";
}

}  // namespace

QString answer_html(const Status& status) {
  const char* color = status.code == Status::OK          ? kGood
                      : status.code == Status::CANCELLED ? kStopped
                                                         : kBad;
  return bold(QString::fromStdString(status_word(status.code)),
              color,
              QString::fromStdString(status.message));
}

QString problem_html(const std::string& sentence) {
  return bold("Not done:", kBad, QString::fromStdString(sentence));
}

RefineView::RefineView(QWidget* parent)
    : QWidget(parent),
      bar_(new QProgressBar(this)),
      note_(new QLabel("no refinement is running", this)),
      plot_(new EnergyPlot(this)),
      answer_(new QLabel(this)) {
  auto* column = new QVBoxLayout(this);
  column->setContentsMargins(0, 0, 0, 0);
  column->setSpacing(3);
  column->addWidget(bar_);
  column->addWidget(note_);
  column->addWidget(plot_, 1);
  column->addWidget(answer_);
  bar_->setRange(0, kBarSteps);
  bar_->setValue(0);
  bar_->setTextVisible(false);
  note_->setWordWrap(true);
  answer_->setWordWrap(true);
  answer_->setTextFormat(Qt::RichText);
  answer_->setTextInteractionFlags(Qt::TextSelectableByMouse);
}

void RefineView::begin(const QString& sentence) {
  plot_->show_history({});
  bar_->setRange(0, 0);  // moves to and fro
  note_->setText(sentence);
}

void RefineView::show_history(const EnergyHistory& history) {
  plot_->show_history(history);
}

void RefineView::show_progress(const RefineProgress& progress, const QString& who) {
  bar_->setRange(0, kBarSteps);
  const double share = std::isfinite(progress.fraction) ? progress.fraction : 0.0;
  bar_->setValue(static_cast<int>(std::lround(std::clamp(share, 0.0, 1.0) * kBarSteps)));
  note_->setText(who + QString::fromStdString(progress_text(progress)));
}

void RefineView::show_note(const QString& sentence) {
  note_->setText(sentence);
}

void RefineView::end(bool is_done) {
  bar_->setRange(0, kBarSteps);
  if (is_done) {
    bar_->setValue(kBarSteps);
  }
  note_->setText("no refinement is running");
}

void RefineView::show_answer(const Status& status, const std::vector<ReportLine>& lines) {
  answer_->setText(answer_html(status) + table_html(lines));
}

void RefineView::show_problem(const std::string& sentence) {
  answer_->setText(problem_html(sentence));
}

void RefineView::clear_answer() {
  answer_->clear();
}

}  // namespace facet_mapping
