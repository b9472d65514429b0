// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The lower part of the panel Refine: progress, energies, the answer.
#pragma once

#include <QLabel>
#include <QProgressBar>
#include <QWidget>
#include <string>
#include <vector>

#include "energy_plot.h"
#include <facet_mapping/RefineProgress.h>
#include <facet_mapping/Status.h>

#include "facet_mapping/rviz/energy_history.h"
#include "facet_mapping/rviz/refine_report.h"

namespace facet_mapping {

class RefineView : public QWidget {
  Q_OBJECT

 public:
  explicit RefineView(QWidget* parent = nullptr);

  /// A job has begun, of which nothing is known yet. The plot of the one before is cleared.
  void begin(const QString& sentence);
  void show_history(const EnergyHistory& history);
  /// The bar, and the last sample as a sentence after `who`.
  void show_progress(const RefineProgress& progress, const QString& who);
  /// Beside the bar.
  void show_note(const QString& sentence);
  /// No job of this panel runs any more; what was plotted stays.
  void end(bool is_done);

  void show_answer(const Status& status, const std::vector<ReportLine>& lines);
  /// What kept this panel from asking, or the node from answering.
  void show_problem(const std::string& sentence);
  void clear_answer();

 private:
  QProgressBar* bar_;
  QLabel* note_;
  EnergyPlot* plot_;
  QLabel* answer_;
};

/// "OK: sentence" as rich text: the word bold and in a colour that fits.
QString answer_html(const Status& status);
QString problem_html(const std::string& sentence);

}  // namespace facet_mapping
