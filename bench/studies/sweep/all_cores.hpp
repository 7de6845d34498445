// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Independent jobs on all cores.
#pragma once

#include <atomic>
#include <cstddef>
#include <functional>

namespace reckon::bench {

/// Runs jobs 0 .. count - 1, each once, on as many threads as there are cores, started in order.
/// @param job the first exception ends all jobs and is rethrown here, so a job must not throw if
///     others can continue without it; it may check `stop`, which is set when its result is no
///     longer needed
/// @param progress called by the caller's thread every 20 ms with the jobs done; false ends all
/// @return whether all jobs were done
bool run_on_all_cores(std::size_t count,
                      const std::function<void(std::size_t, const std::atomic<bool>& stop)>& job,
                      const std::function<bool(std::size_t done)>& progress);

}  // namespace reckon::bench
