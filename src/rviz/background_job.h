// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// What may take long, beside the window's thread.
#pragma once

#include <chrono>
#include <condition_variable>
#include <memory>
#include <mutex>
#include <optional>
#include <thread>
#include <utility>

namespace facet_mapping {

/// One function at a time in a thread of its own. The thread owns all that it uses, so that this
/// object need not wait for it: the library stays loaded (linked with nodelete).
template <typename Result>
class BackgroundJob {
 public:
  /// Must not be called while one is running. `function` must not throw.
  template <typename Function>
  void start(Function function) {
    state_ = std::make_shared<State>();
    std::thread([state = state_, call = std::move(function)]() mutable {
      Result result = call();
      const std::lock_guard<std::mutex> lock(state->mutex);
      state->result = std::move(result);
      state->is_done = true;
      state->done.notify_all();
    }).detach();
  }

  /// From start() until the result is taken.
  bool is_running() const { return state_ != nullptr; }

  /// Once, as soon as it is there.
  std::optional<Result> take() {
    if (!wait(std::chrono::milliseconds(0))) {
      return std::nullopt;
    }
    const std::shared_ptr<State> state = std::move(state_);
    state_ = nullptr;
    const std::lock_guard<std::mutex> lock(state->mutex);
    return std::move(state->result);
  }

  /// False if it is still running after this time, or none was started.
  bool wait(std::chrono::milliseconds time) const {
    if (!state_) {
      return false;
    }
    std::unique_lock<std::mutex> lock(state_->mutex);
    return state_->done.wait_for(lock, time, [this] { return state_->is_done; });
  }

  /// Whatever comes of it is of no interest any more.
  void forget() { state_ = nullptr; }

 private:
  struct State {
    std::mutex mutex;
    std::condition_variable done;
    std::optional<Result> result;
    bool is_done = false;
  };

  std::shared_ptr<State> state_;
};

}  // namespace facet_mapping
