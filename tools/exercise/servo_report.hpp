// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Timing of the servos of a run.
#pragma once

#include <cstdint>
#include <string>

#include "reckon/peer/counters/duty_cycle.hpp"
#include "reckon/peer/peer_threads.hpp"
#include "reckon/tools/exercise/loop_report.hpp"

namespace reckon::tools {

/// Scheduling of a peer's servo: "SCHED_FIFO 50, wakes 100 us early and spins; memory locked".
[[nodiscard]] std::string servo_text(const peer::PeerThreads& threads);

/// Percentiles of the servo's lateness over all peers (the worst of each), and missed periods.
struct ServoReport {
  peer::Percentiles lateness;
  std::uint64_t steps = 0;
  std::uint64_t missed = 0;
  LoopReports loops;   ///< the worst of each
  std::string thread;  ///< scheduling of their thread; empty in simulated time

  void add(const peer::PeerThreads& threads);
};

}  // namespace reckon::tools
