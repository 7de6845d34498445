// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Impostors: each pair of owner and sender is reported once, however often it is received.
#pragma once

#include <algorithm>
#include <array>
#include <chrono>
#include <cstddef>
#include <optional>

#include "reckon/aoim/groups/peer_id.hpp"
#include "reckon/aoim/presence/source_address.hpp"

namespace reckon::peer {

/// A PDU about an entity that another sender owns.
struct Dispute {
  aoim::PeerId name;          ///< peer in whose name it was sent
  aoim::SourceAddress owner;  ///< owner of the entity
  aoim::SourceAddress speaker;
};

/// The disputes of one peer. One thread; no allocation.
class Disputes {
 public:
  /// Pairs remembered; the one that was quiet for the longest makes room for a new one.
  static constexpr std::size_t kPairs = 32;
  /// A pair that returns after this time is reported again.
  static constexpr std::chrono::nanoseconds kQuiet = std::chrono::minutes(1);
  /// Least time between two reports, so that a flood of names does not fill a terminal.
  static constexpr std::chrono::nanoseconds kGap = std::chrono::seconds(1);

  /// Records one more refused datagram or update. Some 20 ns.
  void note(const Dispute& dispute, std::chrono::nanoseconds now) noexcept {
    if (Pair* known = find(dispute)) {
      if (now - known->last > kQuiet) *known = {dispute, now, now, false};
      known->last = now;
      return;
    }
    const auto quietest = [](const Pair& a, const Pair& b) { return a.last < b.last; };
    Pair& place = count_ < kPairs ? pairs_[count_++]
                                  : *std::min_element(pairs_.begin(), pairs_.end(), quietest);
    place = {dispute, now, now, false};
  }
  /// The oldest dispute that is not reported yet, at most one in kGap.
  [[nodiscard]] std::optional<Dispute> take_news(std::chrono::nanoseconds now) noexcept {
    if (last_news_ && now - *last_news_ < kGap) return {};
    Pair* oldest = nullptr;
    for (std::size_t i = 0; i < count_; ++i) {
      Pair& pair = pairs_[i];
      if (!pair.reported && (oldest == nullptr || pair.first < oldest->first)) oldest = &pair;
    }
    if (oldest == nullptr) return {};
    oldest->reported = true;
    last_news_ = now;
    return oldest->dispute;
  }

 private:
  struct Pair {
    Dispute dispute;
    std::chrono::nanoseconds first{0}, last{0};
    bool reported = false;
  };
  [[nodiscard]] Pair* find(const Dispute& dispute) noexcept {
    // Compares the sending host without its port, because a host can change ports at no cost.
    const auto end = pairs_.begin() + static_cast<std::ptrdiff_t>(count_);
    const auto found = std::find_if(pairs_.begin(), end, [&](const Pair& pair) {
      return pair.dispute.name == dispute.name &&
             pair.dispute.speaker.octets == dispute.speaker.octets;
    });
    return found == end ? nullptr : &*found;
  }

  std::array<Pair, kPairs> pairs_{};
  std::size_t count_ = 0;
  std::optional<std::chrono::nanoseconds> last_news_;
};

}  // namespace reckon::peer
