// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/bench/studies/sweep/all_cores.hpp"

#include <algorithm>
#include <chrono>
#include <condition_variable>
#include <exception>
#include <mutex>
#include <thread>
#include <vector>

#include "reckon/peer/threads/thread_name.hpp"

namespace reckon::bench {

bool run_on_all_cores(std::size_t count,
                      const std::function<void(std::size_t, const std::atomic<bool>&)>& job,
                      const std::function<bool(std::size_t)>& progress) {
  std::atomic<std::size_t> next{0}, done{0};
  std::atomic<bool> stop{false};
  std::mutex mutex;
  std::condition_variable ended;
  std::exception_ptr fault;
  const auto work = [&] {
    for (std::size_t i = next++; i < count && !stop; i = next++) {
      try {
        job(i, stop);
      } catch (...) {
        const std::lock_guard lock(mutex);
        if (!fault) fault = std::current_exception();
        stop = true;
      }
      const std::lock_guard lock(mutex);
      if (!stop) ++done;
      ended.notify_one();
    }
  };
  std::vector<std::jthread> threads;
  const std::size_t cores = std::max(1U, std::thread::hardware_concurrency());
  for (std::size_t i = 0; i < std::min(cores, count); ++i) {
    threads.emplace_back(work);
    peer::name_thread(threads.back().native_handle(), "rk-study");
  }
  while (done < count && !stop) {
    if (progress && !progress(done)) stop = true;
    std::unique_lock lock(mutex);
    ended.wait_for(lock, std::chrono::milliseconds(20), [&] { return done == count || stop; });
  }
  threads.clear();
  if (fault) std::rethrow_exception(fault);
  return done == count;
}

}  // namespace reckon::bench
