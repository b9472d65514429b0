// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "facet_mapping/ros/refine_services.h"

#include <algorithm>
#include <cstdio>
#include <utility>

#include <facet_mapping/RefineProgress.h>

#include "facet_mapping/labeling/facet_labeling.h"
#include "facet_mapping/render/facet_renderer.h"
#include "facet_mapping/render/observed_mesh.h"
#include "facet_mapping/ros/mesh_conversions.h"
#include "facet_mapping/ros/mesh_filter.h"
#include "facet_mapping/ros/refine_request.h"
#include "facet_mapping/ros/service_status.h"

namespace facet_mapping {
namespace {

constexpr std::uint32_t kProgressQueueSize = 20;
constexpr int kServiceThreads = 2;  // one waits for its job, the other answers BUSY
constexpr std::size_t kLeastViews = 2;

RefineEnergy to_message(const EnergyTerms& energy) {
  RefineEnergy message;
  message.photometric = energy.photometric;
  message.semantic = energy.semantic;
  return message;
}

std::string number_text(double value) {
  char text[32];
  std::snprintf(text, sizeof(text), "%.4g", value);
  return text;
}

std::string energy_text(const RefinementResult& result) {
  return "photometric " + number_text(result.before.photometric) + " -> " +
         number_text(result.after.photometric) + ", semantic " +
         number_text(result.before.semantic) + " -> " + number_text(result.after.semantic);
}

double seconds_since(const ros::WallTime& start) {
  return (ros::WallTime::now() - start).toSec();
}

void fill_response(const RefinementResult& result, Refine::Response* response) {
  response->before = to_message(result.before);
  response->after = to_message(result.after);
  response->facets_before = result.facets_before;
  response->facets_after = result.facets_after;
  response->relabelled = result.relabelled;
}

template <typename Service>
ros::AdvertiseServiceOptions on_queue(
    const std::string& name,
    ros::CallbackQueue* queue,
    boost::function<bool(typename Service::Request&, typename Service::Response&)> callback) {
  return ros::AdvertiseServiceOptions::create<Service>(name, callback, nullptr, queue);
}

}  // namespace

/// All that a refinement needs; owned by the job, which may outlive the call.
struct RefineServices::Task {
  RefineStart start;
  std::vector<LabeledView> views;
  RefinementConfig config;
  double time_budget_s = 0.0;
  bool dry_run = false;
  double mib = 0.0;
  ros::WallTime begin = ros::WallTime::now();
};

RefineServices::RefineServices(ros::NodeHandle private_nh,
                               const RefinementConfig& defaults,
                               Sources sources)
    : defaults_(defaults), sources_(std::move(sources)), spinner_(kServiceThreads, &queue_) {
  progress_pub_ = private_nh.advertise<RefineProgress>("progress", kProgressQueueSize);
  cancel_server_ = private_nh.advertiseService("cancel_refine", &RefineServices::cancel, this);
  auto relabel_options = on_queue<Relabel>(
      "relabel", &queue_, [this](auto& request, auto& answer) { return relabel(request, answer); });
  relabel_server_ = private_nh.advertiseService(relabel_options);
  auto refine_options = on_queue<Refine>(
      "refine", &queue_, [this](auto& request, auto& answer) { return refine(request, answer); });
  refine_server_ = private_nh.advertiseService(refine_options);
  spinner_.start();
}

RefineServices::~RefineServices() {
  stop();
}

void RefineServices::stop() {
  job_.stop();
  spinner_.stop();
}

MeshStatePtr RefineServices::mesh_of_request(const LabeledMesh& message) const {
  if (message.header.frame_id != sources_.refined->frame_id()) {
    throw std::invalid_argument("mesh: its frame is '" + message.header.frame_id +
                                "', but it must be map_frame '" + sources_.refined->frame_id() +
                                "'");
  }
  auto state = std::make_shared<MeshState>();
  state->mesh = mesh_from_message(message);
  state->stamp = message.header.stamp;
  if (state->mesh.empty()) {
    throw std::invalid_argument("mesh: start is START_REQUEST, but the mesh has no facets");
  }
  return state;
}

RefineStart RefineServices::start_mesh(const Refine::Request& request) const {
  using Request = Refine::Request;
  if (request.start == Request::START_REQUEST) {
    return {mesh_of_request(request.mesh), nullptr};
  }
  if (request.start == Request::START_REFINED) {
    return sources_.meshes->from_refined();
  }
  if (request.start != Request::START_MAP) {
    throw std::invalid_argument(
        "start must be 0 (the mapper's mesh), 1 (the last refined one) or "
        "2 (mesh in the request)");
  }
  return sources_.meshes->from_map();
}

std::vector<LabeledView> RefineServices::require_views(std::size_t least,
                                                       const std::string& problem) const {
  std::vector<LabeledView> views = sources_.keyframes->views();
  std::string problems = problem;
  if (views.size() < least) {
    problems += (problems.empty() ? "" : "; and ") + std::to_string(views.size()) +
                " keyframes, but " + std::to_string(least) +
                " are needed: they come from images on '" + sources_.image_topic +
                "' with camera_info and tf while the camera moves";
  }
  if (!problems.empty()) {
    throw ServiceError(Status::NOT_READY,
                       problems + " (what was received and dropped stands on /diagnostics)");
  }
  return views;
}

RefineServices::Task RefineServices::prepare(const Refine::Request& request) const {
  Task task;
  task.config = refinement_config(
      request,
      defaults_,
      lookup_region_from_map(request.region, sources_.refined->frame_id(), *sources_.tf));
  task.time_budget_s = request.time_budget;
  task.dry_run = request.dry_run != 0;
  task.start = start_mesh(request);
  std::string problem;
  if (!task.start.mesh || task.start.mesh->mesh.empty()) {
    problem =
        request.start == Refine::Request::START_REFINED
            ? "nothing was refined yet; use start 0"
            : "there is no mesh yet: it comes from the mapper on '" + sources_.map_mesh_topic + "'";
  }
  task.views = require_views(kLeastViews, problem);
  task.mib = estimate_refine_mib(task.start.mesh->mesh, task.views, task.config);
  if (request.memory_budget > 0.0 && task.mib > request.memory_budget) {
    throw std::invalid_argument("the job would need about " + number_text(task.mib) +
                                " MiB, more than memory_budget: keep fewer keyframes "
                                "(max_keyframes, keyframe_translation_m) or use smaller images");
  }
  return task;
}

bool RefineServices::report_progress(const Task& task,
                                     const RefinementProgress& progress,
                                     std::string* why_stopped) {
  RefineProgress message;
  message.header.stamp = ros::Time::now();
  message.header.frame_id = sources_.refined->frame_id();
  message.level = progress.level;
  message.iteration = progress.iteration;
  message.fraction = progress.fraction;
  message.seconds = seconds_since(task.begin);
  message.energy = to_message(progress.energy);
  progress_pub_.publish(message);
  if (job_.is_cancelled() || ros::isShuttingDown()) {
    *why_stopped = "cancelled";
  } else if (task.time_budget_s > 0.0 && message.seconds >= task.time_budget_s) {
    *why_stopped = "time budget used up";
  }
  return why_stopped->empty();
}

RefinementResult RefineServices::run(const Task& task, std::string* why_stopped) {
  ROS_INFO("refining %zu facets with %zu keyframes (about %.0f MiB)",
           task.start.mesh->mesh.triangles.size(),
           task.views.size(),
           task.mib);
  RefinementResult result = facet_mapping::refine(
      task.start.mesh->mesh,
      task.views,
      sources_.refined->labels(),
      task.config,
      [&](const RefinementProgress& p) { return report_progress(task, p, why_stopped); });
  if (!ros::isShuttingDown()) {
    sources_.meshes->take(task.start, result.mesh, task.config.part);
  }
  return result;
}

std::string RefineServices::estimate(const std::shared_ptr<Task>& task,
                                     Refine::Response* response) {
  const auto result = std::make_shared<RefinementEstimate>();
  job_.run("~refine (dry run)", [this, task, result] {
    *result = estimate_refinement(
        task->start.mesh->mesh, task->views, sources_.refined->labels(), task->config);
  });
  response->before = to_message(result->energy);
  response->after = response->before;
  response->facets_before = task->start.mesh->mesh.triangles.size();
  response->facets_after = result->facets;
  response->seconds =
      task->time_budget_s > 0.0 ? std::min(result->seconds, task->time_budget_s) : result->seconds;
  return "the request can be served (nothing was changed): " + std::to_string(result->views) +
         " keyframes, about " + number_text(task->mib) + " MiB, " + number_text(response->seconds) +
         " s, " + std::to_string(result->facets) + " facets";
}

bool RefineServices::refine(Refine::Request& request, Refine::Response& response) {
  response.status = answer([&] {
    const auto task = std::make_shared<Task>(prepare(request));
    response.views = static_cast<std::uint32_t>(task->views.size());
    response.peak_memory = task->mib;
    if (task->dry_run) {
      return estimate(task, &response);
    }
    const auto result = std::make_shared<RefinementResult>();
    const auto why_stopped = std::make_shared<std::string>();
    job_.run("~refine", [=] { *result = run(*task, why_stopped.get()); });
    fill_response(*result, &response);
    response.seconds = seconds_since(task->begin);
    if (request.return_mesh != 0) {
      response.mesh = sources_.refined->detached_message(result->mesh, task->start.mesh->stamp);
    }
    const std::string summary = energy_text(*result) + ", " + std::to_string(result->facets_after) +
                                " facets, " + number_text(response.seconds) +
                                " s; the mesh is on ~mesh";
    if (*why_stopped == "cancelled") {
      throw ServiceError(Status::CANCELLED, "cancelled, best so far: " + summary);
    }
    return (why_stopped->empty() ? "" : *why_stopped + ", best so far: ") + summary;
  });
  sources_.diagnostics->count("refine: " + std::string(response.status.code == Status::OK
                                                           ? "done"
                                                           : "refused, cancelled or failed"));
  ROS_INFO("~refine: %s", response.status.message.c_str());
  return true;
}

bool RefineServices::relabel(Relabel::Request& /*request*/, Relabel::Response& response) {
  response.status = answer([&] {
    const ros::WallTime begin = ros::WallTime::now();
    RefineStart start = sources_.meshes->from_refined();
    if (!start.mesh || start.mesh->mesh.empty()) {
      start = sources_.meshes->from_map();
    }
    const bool missing = !start.mesh || start.mesh->mesh.empty();
    const auto views = std::make_shared<std::vector<LabeledView>>(require_views(
        1,
        missing
            ? "there is no mesh yet: it comes from the mapper on '" + sources_.map_mesh_topic + "'"
            : ""));
    if (sources_.keyframes->labelled() == 0) {
      throw ServiceError(Status::NOT_READY, "no keyframe has a segmentation; is one published?");
    }
    const auto result = std::make_shared<LabelingResult>();
    job_.run("~relabel", [this, start, views, result] {
      const auto renderer = make_renderer();
      TriangleMesh mesh = start.mesh->mesh;
      const ObservedMesh observed(mesh);
      std::vector<FacetImage> renderings;
      for (const LabeledView& view : *views) {
        renderings.push_back(observed.render(renderer.get(), view.view));
      }
      LabelingConfig config = defaults_.labeling;
      config.excluded = sources_.refined->labels().sky_ids();
      *result = label_facets(mesh, *views, renderings, config);
      apply_labeling(*result, &mesh);
      if (mesh.start_points.empty()) {
        mesh.start_points = mesh.vertices;
      }
      sources_.meshes->take(start, std::move(mesh), {});
    });
    response.facets = result->labels.size();
    response.relabelled = result->changed;
    response.seconds = seconds_since(begin);
    return std::to_string(result->changed) + " of " + std::to_string(result->labels.size()) +
           " facets changed their class; the mesh is on ~mesh";
  });
  return true;
}

bool RefineServices::cancel(CancelRefine::Request& /*request*/, CancelRefine::Response& response) {
  response.status = answer([this] {
    const std::string running = job_.running();
    if (!job_.cancel()) {
      throw ServiceError(Status::NOT_READY, "nothing is running that could be cancelled");
    }
    return running + " stops at its next iteration";
  });
  return true;
}

}  // namespace facet_mapping
