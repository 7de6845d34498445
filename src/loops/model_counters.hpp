// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The counters of the model loop, with their published names.
#pragma once

#include "reckon/peer/counters/counters.hpp"

namespace reckon::peer {

/// The counters of a model loop. Made at set-up; `counters` outlives them.
struct ModelCounters {
  explicit ModelCounters(Counters& counters)
      : power_given(counters.make("power_given_uj",
                                  "[uJ] that entities without a device gave to hands they pushed")),
        datagrams_refused(counters.make_in(kRefusedDatagrams, "not_admitted", "datagrams_refused",
                                           "duplicates, and datagrams of an earlier run, another "
                                           "scene or exercise, a stranger, or a group left since")),
        unicast_refused(counters.make_in(kRefusedDatagrams, "unicast", "unicast_refused",
                                         "unicast datagrams other than assured records of a "
                                         "member from its address")),
        orders_refused(counters.make(
            "orders_refused",
            "Stop/Freeze and Start/Resume from senders that the scene does not allow")),
        interactions_refused(counters.make(
            "interactions_refused",
            "interactions (Fire, Detonation, ..) of a sender that does not own the issuer")),
        emissions_refused(counters.make("emissions_refused",
                                        "refused states of emitters, IFF systems and radios: "
                                        "damaged, sent by a host other than "
                                        "the first, or the table was full")),
        lost(counters.make("datagrams_lost", "datagrams missing by their sequence numbers")),
        leaps(counters.make("sequence_leaps", "datagrams with a sequence number too far ahead")),
        doubled(counters.make("datagrams_doubled", "datagrams that arrived again")),
        reordered(counters.make("datagrams_reordered", "datagrams that were overtaken")),
        numberings_given_up(counters.make("numberings_given_up",
                                          "senders in a group that were replaced by others: "
                                          "datagrams_lost may omit their losses")),
        write_overflow(counters.make("write_overflow", "dropped because the writer lags")),
        stale_unsent(counters.make("stale_unsent",
                                   "own datagrams dropped after waiting for more than 1 s")) {}

  Counter& power_given;
  Counter& datagrams_refused;
  Counter& unicast_refused;
  Counter& orders_refused;
  Counter& interactions_refused;
  Counter& emissions_refused;
  Counter& lost;
  Counter& leaps;
  Counter& doubled;
  Counter& reordered;
  Counter& numberings_given_up;
  Counter& write_overflow;
  Counter& stale_unsent;
};

}  // namespace reckon::peer
