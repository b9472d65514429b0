// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "facet_mapping/evaluation/point_report.h"

#include <cmath>
#include <functional>

#include "evaluation/text_table.h"
#include <nlohmann/json.hpp>

namespace facet_mapping {
namespace {

using nlohmann::ordered_json;
using Value = std::function<double(const NamedPointScores&)>;

class ColumnTable {
 public:
  explicit ColumnTable(const std::vector<NamedPointScores>& sources) : sources_(sources) {}

  void text(const std::string& name, std::string NamedPointScores::*member) {
    rows_.push_back({name});
    for (const NamedPointScores& source : sources_) {
      rows_.back().push_back(source.*member);
    }
  }
  void number(const std::string& name, const char* pattern, double scale, const Value& value) {
    rows_.push_back({name});
    for (const NamedPointScores& source : sources_) {
      const double number = value(source);
      rows_.back().push_back(std::isfinite(number) ? format_number(pattern, scale * number) : "-");
    }
  }
  void share(const std::string& name, const Value& value) { number(name, "%.1f %%", 100.0, value); }
  void count(const std::string& name, const Value& value) {
    rows_.push_back({name});
    for (const NamedPointScores& source : sources_) {
      const double number = value(source);
      rows_.back().push_back(std::isfinite(number)
                                 ? grouped_digits(static_cast<std::size_t>(std::llround(number)))
                                 : "-");
    }
  }
  void heading(const std::string& text) { rows_.push_back({text}); }
  std::string text() const { return aligned_rows(rows_); }

 private:
  const std::vector<NamedPointScores>& sources_;
  std::vector<std::vector<std::string>> rows_;
};

double seconds_per_image(const NamedPointScores& source) {
  return source.images > 0 ? source.processor_seconds / static_cast<double>(source.images) : NAN;
}

double points_per_second(const NamedPointScores& source) {
  return source.processor_seconds > 0.0
             ? static_cast<double>(source.scores.points) / source.processor_seconds
             : NAN;
}

void add_amounts(ColumnTable& table) {
  table.count("frames with points", [](const auto& s) { return double(s.scores.frames); });
  table.count("points", [](const auto& s) { return double(s.scores.points); });
  table.count("points per frame", [](const auto& s) { return s.scores.points_per_frame; });
  table.number("processor ms per image", "%.1f", 1e3, seconds_per_image);
  table.count("points per processor second", points_per_second);
}

void add_errors(const PointQualityOptions& options, ColumnTable& table) {
  table.heading("depth error, points with ground truth at their pixel" +
                (std::isfinite(options.max_depth_m)
                     ? format_number(" nearer than %g m", options.max_depth_m)
                     : std::string()));
  table.text("  ground truth", &NamedPointScores::depths);
  table.count("  points compared", [](const auto& s) { return double(s.scores.compared); });
  table.share("  share of all points", [](const auto& s) { return s.scores.compared_share; });
  for (std::size_t k = 0; k < options.relative_bounds.size(); ++k) {
    table.share("  within " + format_number("%g %% of depth", 100.0 * options.relative_bounds[k]),
                [k](const auto& s) { return s.scores.within_relative[k]; });
  }
  table.number("  median |error| / depth", "%.2f %%", 100.0, [](const auto& s) {
    return s.scores.median_relative;
  });
  table.number("  mean |error| / depth", "%.2f %%", 100.0, [](const auto& s) {
    return s.scores.mean_relative;
  });
  table.number(
      "  median |error|", "%.4f m", 1.0, [](const auto& s) { return s.scores.median_error_m; });
}

void add_sigmas(ColumnTable& table) {
  table.heading("stated standard deviation (Gaussian noise: 68.3, 95.4, 99.7 %, factor 1)");
  table.number("  mean", "%.4f m", 1.0, [](const auto& s) { return s.scores.mean_sigma_m; });
  for (std::size_t k = 0; k < 3; ++k) {
    table.share("  errors within " + std::to_string(k + 1) + " of it",
                [k](const auto& s) { return s.scores.within_sigma[k]; });
  }
  table.number("  errors / it, by medians", "%.2f", 1.0, [](const auto& s) {
    return s.scores.sigma_factor;
  });
}

void add_rest(const PointQualityOptions& options, ColumnTable& table) {
  table.share("cells of " + std::to_string(options.cell_px) + " px with truth that have a point",
              [](const auto& s) { return s.scores.density; });
  table.heading("classes");
  table.share("  points with a class", [](const auto& s) { return s.scores.labelled_share; });
  table.text("  compared with", &NamedPointScores::labels);
  table.share("  same class there", [](const auto& s) { return s.scores.label_agreement; });
}

ordered_json source_json(const NamedPointScores& source) {
  const PointScores& scores = source.scores;
  return {{"name", source.name},
          {"depths", source.depths},
          {"labels", source.labels},
          {"images", source.images},
          {"frames", scores.frames},
          {"points", scores.points},
          {"points_per_frame", scores.points_per_frame},
          {"processor_s", source.processor_seconds},
          {"processor_s_per_image", seconds_per_image(source)},
          {"points_per_processor_s", points_per_second(source)},
          {"compared", scores.compared},
          {"compared_share", scores.compared_share},
          {"within_relative", scores.within_relative},
          {"median_relative", scores.median_relative},
          {"mean_relative", scores.mean_relative},
          {"median_error_m", scores.median_error_m},
          {"mean_sigma_m", scores.mean_sigma_m},
          {"within_sigma", scores.within_sigma},
          {"sigma_factor", scores.sigma_factor},
          {"density", scores.density},
          {"labelled_share", scores.labelled_share},
          {"label_points", scores.label_points},
          {"label_agreement", scores.label_agreement}};
}

}  // namespace

std::string point_table(const std::vector<NamedPointScores>& sources,
                        const PointQualityOptions& options) {
  ColumnTable table(sources);
  table.text("", &NamedPointScores::name);
  add_amounts(table);
  add_errors(options, table);
  add_sigmas(table);
  add_rest(options, table);
  return table.text();
}

std::string point_json(const std::vector<NamedPointScores>& sources,
                       const PointQualityOptions& options) {
  ordered_json list = ordered_json::array();
  for (const NamedPointScores& source : sources) {
    list.push_back(source_json(source));
  }
  const ordered_json json = {{"max_depth_m", options.max_depth_m},
                             {"relative_bounds", options.relative_bounds},
                             {"cell_px", options.cell_px},
                             {"sources", list}};
  return json.dump(2) + "\n";
}

}  // namespace facet_mapping
