// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// One process from its start to its end, with data that only the simulation has.
#pragma once

#include <algorithm>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "reckon/tests/fuzz/peers/simulated_peer.hpp"
#include "reckon/tests/fuzz/search/datagram.hpp"

namespace reckon::fuzz {

struct PeerDatagram : Datagram {
  std::size_t sender = kNobody;                ///< life that sent it; nobody: forged
  std::uint32_t epoch = 0;                     ///< epoch in the datagram
  std::optional<aoim::PeerId> announces = {};  ///< the number under which it announces its sender
};
using SharedDatagram = std::shared_ptr<const PeerDatagram>;

struct Life {
  std::size_t host = 0;
  std::uint32_t epoch = 0;
  aoim::SourceAddress from;
  nanoseconds born{};
  std::unique_ptr<SimulatedPeer> peer;
  bool alive = true, frozen = false;
  bool left = false;    ///< sent its leave announcement
  nanoseconds ended{};  ///< when it departed or was killed
  nanoseconds frozen_at{};
  nanoseconds slept{}, slept_long{};  ///< total sleep; sleep in pauses that it must notice
  nanoseconds wake{};                 ///< when its next step is due
  std::vector<SharedDatagram> held;   ///< datagrams in the socket of a frozen process
  nanoseconds id_since{};
  std::vector<aoim::PeerId> ids;  ///< all numbers it has had, the present one last
  /// When a usable datagram, and when any datagram of a life was received last, and how long this
  /// process had slept then.
  struct Heard {
    std::uint32_t epoch = 0;
    nanoseconds usable{}, slept_long{}, any{}, slept{};
    nanoseconds announced = nanoseconds::max();  ///< when an announcement arrived first
  };
  std::vector<Heard> heard;

  [[nodiscard]] bool has_had(aoim::PeerId id) const noexcept {
    return std::find(ids.begin(), ids.end(), id) != ids.end();
  }
  [[nodiscard]] const Heard* heard_of(std::uint32_t of) const noexcept {
    for (const Heard& one : heard) {
      if (one.epoch == of) return &one;
    }
    return nullptr;
  }
  void note_heard(std::uint32_t of, nanoseconds now, bool usable, bool announces) {
    auto one = std::find_if(heard.begin(), heard.end(),
                            [of](const Heard& candidate) { return candidate.epoch == of; });
    const bool first = one == heard.end();
    if (first) one = heard.insert(heard.end(), Heard{of});
    one->any = now;
    one->slept = slept;
    if (announces) one->announced = std::min(one->announced, now);
    if (!usable && !first) return;
    one->usable = now;
    one->slept_long = slept_long;
  }
  /// Time without a datagram of a life, minus own sleep.
  [[nodiscard]] nanoseconds silence(const Heard& one, nanoseconds now) const noexcept {
    return now - one.any - (slept - one.slept);
  }
  /// Time without a usable datagram, minus the own sleep that it must notice.
  [[nodiscard]] nanoseconds known_silence(const Heard& one, nanoseconds now) const noexcept {
    return now - one.usable - (slept_long - one.slept_long);
  }
};

}  // namespace reckon::fuzz
