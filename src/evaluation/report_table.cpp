// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>
#include <functional>

#include "evaluation/text_table.h"

#include "facet_mapping/evaluation/report.h"

namespace facet_mapping {
namespace {

using Row = std::vector<std::string>;
using Value = std::function<double(const MeshEvaluation&)>;

class TableBuilder {
 public:
  TableBuilder(const std::vector<NamedEvaluation>& meshes, double metre)
      : meshes_(meshes), metre_(metre) {}

  void heading(const std::string& text) { rows_.push_back({text}); }
  void names() {
    Row row{""};
    for (const NamedEvaluation& mesh : meshes_) {
      row.push_back(mesh.name);
    }
    if (meshes_.size() > 1) {
      row.emplace_back("change");
    }
    rows_.push_back(row);
  }
  void count(const std::string& name, const Value& value) {
    add(
        name,
        value,
        [](double number) { return grouped_digits(static_cast<std::size_t>(number)); },
        "");
  }
  void length(const std::string& name, const Value& value) {
    add_length(name, value, change(value, "%+.1f %%", true));
  }
  // A length around zero, whose change in per cent says nothing.
  void offset(const std::string& name, const Value& value) { add_length(name, value, ""); }
  void share(const std::string& name, const Value& value) {
    add(
        name,
        value,
        [](double number) { return format_number("%.1f %%", 100.0 * number); },
        change(value, "%+.1f pt", false));
  }

  std::string text() const { return aligned_rows(rows_); }

 private:
  // From the first mesh to the last, in per cent or in percentage points.
  std::string change(const Value& value, const char* pattern, bool relative) const {
    const double first = value(meshes_.front().evaluation);
    const double last = value(meshes_.back().evaluation);
    const double scale = relative ? first : 1.0;
    const double difference = 100.0 * (last - first) / scale;
    return std::isfinite(difference) ? format_number(pattern, difference) : "";
  }

  void add_length(const std::string& name, const Value& value, const std::string& last_column) {
    const char* pattern = metre_ == 1.0 ? "%.3f m" : "%.2f mm";
    add(
        name,
        value,
        [&](double number) { return format_number(pattern, number * metre_); },
        last_column);
  }

  void add(const std::string& name,
           const Value& value,
           const std::function<std::string(double)>& write,
           const std::string& last_column) {
    Row row{name};
    for (const NamedEvaluation& mesh : meshes_) {
      const double number = value(mesh.evaluation);
      row.push_back(std::isfinite(number) ? write(number) : "-");
    }
    if (meshes_.size() > 1) {
      row.push_back(last_column);
    }
    rows_.push_back(row);
  }

  const std::vector<NamedEvaluation>& meshes_;
  double metre_;
  std::vector<Row> rows_;
};

double as_double(std::size_t number) {
  return static_cast<double>(number);
}

void add_bounds(const DepthErrorOptions& options, double metre, TableBuilder& table) {
  for (std::size_t k = 0; k < options.absolute_bounds_m.size(); ++k) {
    const std::string bound = metre == 1.0
                                  ? format_number("%g m", options.absolute_bounds_m[k])
                                  : format_number("%g mm", 1000.0 * options.absolute_bounds_m[k]);
    table.share("  within " + bound,
                [k](const MeshEvaluation& e) { return e.depth.within_absolute[k]; });
  }
  for (std::size_t k = 0; k < options.relative_bounds.size(); ++k) {
    table.share(
        "  within " + format_number("%g %%", 100.0 * options.relative_bounds[k]) + " of depth",
        [k](const MeshEvaluation& e) { return e.depth.within_relative[k]; });
  }
}

void add_depth(const DepthErrorOptions& options, double metre, TableBuilder& table) {
  table.heading("depth error (ground-truth pixels that the mesh covers" +
                (std::isfinite(options.max_error_m)
                     ? ", errors below " + format_number("%g m", options.max_error_m)
                     : std::string()) +
                (std::isfinite(options.max_depth_m)
                     ? ", ground truth nearer than " + format_number("%g m", options.max_depth_m)
                     : std::string()) +
                ")");
  table.count("  ground-truth pixels",
              [](const auto& e) { return as_double(e.depth.truth_pixels); });
  table.share("  completeness", [](const auto& e) { return e.depth.completeness; });
  table.length("  mean |error|", [](const auto& e) { return e.depth.mae_m; });
  table.length("  median |error|", [](const auto& e) { return e.depth.median_m; });
  table.length("  RMS error", [](const auto& e) { return e.depth.rms_m; });
  table.offset("  mean error", [](const auto& e) { return e.depth.bias_m; });
  table.length("  mean |error| below 10 medians",
               [](const auto& e) { return e.depth.trimmed_mae_m; });
  table.length("  RMS error below 10 medians", [](const auto& e) { return e.depth.trimmed_rms_m; });
  table.share("  above 10 medians", [](const auto& e) { return e.depth.trimmed_share; });
  table.heading("share of all ground-truth pixels");
  add_bounds(options, metre, table);
}

void add_labels(TableBuilder& table) {
  table.heading("labels against ground truth (means over classes)");
  table.count("  ground-truth pixels", [](const auto& e) { return as_double(e.labels.pixels); });
  table.count("  classes", [](const auto& e) { return as_double(e.labels.counted_classes); });
  table.share("  accuracy", [](const auto& e) { return e.labels.accuracy; });
  table.share("  precision", [](const auto& e) { return e.labels.precision; });
  table.share("  recall", [](const auto& e) { return e.labels.recall; });
  table.share("  F-score", [](const auto& e) { return e.labels.f_score; });
  table.share("  mean IoU", [](const auto& e) { return e.labels.mean_iou; });
}

double total_area(const MeshEvaluation& evaluation) {
  double total = 0.0;
  for (const ClassArea& area : evaluation.areas) {
    total += area.area_m2;
  }
  return total;
}

void add_areas(const std::vector<NamedEvaluation>& meshes,
               const LabelSet& labels,
               TableBuilder& table) {
  std::vector<Label> ids;
  for (const NamedEvaluation& mesh : meshes) {
    for (const ClassArea& area : mesh.evaluation.areas) {
      ids.push_back(area.id);
    }
  }
  std::sort(ids.begin(), ids.end());
  ids.erase(std::unique(ids.begin(), ids.end()), ids.end());
  for (const Label id : ids) {
    table.share("  " + labels.name_of(id), [id](const MeshEvaluation& e) {
      for (const ClassArea& area : e.areas) {
        if (area.id == id) {
          return area.area_m2 / total_area(e);
        }
      }
      return 0.0;
    });
  }
}

// Millimetres if the first mesh with depth has small errors, else metres.
double units_per_metre(const std::vector<NamedEvaluation>& meshes) {
  for (const NamedEvaluation& mesh : meshes) {
    if (mesh.evaluation.depth.truth_pixels > 0) {
      return mesh.evaluation.depth.mae_m < 0.1 ? 1000.0 : 1.0;
    }
  }
  return 1.0;
}

template <typename Condition>
bool any(const std::vector<NamedEvaluation>& meshes, const Condition& condition) {
  return std::any_of(meshes.begin(), meshes.end(), [&](const NamedEvaluation& mesh) {
    return condition(mesh.evaluation);
  });
}

}  // namespace

std::string evaluation_table(const std::vector<NamedEvaluation>& meshes,
                             const DepthErrorOptions& depth,
                             const LabelSet& labels) {
  if (meshes.empty()) {
    return "";
  }
  const double metre = units_per_metre(meshes);
  TableBuilder table(meshes, metre);
  table.names();
  table.count("facets", [](const auto& e) { return as_double(e.facets); });
  table.count("vertices", [](const auto& e) { return as_double(e.vertices); });
  if (any(meshes, [](const auto& e) { return e.self_intersections.has_value(); })) {
    table.count("self-intersections", [](const auto& e) {
      return e.self_intersections ? as_double(*e.self_intersections) : NAN;
    });
  }
  table.count("views with a depth image",
              [](const auto& e) { return as_double(e.depth_image_views); });
  table.count("views with a scan only", [](const auto& e) { return as_double(e.scan_views); });
  table.count("views with labels", [](const auto& e) { return as_double(e.label_views); });
  if (any(meshes, [](const auto& e) { return e.depth.truth_pixels > 0; })) {
    add_depth(depth, metre, table);
  }
  if (any(meshes, [](const auto& e) { return e.labels.pixels > 0; })) {
    add_labels(table);
  }
  if (any(meshes, [](const auto& e) { return !e.areas.empty(); })) {
    table.heading("share of the surface per class");
    add_areas(meshes, labels, table);
  }
  return table.text();
}

}  // namespace facet_mapping
