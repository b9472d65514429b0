// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <atomic>
#include <future>
#include <stdexcept>

#include <gtest/gtest.h>

#include "facet_mapping/ros/job_queue.h"
#include "facet_mapping/ros/long_job.h"
#include "facet_mapping/ros/service_status.h"

namespace facet_mapping {
namespace {

void ignore_error(const std::string& /*error*/) {}

TEST(JobQueue, JobsRunInOrder) {
  std::vector<int> order;
  std::promise<void> done;
  JobQueue queue(10, ignore_error);
  for (int k = 0; k < 5; ++k) {
    EXPECT_TRUE(queue.post([&order, k] { order.push_back(k); }));
  }
  EXPECT_TRUE(queue.post([&done] { done.set_value(); }));
  done.get_future().wait();
  EXPECT_EQ(order, (std::vector<int>{0, 1, 2, 3, 4}));
}

TEST(JobQueue, FullQueueRefuses) {
  std::promise<void> started;
  std::promise<void> release;
  JobQueue queue(1, ignore_error);
  queue.post([&] {
    started.set_value();
    release.get_future().wait();
  });
  started.get_future().wait();
  EXPECT_TRUE(queue.post([] {}));
  EXPECT_FALSE(queue.post([] {}));
  EXPECT_EQ(queue.size(), 1U);
  release.set_value();
}

TEST(JobQueue, ExceptionIsReportedAndTheQueueLives) {
  std::promise<std::string> error;
  std::promise<void> next;
  JobQueue queue(10, [&error](const std::string& text) { error.set_value(text); });
  queue.post([] { throw std::runtime_error("broken"); });
  queue.post([&next] { next.set_value(); });
  EXPECT_EQ(error.get_future().get(), "broken");
  next.get_future().wait();
}

TEST(JobQueue, StopDropsWhatWaits) {
  std::promise<void> started;
  std::atomic<bool> ran{false};
  std::promise<void> release;
  auto released = release.get_future();
  JobQueue queue(10, ignore_error);
  queue.post([&] {
    started.set_value();
    released.wait();
  });
  queue.post([&ran] { ran = true; });
  started.get_future().wait();
  auto stopped = std::async(std::launch::async, [&queue] { queue.stop(); });
  while (queue.size() > 0) {
    std::this_thread::yield();
  }
  release.set_value();
  stopped.wait();
  EXPECT_FALSE(ran);
  EXPECT_FALSE(queue.post([] {}));
}

/// Runs a job that ends when it is cancelled.
std::future<Status> run_until_cancelled(LongJob* job, std::promise<void>* started) {
  return std::async(std::launch::async, [job, started] {
    return answer([job, started] {
      job->run("slow job", [job, started] {
        started->set_value();
        while (!job->is_cancelled()) {
          std::this_thread::sleep_for(std::chrono::milliseconds(1));
        }
      });
      return std::string("done");
    });
  });
}

TEST(LongJob, SecondJobIsBusyAndCancelEndsTheFirst) {
  LongJob job;
  std::promise<void> started;
  auto first = run_until_cancelled(&job, &started);
  started.get_future().wait();
  const Status second = answer([&job] {
    job.run("other job", [] {});
    return std::string();
  });
  EXPECT_EQ(second.code, Status::BUSY);
  EXPECT_NE(second.message.find("slow job"), std::string::npos);
  EXPECT_TRUE(job.cancel());
  EXPECT_EQ(first.get().code, Status::OK);
  EXPECT_FALSE(job.cancel());
  job.run("next job", [&job] { EXPECT_FALSE(job.is_cancelled()); });
}

TEST(LongJob, ExceptionsReachTheCaller) {
  LongJob job;
  const auto fail = [] { throw std::invalid_argument("wrong"); };
  EXPECT_THROW(job.run("job", fail), std::invalid_argument);
  EXPECT_EQ(job.running(), "");
}

TEST(LongJob, StopReleasesTheCaller) {
  LongJob job;
  std::promise<void> started;
  auto first = run_until_cancelled(&job, &started);
  started.get_future().wait();
  job.stop();
  first.wait();
  EXPECT_THROW(job.run("job", [] {}), ServiceError);
}

TEST(Answer, ExceptionsBecomeCodes) {
  EXPECT_EQ(answer([]() -> std::string { throw std::invalid_argument("a"); }).code,
            Status::INVALID_ARGUMENT);
  EXPECT_EQ(answer([]() -> std::string { throw std::runtime_error("a"); }).code, Status::INTERNAL);
  EXPECT_EQ(answer([]() -> std::string { throw ServiceError(Status::BUSY, "a"); }).code,
            Status::BUSY);
  EXPECT_EQ(answer([] { return std::string("fine"); }).message, "fine");
}

}  // namespace
}  // namespace facet_mapping
