// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// One process from its start to its end, and what the simulation alone knows of it.
#pragma once

#include <algorithm>
#include <cstdint>
#include <memory>
#include <vector>

#include "reckon/tests/fuzz/peers/simulated_peer.hpp"

namespace reckon::fuzz {

inline constexpr std::size_t kNobody = ~std::size_t{0};

/// A datagram on its way to one or more processes.
struct Datagram {
  std::vector<std::byte> octets;
  aoim::GroupIndex group;
  aoim::SourceAddress from;
  std::size_t sender = kNobody;  ///< life; nobody: forged
  std::uint32_t epoch = 0;       ///< of the life it names
  std::size_t on_the_way = 0;
};

struct Life {
  std::size_t host = 0;
  std::uint32_t epoch = 0;
  aoim::SourceAddress from;
  nanoseconds born{};
  std::unique_ptr<SimulatedPeer> peer;
  bool alive = true, frozen = false;
  bool left = false;  ///< said good-bye
  nanoseconds frozen_at{};
  nanoseconds slept{}, slept_long{};  ///< all in all; in naps that it must notice
  nanoseconds wake{};                 ///< when its next step is due
  std::vector<std::size_t> held;      ///< datagrams in the socket of a frozen process
  nanoseconds id_since{};
  std::vector<aoim::PeerId> ids;  ///< that it has had, the present one last
  /// When a usable datagram of a life was received last and how long we had napped then; when any
  /// was, and how long we had slept.
  struct Heard {
    std::uint32_t epoch = 0;
    nanoseconds usable{}, slept_long{}, any{}, slept{};
    nanoseconds first{};  ///< when anything came first
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
  void note_heard(std::uint32_t of, nanoseconds now, bool usable) {
    for (Heard& one : heard) {
      if (one.epoch != of) continue;
      one = usable ? Heard{of, now, slept_long, now, slept, one.first}
                   : Heard{of, one.usable, one.slept_long, now, slept, one.first};
      return;
    }
    heard.push_back({of, now, slept_long, now, slept, now});
  }
  /// Since when nothing came from a life, without what we slept through.
  [[nodiscard]] nanoseconds silence(const Heard& one, nanoseconds now) const noexcept {
    return now - one.any - (slept - one.slept);
  }
  /// Since when nothing usable came, without what we know that we slept through.
  [[nodiscard]] nanoseconds known_silence(const Heard& one, nanoseconds now) const noexcept {
    return now - one.usable - (slept_long - one.slept_long);
  }
};

}  // namespace reckon::fuzz
