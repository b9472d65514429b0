// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The rviz panel facet_mapping/Refine.
#pragma once

#include <QPushButton>
#include <QTimer>
#include <chrono>
#include <memory>
#include <optional>

#include "refine_form.h"
#include "refine_node.h"
#include "refine_view.h"
#include "save_row.h"
#include <rviz/panel.h>

#include "facet_mapping/rviz/energy_history.h"

namespace facet_mapping {

class RefinePanel : public rviz::Panel {
  Q_OBJECT

 public:
  explicit RefinePanel(QWidget* parent = nullptr);

  void onInitialize() override;
  void load(const rviz::Config& config) override;
  void save(rviz::Config config) const override;

 private:
  QWidget* make_buttons();
  QPushButton* make_button(const QString& text, const QString& tip, void (RefinePanel::*action)());

  void refine() { ask(false); }
  void dry_run() { ask(true); }
  void ask(bool dry_run);
  bool is_refining() const;
  void cancel();
  void save_mesh();

  void use_node();
  void poll();
  void show_presence();
  void on_progress(const RefineProgress& progress);
  void take_refine_answer();
  void take_cancel_answer();
  void take_save_answer();
  void watch_other_job();
  void update_buttons();

  RefineForm* form_;
  RefineView* view_;
  SaveRow* save_row_;
  QPushButton* refine_button_ = nullptr;
  QPushButton* dry_run_button_ = nullptr;
  QPushButton* cancel_button_ = nullptr;
  QTimer timer_;
  std::unique_ptr<RefineNode> node_;  // null before onInitialize()
  EnergyHistory history_;             // of the job last heard of
  bool is_job_own_ = false;           // whether this panel has asked for that job
  bool is_dry_run_ = false;           // the call under way, or the last one
  // When another client's job was last heard of; nothing: none is running as far as is known.
  std::optional<std::chrono::steady_clock::time_point> other_job_;
};

}  // namespace facet_mapping
