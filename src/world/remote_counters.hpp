// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Counters of remote entities, with the names under which they are published.
#pragma once

#include "reckon/peer/counters/counters.hpp"

namespace reckon::peer {

/// The counters of RemoteEntities. Made at set-up; `counters` outlives them.
struct RemoteCounters {
  explicit RemoteCounters(Counters& counters)
      : accepted(counters.make("updates_in", "updates of remote entities accepted")),
        refused_values(counters.make("values_refused", "updates with impossible values")),
        refused_models(counters.make("models_refused", "force models with impossible values")),
        untouchables(
            counters.make("touch_refused", "force models of senders that `touch` does not permit")),
        bodies_disputed(counters.make("bodies_disputed",
                                      "states of the scene's bodies from others than their owner")),
        bodies_early(counters.make(
            "bodies_early", "states of the scene's bodies from an owner that is not known yet")),
        bodies_stale(counters.make(
            "bodies_stale", "states of the scene's bodies of an older version of ownership")),
        reserved(counters.make("reserved_ids_in",
                               "updates of IDs that no entity can have, such as 0:0:0 and 65535")),
        stale(counters.make("stale_in", "stale updates, dropped")),
        repeats(counters.make("repeats_in", "repeated updates")),
        sender_leaps(counters.make("sender_leaps", "entities whose sender's clock jumped")),
        not_interesting(counters.make("not_interesting", "entities outside the radius")),
        entered(counters.make("entered", "entities that came within the radius between updates")),
        table_full(
            counters.make("table_full", "entities refused because the state table was full")),
        strangers_full(counters.make("strangers_full",
                                     "entities of plain DIS programs beyond `strangers_memory`")),
        evicted(counters.make("rows_evicted",
                              "entities of senders with too many, dropped to make room")),
        disputed(counters.make("disputed_in",
                               "updates refused, because another peer owns their entity")),
        timed_out(counters.make("timed_out", "entities dropped after silence")),
        left(counters.make("left", "entities that were deactivated or left the radius")),
        snaps(counters.make("snaps",
                            "updates of watched entities shown at once: teleports, frozen or "
                            "resumed")) {}

  Counter& accepted;
  Counter& refused_values;
  Counter& refused_models;
  Counter& untouchables;
  Counter& bodies_disputed;
  Counter& bodies_early;
  Counter& bodies_stale;
  Counter& reserved;
  Counter& stale;
  Counter& repeats;
  Counter& sender_leaps;
  Counter& not_interesting;
  Counter& entered;
  Counter& table_full;
  Counter& strangers_full;
  Counter& evicted;
  Counter& disputed;
  Counter& timed_out;
  Counter& left;
  Counter& snaps;
};

}  // namespace reckon::peer
