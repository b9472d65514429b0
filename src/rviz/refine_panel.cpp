// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "refine_panel.h"

#include <QHBoxLayout>
#include <QScrollArea>
#include <QScrollBar>
#include <QVBoxLayout>
#include <stdexcept>
#include <utility>

#include "shown_region.h"
#include <pluginlib/class_list_macros.hpp>
#include <rviz/visualization_manager.h>

namespace facet_mapping {
namespace {

constexpr int kPollInterval = 100;            // milliseconds
constexpr std::chrono::seconds kSilence(60);  // after it, another client's job counts as over
const char* const kPathKey = "Save to";
const char* const kOther = "started elsewhere: ";

}  // namespace

RefinePanel::RefinePanel(QWidget* parent)
    : Panel(parent), form_(new RefineForm), view_(new RefineView), save_row_(new SaveRow) {
  auto* content = new QWidget;
  auto* column = new QVBoxLayout(content);
  column->setContentsMargins(4, 4, 4, 4);
  column->setSpacing(4);
  column->addWidget(form_);
  column->addWidget(make_buttons());
  column->addWidget(view_, 1);
  column->addWidget(save_row_);
  auto* scroll = new QScrollArea;  // so that the panel fits beside others in a small window
  scroll->setWidgetResizable(true);
  scroll->setFrameShape(QFrame::NoFrame);
  scroll->setWidget(content);
  scroll->setHorizontalScrollBarPolicy(Qt::ScrollBarAlwaysOff);
  scroll->setMinimumWidth(content->minimumSizeHint().width() +
                          scroll->verticalScrollBar()->sizeHint().width());
  auto* outer = new QVBoxLayout(this);
  outer->setContentsMargins(0, 0, 0, 0);
  outer->addWidget(scroll);
  connect(form_, &RefineForm::changed, this, &RefinePanel::configChanged);
  connect(form_, &RefineForm::node_changed, this, &RefinePanel::use_node);
  connect(save_row_, &SaveRow::changed, this, &RefinePanel::configChanged);
  connect(save_row_, &SaveRow::save_pressed, this, &RefinePanel::save_mesh);
  connect(&timer_, &QTimer::timeout, this, &RefinePanel::poll);
  update_buttons();
}

QPushButton* RefinePanel::make_button(const QString& text,
                                      const QString& tip,
                                      void (RefinePanel::*action)()) {
  auto* button = new QPushButton(text);
  button->setToolTip(tip);
  button->setMinimumWidth(40);
  connect(button, &QPushButton::clicked, this, action);
  return button;
}

QWidget* RefinePanel::make_buttons() {
  refine_button_ = make_button("&Refine", "Starts the refinement.", &RefinePanel::refine);
  dry_run_button_ = make_button("&Dry run",
                                "Checks the request; measures the energies, and estimates time, "
                                "memory and facets. Changes nothing.",
                                &RefinePanel::dry_run);
  cancel_button_ = make_button("&Cancel",
                               "Stops the running refinement at its next iteration; the best mesh "
                               "so far is kept.",
                               &RefinePanel::cancel);
  auto* row = new QWidget;
  auto* line = new QHBoxLayout(row);
  line->setContentsMargins(0, 0, 0, 0);
  line->addWidget(refine_button_);
  line->addWidget(dry_run_button_);
  line->addWidget(cancel_button_);
  return row;
}

void RefinePanel::onInitialize() {
  node_ = std::make_unique<RefineNode>(
      vis_manager_->getUpdateQueue(),
      [this](const RefineProgress& progress) { on_progress(progress); });
  use_node();
  timer_.start(kPollInterval);
}

void RefinePanel::load(const rviz::Config& config) {
  Panel::load(config);
  QString path;
  if (config.mapGetString(kPathKey, &path)) {
    save_row_->set_path(path);
  }
  form_->load(config);
}

void RefinePanel::save(rviz::Config config) const {
  Panel::save(config);
  form_->save(config);
  config.mapSetValue(kPathKey, save_row_->path());
}

void RefinePanel::use_node() {
  if (!node_ || !node_->set_name(form_->node().toStdString())) {
    return;
  }
  other_job_.reset();
  history_.clear();
  view_->show_history(history_);
  poll();
}

void RefinePanel::poll() {
  node_->poll();
  show_presence();
  take_refine_answer();
  take_cancel_answer();
  take_save_answer();
  watch_other_job();
  update_buttons();
}

void RefinePanel::show_presence() {
  const QString name = QString::fromStdString(node_->name());
  switch (node_->presence()) {
    case RefineNode::Presence::kNoName:
      form_->show_presence("give the name of a node, such as /refiner", false);
      return;
    case RefineNode::Presence::kLooking:
      form_->show_presence("looking for " + name + " ...", true);
      return;
    case RefineNode::Presence::kThere:
      form_->show_presence(name + " is there", true);
      return;
    case RefineNode::Presence::kMissing:
      form_->show_presence("no node offers " + QString::fromStdString(node_->service("refine")),
                           false);
      return;
  }
}

bool RefinePanel::is_refining() const {
  return node_->refine.is_running() && !is_dry_run_;
}

void RefinePanel::ask(bool dry_run) {
  try {
    const RefineSettings settings = form_->settings();
    Refine::Request request =
        refine_request(settings,
                       shown_classes(*vis_manager_),
                       settings.visible_region ? region_in_view(*vis_manager_) : std::nullopt);
    request.dry_run = dry_run ? 1 : 0;
    node_->refine.call(node_->service("refine"), std::move(request));
  } catch (const std::invalid_argument& error) {
    view_->show_problem(error.what());
    return;
  }
  is_dry_run_ = dry_run;
  view_->clear_answer();
  if (!other_job_) {
    history_.clear();
    view_->begin(dry_run ? "dry run ..." : "preparing ...");
  }
  update_buttons();
}

void RefinePanel::cancel() {
  node_->cancel.call(node_->service("cancel_refine"), {});
  update_buttons();
}

void RefinePanel::save_mesh() {
  SaveMesh::Request request;
  request.path = save_row_->path().toStdString();
  node_->save.call(node_->service("save_mesh"), std::move(request));
  save_row_->show_answer("saving ...");
  update_buttons();
}

void RefinePanel::on_progress(const RefineProgress& progress) {
  if (history_.add(progress)) {
    is_job_own_ = is_refining();
  }
  view_->show_history(history_);
  if (!is_job_own_) {
    other_job_ = std::chrono::steady_clock::now();
    if (progress.fraction >= 1.0) {  // what is left of it cannot be cancelled
      other_job_.reset();
    }
    view_->show_progress(progress, kOther);
  } else if (is_refining()) {  // else the answer has overtaken the last message
    other_job_.reset();
    view_->show_progress(progress, "");
  }
}

void RefinePanel::take_refine_answer() {
  const auto outcome = node_->refine.take();
  if (!outcome) {
    return;
  }
  if (!outcome->problem.empty()) {
    view_->show_problem(outcome->problem);
  } else {
    view_->show_answer(outcome->response.status, report_lines(outcome->response, is_dry_run_));
  }
  if (!other_job_) {
    view_->end(outcome->problem.empty() && outcome->response.status.code == Status::OK &&
               !is_dry_run_);
  }
}

void RefinePanel::take_cancel_answer() {
  const auto outcome = node_->cancel.take();
  if (!outcome) {
    return;
  }
  if (outcome->problem.empty()) {  // a note, since the answer of the refinement is worth more
    const Status& status = outcome->response.status;
    view_->show_note(QString::fromStdString(status.message));
    if (status.code == Status::NOT_READY) {
      other_job_.reset();
    }
  } else if (is_refining()) {
    node_->refine.break_off();  // a node that is gone will not answer that call either
  } else {
    view_->show_problem(outcome->problem);
  }
}

void RefinePanel::take_save_answer() {
  if (const auto outcome = node_->save.take()) {
    save_row_->show_answer(outcome->problem.empty() ? answer_html(outcome->response.status)
                                                    : problem_html(outcome->problem));
  }
}

void RefinePanel::watch_other_job() {
  if (other_job_ && std::chrono::steady_clock::now() - *other_job_ > kSilence) {
    other_job_.reset();
    view_->show_note("no refinement is known to run");
  }
}

void RefinePanel::update_buttons() {
  const bool is_there = node_ && node_->presence() == RefineNode::Presence::kThere;
  const bool is_asking = node_ && node_->refine.is_running();
  const bool is_cancelling = node_ && node_->cancel.is_running();
  const bool is_saving = node_ && node_->save.is_running();
  refine_button_->setEnabled(is_there && !is_asking);
  dry_run_button_->setEnabled(is_there && !is_asking);
  cancel_button_->setEnabled(!is_cancelling &&
                             ((is_asking && !is_dry_run_) || (is_there && other_job_)));
  save_row_->set_ready(is_there && !is_saving);
}

}  // namespace facet_mapping

PLUGINLIB_EXPORT_CLASS(facet_mapping::RefinePanel, rviz::Panel)
