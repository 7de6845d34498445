// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The counters of assured messages, with their published names.
#pragma once

#include "reckon/peer/counters/counters.hpp"

namespace reckon::peer {

/// Made at set-up; `counters` outlives them.
struct AssuredCounters {
  explicit AssuredCounters(Counters& counters)
      : sent(counters.make("assured_out", "assured records sent")),
        repeated(counters.make("assured_repeats", "transmissions that repeat an assured record")),
        undelivered(
            counters.make("assured_undelivered", "addressees that did not get an assured record")),
        taken(counters.make("assured_in", "assured records taken")),
        held(counters.make("assured_held_in",
                           "arrivals of records held until an earlier one arrives, also repeats")),
        doubled(counters.make("assured_doubled_in", "assured records received again, dropped")),
        refused(counters.make("assured_refused",
                              "assured records and acknowledgements of no member, of another "
                              "epoch, or outside the window of 256")),
        unknown(counters.make("assured_unknown", "assured records of unknown kinds, skipped")) {}

  Counter& sent;
  Counter& repeated;
  Counter& undelivered;
  Counter& taken;
  Counter& held;
  Counter& doubled;
  Counter& refused;
  Counter& unknown;
};

}  // namespace reckon::peer
