// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The counters of ownership, with their published names.
#pragma once

#include "reckon/peer/counters/counters.hpp"
#include "reckon/peer/ownership/ownership_core.hpp"

namespace reckon::peer {

/// Made at set-up; `counters` outlives them.
class OwnershipCounters {
 public:
  explicit OwnershipCounters(Counters& counters)
      : granted_(counters.make("bodies_granted", "bodies given to other peers")),
        taken_(counters.make("bodies_taken", "bodies granted to this peer")),
        adopted_(counters.make("bodies_adopted", "bodies of failed or departed owners taken over")),
        refused_(
            counters.make("ownership_refused",
                          "grants and owners refused: old, not asked for, or without witness")),
        released_(counters.make("bodies_released", "bodies whose grant had no answer")),
        merged_(counters.make("worlds_merged", "worlds of owners left for an older one")) {}

  /// Publishes what the protocol has counted.
  void publish(const OwnershipCounts& counts) noexcept {
    granted_.add(counts.granted - last_.granted);
    taken_.add(counts.taken - last_.taken);
    adopted_.add(counts.adopted - last_.adopted);
    refused_.add(counts.refused - last_.refused);
    released_.add(counts.released - last_.released);
    merged_.add(counts.merged - last_.merged);
    last_ = counts;
  }

 private:
  Counter& granted_;
  Counter& taken_;
  Counter& adopted_;
  Counter& refused_;
  Counter& released_;
  Counter& merged_;
  OwnershipCounts last_;
};

}  // namespace reckon::peer
