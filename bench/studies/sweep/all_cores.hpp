// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Jobs that know nothing of each other, on all cores.
#pragma once

#include <atomic>
#include <cstddef>
#include <functional>

namespace reckon::bench {

/// Does jobs 0 .. count - 1, each once, on as many threads as there are cores, begun in order.
/// @param job must not throw where another job could go on without it: the first exception ends
/// all and is thrown here; it may look at `stop`, which is set once the result is of no use
/// @param progress called by the caller's thread every 20 ms with the jobs done; false ends all
/// @return whether all were done
bool run_on_all_cores(std::size_t count,
                      const std::function<void(std::size_t, const std::atomic<bool>& stop)>& job,
                      const std::function<bool(std::size_t done)>& progress);

}  // namespace reckon::bench
