// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The plot of both energies over the iterations of a refinement.
#pragma once

#include <QColor>
#include <QPainter>
#include <QRectF>
#include <QString>
#include <QWidget>
#include <vector>

#include "facet_mapping/rviz/energy_history.h"

namespace facet_mapping {

/// Two strips, since the energies have scales of their own: photometric above, semantic below.
/// A curve grows with the job and is broken between levels, as those are not comparable.
class EnergyPlot : public QWidget {
  Q_OBJECT

 public:
  explicit EnergyPlot(QWidget* parent = nullptr);

  void show_history(const EnergyHistory& history);

  QSize sizeHint() const override;
  QSize minimumSizeHint() const override;

 protected:
  void paintEvent(QPaintEvent* event) override;

 private:
  struct Strip {
    QRectF area;  // of the curve, without the text around it
    PlotAxis axis;
    std::vector<double> values;  // by sample
    QColor color;
    QString title;
  };

  Strip make_strip(const QString& title, const QColor& color, std::vector<double> values) const;
  std::vector<Strip> strips() const;
  /// Place k is that of sample k, from k to k + 1.
  double x_of(const QRectF& area, double place) const;
  void paint_frame(const Strip& strip, QPainter* painter) const;
  void paint_levels(const Strip& strip, QPainter* painter) const;
  void paint_curve(const Strip& strip, QPainter* painter) const;
  void paint_iterations(const QRectF& area, QPainter* painter) const;

  EnergyHistory history_;
};

}  // namespace facet_mapping
