// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Records pointer samples with their times, for a second device that follows the same pointer
// later.
#pragma once

#include <chrono>
#include <cstddef>

#include "reckon/haptics/devices/pointer_inbox.hpp"
#include "reckon/haptics/exchange/spsc_ring.hpp"
#include "reckon/peer/clocks/clock.hpp"

namespace reckon::tools {

/// One thread records, one thread plays; neither waits for the other. Holds up to kMost samples,
/// about four seconds of input from a page; newer ones are dropped.
class PointerRecorder {
 public:
  static constexpr std::size_t kMost = 256;

  /// @param clock of the servo of the first device; outlives this
  explicit PointerRecorder(const peer::Clock& clock) : clock_(clock) {}

  /// Records a sample with the present time.
  void put(const haptics::PointerSample& sample) noexcept { ring_.push({clock_.now(), sample}); }

  /// Puts the samples recorded until `now` into the inbox of another device.
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
