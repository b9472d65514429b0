// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Where a display gets its mesh: the topic, the palette beside it, and get_mesh after a gap.
#pragma once

#include <chrono>
#include <cstddef>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "service_caller.h"
#include <facet_mapping/ClassPalette.h>
#include <facet_mapping/GetMesh.h>
#include <facet_mapping/LabeledMesh.h>
#include <ros/node_handle.h>

#include "facet_mapping/rviz/chunk_store.h"
#include "facet_mapping/rviz/class_table.h"

namespace facet_mapping {

/// `/mapper/mesh` and "palette" give `/mapper/palette`.
std::string name_beside(const std::string& topic, const std::string& name);

/// Messages arrive in another thread, poll() takes them in that of the window.
class MeshSource {
 public:
  /// `nh`: its callbacks must not run in the window's thread, so that large messages do not stop
  /// it.
  explicit MeshSource(const ros::NodeHandle& nh);

  /// Throws ros::Exception if the name is none.
  void subscribe(const std::string& mesh_topic);
  void unsubscribe();

  struct News {
    bool mesh = false;
    bool palette = false;
  };
  /// Applies what has arrived since the last call. After a gap it asks get_mesh and keeps what
  /// comes meanwhile; if that does not answer, it subscribes anew, which brings the full mesh, too.
  News poll(ChunkStore* store, ClassTable* classes);

  std::size_t messages() const { return messages_; }
  std::size_t gaps() const { return gaps_; }
  bool is_waiting_for_full() const { return get_mesh_->is_running(); }
  bool has_palette() const { return has_palette_; }
  /// A sentence on what is wrong, or empty.
  const std::string& problem() const { return problem_; }
  std::size_t publishers() const { return mesh_sub_.getNumPublishers(); }

 private:
  void subscribe_mesh();
  bool apply(const LabeledMesh::Ptr& message, ChunkStore* store);
  bool take_answer(ChunkStore* store);
  bool take_messages(ChunkStore* store);
  void ask_for_full();
  void ask_if_nothing_comes(const ChunkStore& store);
  void give_up_waiting();

  struct Inbox {
    std::mutex mutex;
    std::vector<LabeledMesh::Ptr> meshes;
    ClassPalette::ConstPtr palette;
  };

  ros::NodeHandle nh_;
  std::string topic_;
  std::shared_ptr<Inbox> inbox_;
  std::vector<LabeledMesh::Ptr> kept_;  // came while the full mesh is on its way
  ros::Subscriber mesh_sub_;
  ros::Subscriber palette_sub_;
  std::unique_ptr<ServiceCaller<GetMesh>> get_mesh_;  // never null
  using Clock = std::chrono::steady_clock;
  Clock::time_point asked_;                        // get_mesh, last
  std::optional<Clock::time_point> silent_since_;  // a publisher is there, but no mesh; once only
  bool has_asked_newly_ = false;                   // since subscribing
  std::size_t messages_ = 0;
  std::size_t gaps_ = 0;
  bool has_palette_ = false;
  std::string problem_;
};

}  // namespace facet_mapping
