// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Cost of sending the own entities: decisions, updates by reason, and octets.
#pragma once

#include <array>
#include <cstddef>
#include <string>
#include <vector>

#include "reckon/aoim/tiers/tier_table.hpp"
#include "reckon/deadreckon/sending/update_policy.hpp"
#include "reckon/peer/counters/counters.hpp"

namespace reckon::peer {

/// The counters of an owner. Made at set-up; `counters` outlives them.
struct SendCounters {
  SendCounters(Counters& counters, const aoim::TierTable& tiers)
      : checks(counters.make("send_checks", "decisions whether an own entity is due")),
        updates(counters.make("updates_out", "own updates sent, for any reason")),
        held_back(counters.make("updates_held_back",
                                "own updates held back, because no receiver needs them yet")),
        by_tier(tier_counters(counters, tiers)),
        octets(counters.make("own_octets",
                             "octets of own updates: Entity States and their records of force")) {
    for (std::size_t i = 1; i < by_reason.size(); ++i) {
      const auto reason = static_cast<deadreckon::SendReason>(i);
      by_reason[i] = &counters.make_in(kUpdatesByReason, deadreckon::name(reason),
                                       "sent_" + std::string(deadreckon::name(reason)),
                                       "own updates sent for this reason");
    }
  }

  void sent(deadreckon::SendReason reason, std::size_t size) noexcept {
    by_reason[static_cast<std::size_t>(reason)]->add();
    updates.add();
    octets.add(size);
  }

  Counter& checks;
  Counter& updates;
  Counter& held_back;
  std::vector<Counter*> by_tier;  ///< null for the cell tier
  Counter& octets;
  std::array<Counter*, 7> by_reason{};  ///< by SendReason, from 1

 private:
  // Kinds without a tier in the scene also have a counter.
  static std::vector<Counter*> tier_counters(Counters& counters, const aoim::TierTable& tiers) {
    const auto counter_of = [&](const aoim::TierKind& kind) {
      return kind.name.empty()
                 ? nullptr
                 : &counters.make_in(kUpdatesByTier, kind.name, "updates_" + std::string(kind.name),
                                     "own updates sent to a " + std::string(kind.groups));
    };
    for (const aoim::TierKind* kind : aoim::tier_kinds()) counter_of(*kind);
    std::vector<Counter*> by_tier;
    for (std::size_t tier = 0; tier < tiers.count(); ++tier)
      by_tier.push_back(counter_of(tiers.kind(tier)));
    return by_tier;
  }
};

}  // namespace reckon::peer
