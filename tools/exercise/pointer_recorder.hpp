// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// What a pointer does, with the times, for a second device that follows the same pointer later.
#pragma once

#include <chrono>
#include <cstddef>

#include "reckon/haptics/devices/pointer_inbox.hpp"
#include "reckon/haptics/exchange/spsc_ring.hpp"
#include "reckon/peer/clocks/clock.hpp"

namespace reckon::tools {

/// One thread puts, one plays; neither waits for the other. Up to kMost samples wait, some four
/// seconds of a page; newer ones are dropped.
class PointerRecorder {
 public:
  static constexpr std::size_t kMost = 256;

  /// @param clock of the servo whose device takes the samples; outlives this
  explicit PointerRecorder(const peer::Clock& clock) : clock_(clock) {}

  /// As a PointerInbox of the servo gets it now.
  void put(const haptics::PointerSample& sample) noexcept { ring_.push({clock_.now(), sample}); }

  /// Hands what a servo finds at `now` to the inbox of another device.
  void play(std::chrono::nanoseconds now, haptics::PointerInbox& inbox) noexcept {
    for (const Put* next = ring_.front(); next != nullptr && next->time <= now;
         next = ring_.front()) {
      static_cast<void>(inbox.put(next->sample));
      ring_.pop();
    }
  }

 private:
  struct Put {
    std::chrono::nanoseconds time{0};
    haptics::PointerSample sample;
  };
  const peer::Clock& clock_;
  haptics::SpscRing<Put> ring_{kMost};
};

}  // namespace reckon::tools
