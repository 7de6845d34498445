// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The stages of each pass of the model loop, as a record.
#pragma once

#include <array>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <string_view>

#include "reckon/haptics/exchange/spsc_ring.hpp"
#include "reckon/peer/clocks/clock.hpp"

namespace reckon::peer {

/// Stages of a pass of the model loop, in the order in which they run: the simulation loop of the
/// thesis (5.4, Fig 5.5), which renders where this one publishes.
enum class LoopStage : std::uint8_t {
  sensors,  ///< what has arrived: datagrams, the hands and bodies of the servos
  actions,  ///< what the program wants: entities added, moved, removed, PDUs
  tasks,    ///< of each entity: its track, what is near it, updates that are due
  publish   ///< contacts to the servos, bundles to the network, views
};

/// Names of the stages, in their order.
inline constexpr std::array<std::string_view, 4> kLoopStages = {"sensors", "actions", "tasks",
                                                                "publish"};

/// One stage of one pass, as it ran.
struct LoopStep {
  std::uint64_t pass = 0;            ///< from 1
  std::chrono::nanoseconds time{0};  ///< instant of the pass, by the clock of the loops
  LoopStage stage = LoopStage::sensors;
  std::chrono::nanoseconds begin{0};  ///< since the pass began, by the host's steady clock
  std::chrono::nanoseconds took{0};   ///< by the host's steady clock, also in simulated time
};

using LoopRing = haptics::SpscRing<LoopStep>;

/// Records stages where a ring is given. One thread; allocates nothing; 40 ns a stage, 1 without.
class LoopTrace {
 public:
  /// @param ring outlives it; nullptr: none. A full ring misses steps.
  void record(LoopRing* ring) noexcept { ring_ = ring; }

  void begin_pass(std::chrono::nanoseconds now) noexcept {
    ++step_.pass;
    step_.time = now;
    if (ring_ != nullptr) begun_ = ended_ = clock_.now();
  }
  /// Call it as a stage ends.
  void end(LoopStage stage) noexcept {
    if (ring_ == nullptr) return;
    const std::chrono::nanoseconds now = clock_.now();
    step_.stage = stage;
    step_.begin = ended_ - begun_;
    step_.took = now - ended_;
    ended_ = now;
    ring_->push(step_);
  }

 private:
  LoopRing* ring_ = nullptr;
  SteadyClock clock_;
  LoopStep step_;
  std::chrono::nanoseconds begun_{0}, ended_{0};
};

}  // namespace reckon::peer
