// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Cost of the own entities: decisions, updates by reason, and octets.
#pragma once

#include <array>
#include <cstddef>
#include <string>

#include "reckon/deadreckon/sending/update_policy.hpp"
#include "reckon/peer/counters/counters.hpp"

namespace reckon::peer {

/// The counters of an owner. Made at set-up; `counters` outlives them.
struct SendCounters {
  explicit SendCounters(Counters& counters)
      : checks(counters.make("send_checks", "decisions whether an own entity is due")),
        updates(counters.make("updates_out", "own updates sent, for any reason")),
        held_back(counters.make("updates_held_back",
                                "own updates held back, because no receiver needs them yet")),
        felt(counters.make("updates_felt", "own updates sent to a contact group")),
        near(counters.make("updates_near", "own updates sent to a near group")),
        octets(counters.make("own_octets",
                             "octets of own updates: Entity States and their records of force")) {
    for (std::size_t i = 1; i < by_reason.size(); ++i) {
      const auto reason = static_cast<deadreckon::SendReason>(i);
      by_reason[i] = &counters.make("sent_" + std::string(deadreckon::name(reason)),
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
  Counter& felt;
  Counter& near;
  Counter& octets;
  std::array<Counter*, 7> by_reason{};  ///< by SendReason, from 1
};

}  // namespace reckon::peer
