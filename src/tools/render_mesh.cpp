// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// render_mesh: pictures of a mesh, without a display.
#include <cstdio>
#include <filesystem>
#include <map>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "tool_main.h"
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include "facet_mapping/evaluation/legend.h"
#include "facet_mapping/evaluation/mesh_evaluation.h"
#include "facet_mapping/evaluation/picture_views.h"
#include "facet_mapping/evaluation/pictures.h"
#include "facet_mapping/io/atomic_file.h"
#include "facet_mapping/io/ply.h"

namespace {

using namespace facet_mapping;

enum class Mode { kLabels, kDepth, kNormals, kShaded, kError, kOverlay };

const std::map<std::string, Mode>& modes() {
  static const std::map<std::string, Mode> all{{"labels", Mode::kLabels},
                                               {"depth", Mode::kDepth},
                                               {"normals", Mode::kNormals},
                                               {"shaded", Mode::kShaded},
                                               {"error", Mode::kError},
                                               {"overlay", Mode::kOverlay}};
  return all;
}

std::vector<std::string> mode_names() {
  std::vector<std::string> names;
  for (const auto& [name, mode] : modes()) {
    names.push_back(name);
  }
  return names;
}

struct Options {
  std::string mesh;
  std::string output;
  std::string dataset;
  std::string labels;
  std::string size;
  std::string mode = "shaded";
  std::size_t view = 0;
  bool bird = false;
  std::vector<double> eye;
  std::vector<double> target;
  std::vector<double> up{0.0, 0.0, 1.0};
  double fov_deg = 60.0;
  double max_error_m = 0.5;
  double opacity = 0.5;
  Hidden hidden;
  bool legend = false;
};

void add_camera_options(CLI::App& app, Options& options) {
  auto* dataset =
      app.add_option("--dataset", options.dataset, "Dataset folder to take the view from");
  auto* view =
      app.add_option("--view", options.view, "View of the dataset, counted from 0")->needs(dataset);
  auto* bird =
      app.add_flag("--bird", options.bird, "From above and behind the dataset's trajectory")
          ->needs(dataset)
          ->excludes(view);
  auto* eye = app.add_option("--eye", options.eye, "Camera position x y z, mesh frame, metres")
                  ->expected(3)
                  ->excludes(view)
                  ->excludes(bird);
  auto* target = app.add_option("--target", options.target, "Point to look at")->expected(3);
  eye->needs(target);
  target->needs(eye);
  app.add_option("--up", options.up, "Upwards in the picture")->expected(3)->capture_default_str();
  app.add_option("--size", options.size, "Picture size WxH (default: the view's, else 1280x720)");
  app.add_option("--fov", options.fov_deg, "Horizontal field of view of --eye and --bird, degrees")
      ->capture_default_str();
}

void add_options(CLI::App& app, Options& options) {
  app.add_option("MESH.ply", options.mesh, "Mesh to draw")->required();
  app.add_option("-o,--output", options.output, "Picture to write (.png or .jpg)")->required();
  app.add_option("--mode",
                 options.mode,
                 "labels, depth, normals, shaded, error (against the view's "
                 "ground truth) or overlay (labels over the view's image)")
      ->check(CLI::IsMember(mode_names()))
      ->capture_default_str();
  add_camera_options(app, options);
  app.add_option("--labels", options.labels, "Class list (YAML); default: the mesh's own");
  app.add_option("--max-error", options.max_error_m, "Error drawn in full red, metres")
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
  app.add_option("--opacity", options.opacity, "Strength of the labels in --mode overlay")
      ->check(CLI::Range(0.0, 1.0))
      ->capture_default_str();
  app.add_flag("--show-gaps{false}",
               options.hidden.gaps,
               "Draw facets that only close the surface (views = 0), too");
  app.add_flag(
      "--hide-unlabelled", options.hidden.unlabelled, "Do not draw facets without a class");
  app.add_flag("--hide-sky", options.hidden.sky, "Do not draw facets of sky classes");
  app.add_flag("--legend", options.legend, "Say below the picture what the colours mean");
  app.footer(
      "Examples:\n"
      "  render_mesh map.ply --dataset ~/kitti/drive --view 20 --mode overlay -o overlay.png\n"
      "  render_mesh map.ply --dataset ~/kitti/drive --bird -o street.png\n"
      "  render_mesh map.ply --eye 0 0 30 --target 20 0 0 --size 1600x900 --mode labels -o "
      "map.png");
}

std::optional<cv::Size> parse_size(const std::string& text) {
  if (text.empty()) {
    return std::nullopt;
  }
  cv::Size size;
  char rest = 0;
  if (std::sscanf(text.c_str(), "%dx%d%c", &size.width, &size.height, &rest) != 2 ||
      size.width <= 0 || size.height <= 0 || size.width > 20000 || size.height > 20000) {
    throw std::invalid_argument("--size '" + text + "' must be WxH in pixels, such as 1280x720");
  }
  return size;
}

Eigen::Vector3d vector_of(const std::vector<double>& values) {
  return {values.at(0), values.at(1), values.at(2)};
}

const DatasetFrame& chosen_frame(const std::optional<Dataset>& dataset, const Options& options) {
  if (!dataset || options.bird || !options.eye.empty()) {
    throw std::invalid_argument("this mode needs a view of a dataset: --dataset FOLDER --view K");
  }
  if (options.view >= dataset->frames.size()) {
    throw std::invalid_argument("there is no view " + std::to_string(options.view) +
                                ": the dataset has views 0 to " +
                                std::to_string(dataset->frames.size() - 1));
  }
  return dataset->frames[options.view];
}

View chosen_view(const std::optional<Dataset>& dataset, const Options& options) {
  const std::optional<cv::Size> size = parse_size(options.size);
  const cv::Size free_size = size.value_or(cv::Size(1280, 720));
  if (!options.eye.empty()) {
    return look_at(vector_of(options.eye),
                   vector_of(options.target),
                   vector_of(options.up),
                   free_size,
                   options.fov_deg);
  }
  if (!dataset) {
    throw std::invalid_argument(
        "say where to look from: --dataset with --view or --bird, or --eye "
        "and --target");
  }
  if (options.bird) {
    return bird_view(*dataset, free_size, options.fov_deg);
  }
  const View& view = chosen_frame(dataset, options).view;
  return size ? view_of_size(view, *size, "--size") : view;
}

// Draws at twice the size: averaging 2x2 pixels smooths the edges.
class Painter {
 public:
  Painter(const MeshFile& file, const View& view) : file_(file), view_(view), fine_(view) {
    fine_.camera = view.camera.resized(2 * view.camera.width, 2 * view.camera.height);
  }

  cv::Mat labels(bool legend) {
    const FacetImage image = render(fine_);
    const cv::Mat picture = halved(label_picture(image, file_.mesh, file_.labels));
    return legend ? class_legend(picture, image) : picture;
  }
  cv::Mat shaded(bool legend) {
    const FacetImage image = render(fine_);
    const cv::Mat picture = halved(shaded_picture(image, file_.mesh, file_.labels, fine_));
    return legend ? class_legend(picture, image) : picture;
  }
  cv::Mat normals() { return halved(normal_picture(render(fine_), file_.mesh, fine_)); }
  cv::Mat depth(bool legend) {
    const FacetImage image = render(fine_);
    const DepthRange range = depth_range(image.depth);
    const cv::Mat picture = halved(depth_picture(image.depth, range));
    return legend ? with_scale_legend(picture, metres(range.near_m), metres(range.far_m), true)
                  : picture;
  }
  cv::Mat error(const cv::Mat& truth, double max_error_m, bool legend) {
    const View view = view_of_size(view_, truth.size(), "the ground truth");
    const FacetImage image = render(view);
    const cv::Mat background = shaded_picture(image, file_.mesh, file_.labels, view);
    const cv::Mat picture = error_picture(image.depth, truth, max_error_m, background);
    return legend ? with_scale_legend(picture, "error 0", metres(max_error_m), false) : picture;
  }
  cv::Mat overlay(const cv::Mat& camera_image, double opacity, bool legend) {
    const FacetImage image = render(view_of_size(view_, camera_image.size(), "the image"));
    const cv::Mat picture = overlay_picture(camera_image, image, file_.mesh, file_.labels, opacity);
    return legend ? class_legend(picture, image) : picture;
  }

 private:
  FacetImage render(const View& view) { return make_renderer()->render(file_.mesh, view); }
  cv::Mat halved(const cv::Mat& picture) const {
    cv::Mat small;
    cv::resize(picture, small, {view_.camera.width, view_.camera.height}, 0.0, 0.0, cv::INTER_AREA);
    return small;
  }
  cv::Mat class_legend(const cv::Mat& picture, const FacetImage& image) const {
    return with_class_legend(picture, label_image(image, file_.mesh), file_.labels);
  }
  static std::string metres(double value) {
    char text[32];
    std::snprintf(text, sizeof(text), "%.3g m", value);
    return text;
  }

  const MeshFile& file_;
  View view_;
  View fine_;
};

cv::Mat paint(const MeshFile& file, const std::optional<Dataset>& dataset, const Options& options) {
  Painter painter(file, chosen_view(dataset, options));
  switch (modes().at(options.mode)) {
    case Mode::kLabels:
      return painter.labels(options.legend);
    case Mode::kDepth:
      return painter.depth(options.legend);
    case Mode::kNormals:
      return painter.normals();
    case Mode::kShaded:
      return painter.shaded(options.legend);
    case Mode::kOverlay:
      return painter.overlay(
          read_color(chosen_frame(dataset, options).left_image), options.opacity, options.legend);
    case Mode::kError:
      break;
  }
  const DatasetFrame& frame = chosen_frame(dataset, options);
  const cv::Mat truth = true_depth(*dataset, frame);
  if (truth.empty()) {
    throw std::invalid_argument("view " + std::to_string(options.view) +
                                " has neither a depth image nor a scan to compare with");
  }
  return painter.error(truth, options.max_error_m, options.legend);
}

void write_picture(const cv::Mat& picture, const std::string& path) {
  const std::string extension = std::filesystem::path(path).extension().string();
  std::vector<unsigned char> bytes;
  if ((extension != ".png" && extension != ".jpg") || !cv::imencode(extension, picture, bytes)) {
    throw std::invalid_argument("cannot write '" + path + "': pictures are .png or .jpg");
  }
  AtomicFile file(path);
  file.write(bytes.data(), bytes.size());
  file.commit();
}

void run(const Options& options) {
  MeshFile file = read_ply(options.mesh);
  if (!options.labels.empty()) {
    file.labels = LabelSet::load(options.labels);
  }
  file.mesh = shown_facets(file.mesh, file.labels, options.hidden);
  std::optional<Dataset> dataset;
  if (!options.dataset.empty()) {
    dataset = read_dataset(options.dataset);
  }
  write_picture(paint(file, dataset, options), options.output);
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app("Draws a mesh into a picture.", "render_mesh");
  Options options;
  add_options(app, options);
  return run_tool(app, argc, argv, [&options] { run(options); });
}
