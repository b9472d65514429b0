// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "energy_plot.h"

#include <QPalette>
#include <QPolygonF>
#include <cmath>
#include <utility>

namespace facet_mapping {
namespace {

const QColor kPhotometricColor(230, 120, 0);
const QColor kSemanticColor(30, 110, 220);
constexpr int kMaxSteps = 3;      // of the upright axis
constexpr double kGap = 4.0;      // pixels between text and lines
constexpr double kDotSize = 3.0;  // pixels, half the width
constexpr double kLineWidth = 2.0;
const char* const kBelow = "iteration";

}  // namespace

EnergyPlot::EnergyPlot(QWidget* parent) : QWidget(parent) {
  setToolTip(
      "The energies that the refinement lowers, after each iteration. Each level is measured on "
      "images of its own size: compare only within a level.");
  QFont small = font();
  small.setPointSizeF(0.85 * small.pointSizeF());
  setFont(small);
}

void EnergyPlot::show_history(const EnergyHistory& history) {
  history_ = history;
  update();
}

QSize EnergyPlot::sizeHint() const {
  return {300, 12 * fontMetrics().height()};
}

QSize EnergyPlot::minimumSizeHint() const {
  return {180, 9 * fontMetrics().height()};
}

EnergyPlot::Strip EnergyPlot::make_strip(const QString& title,
                                         const QColor& color,
                                         std::vector<double> values) const {
  Strip strip;
  strip.title = title;
  strip.color = color;
  strip.axis = axis_over(values, kMaxSteps);
  strip.values = std::move(values);
  return strip;
}

std::vector<EnergyPlot::Strip> EnergyPlot::strips() const {
  std::vector<double> photometric;
  std::vector<double> semantic;
  for (const RefineProgress& sample : history_.samples()) {
    photometric.push_back(sample.energy.photometric);
    semantic.push_back(sample.energy.semantic);
  }
  std::vector<Strip> strips = {make_strip("photometric", kPhotometricColor, std::move(photometric)),
                               make_strip("semantic", kSemanticColor, std::move(semantic))};
  const double line = fontMetrics().height();
  const double left = fontMetrics().horizontalAdvance(QString("0") + kBelow) + kGap;
  const double right = fontMetrics().horizontalAdvance("00");
  const double strip_height = (height() - line - kGap) / static_cast<double>(strips.size());
  for (std::size_t k = 0; k < strips.size(); ++k) {
    const double top = static_cast<double>(k) * strip_height + line + kGap;
    strips[k].area = {left, top, width() - left - right, strip_height - line - 2.0 * kGap};
  }
  return strips;
}

double EnergyPlot::x_of(const QRectF& area, double place) const {
  return area.left() + place / static_cast<double>(history_.places()) * area.width();
}

void EnergyPlot::paint_frame(const Strip& strip, QPainter* painter) const {
  const QRectF& area = strip.area;
  const double line = fontMetrics().height();
  painter->fillRect(area, palette().base());
  painter->setPen(strip.color);
  painter->drawText(QRectF(area.left(), area.top() - line - 1.0, area.width(), line),
                    Qt::AlignLeft | Qt::AlignVCenter,
                    strip.title);
  painter->setPen(palette().color(QPalette::Mid));
  painter->setBrush(Qt::NoBrush);
  painter->drawRect(area);
  if (history_.samples().empty()) {
    return;
  }
  const int steps =
      static_cast<int>(std::lround((strip.axis.high - strip.axis.low) / strip.axis.step));
  for (int k = 0; k <= steps; ++k) {
    const double value = strip.axis.low + k * strip.axis.step;
    const double y = area.bottom() - strip.axis.share(value) * area.height();
    painter->setPen(QPen(palette().color(QPalette::Mid), 0.0, Qt::DotLine));
    painter->drawLine(QPointF(area.left(), y), QPointF(area.right(), y));
    painter->setPen(palette().color(QPalette::Text));
    painter->drawText(QRectF(0.0, y - 0.5 * line, area.left() - kGap, line),
                      Qt::AlignRight | Qt::AlignVCenter,
                      QString::fromStdString(strip.axis.text(value)));
  }
}

void EnergyPlot::paint_levels(const Strip& strip, QPainter* painter) const {
  const QRectF& area = strip.area;
  const auto levels = history_.levels();
  painter->setPen(palette().color(QPalette::Text));
  for (std::size_t k = 0; k < levels.size(); ++k) {
    const double x = x_of(area, static_cast<double>(levels[k].begin));
    if (k > 0) {
      painter->drawLine(QPointF(x, area.top()), QPointF(x, area.bottom()));
    }
    // At the lower left, where a falling curve leaves room.
    const QString text = QString("level %1").arg(levels[k].level);
    const double end =
        k + 1 < levels.size() ? x_of(area, static_cast<double>(levels[k + 1].begin)) : area.right();
    const QRectF place(x + kGap, area.top(), end - x - kGap, area.height() - 1.0);
    if (fontMetrics().horizontalAdvance(text) < place.width()) {
      painter->drawText(place, Qt::AlignLeft | Qt::AlignBottom, text);
    }
  }
}

void EnergyPlot::paint_curve(const Strip& strip, QPainter* painter) const {
  painter->setPen(QPen(strip.color, kLineWidth));
  painter->setBrush(strip.color);
  for (const EnergyHistory::Stretch& level : history_.levels()) {
    QPolygonF line;
    for (std::size_t k = level.begin; k < level.end; ++k) {
      if (!std::isfinite(strip.values[k])) {
        continue;
      }
      const double y =
          strip.area.bottom() - strip.axis.share(strip.values[k]) * strip.area.height();
      line.append({x_of(strip.area, static_cast<double>(k) + 0.5), y});
      painter->drawRect(QRectF(
          line.back().x() - 0.5 * kDotSize, line.back().y() - 0.5 * kDotSize, kDotSize, kDotSize));
    }
    painter->drawPolyline(line);
  }
}

void EnergyPlot::paint_iterations(const QRectF& area, QPainter* painter) const {
  const double line = fontMetrics().height();
  painter->setPen(palette().color(QPalette::Text));
  painter->drawText(QRectF(0.0, area.bottom() + kGap, area.left() - kGap, line),
                    Qt::AlignRight | Qt::AlignVCenter | Qt::TextDontClip,
                    kBelow);
  double free_from = area.left();
  for (std::size_t k = 0; k < history_.samples().size(); ++k) {
    const QString text = QString::number(history_.samples()[k].iteration + 1);
    const double half = 0.5 * fontMetrics().horizontalAdvance(text);
    const double x = x_of(area, static_cast<double>(k) + 0.5);
    if (x - half < free_from) {
      continue;
    }
    painter->drawText(QRectF(x - half, area.bottom() + kGap, 2.0 * half + 1.0, line),
                      Qt::AlignCenter | Qt::TextDontClip,
                      text);
    free_from = x + half + kGap;
  }
}

void EnergyPlot::paintEvent(QPaintEvent* /*event*/) {
  QPainter painter(this);
  const std::vector<Strip> all = strips();
  for (const Strip& strip : all) {
    paint_frame(strip, &painter);
    if (!history_.samples().empty()) {
      paint_levels(strip, &painter);
      paint_curve(strip, &painter);
    }
  }
  paint_iterations(all.back().area, &painter);
}

}  // namespace facet_mapping
