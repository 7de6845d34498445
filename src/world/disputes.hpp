// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Who speaks in the name of another: each pair of owner and speaker is news once, however often it
// is heard.
#pragma once

#include <array>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <optional>

#include "reckon/aoim/groups/peer_id.hpp"
#include "reckon/aoim/presence/source_address.hpp"

namespace reckon::peer {

/// Somebody said something of an entity that is another's.
struct Dispute {
  aoim::PeerId name;          ///< in which was spoken
  aoim::SourceAddress owner;  ///< whose it is
  aoim::SourceAddress speaker;
};

/// The disputes of one peer. One thread; no allocation.
class Disputes {
 public:
  /// Pairs remembered; of more, the one that has been quiet for the longest is forgotten.
  static constexpr std::size_t kPairs = 32;
  /// A pair that comes back after so long a quiet is news again.
  static constexpr std::chrono::nanoseconds kQuiet = std::chrono::minutes(1);
  /// Least time between two news, so that a flood of names fills no terminal.
  static constexpr std::chrono::nanoseconds kGap = std::chrono::seconds(1);

  /// One more datagram or update refused. Some 20 ns.
  void note(const Dispute& dispute, std::chrono::nanoseconds now) noexcept;
  /// The oldest that has not been reported, at most one each kGap.
  [[nodiscard]] std::optional<Dispute> take_news(std::chrono::nanoseconds now) noexcept;

 private:
  struct Pair {
    Dispute dispute;
    std::chrono::nanoseconds first{0}, last{0};
    bool reported = false;
  };
  [[nodiscard]] Pair* find(const Dispute& dispute) noexcept;

  std::array<Pair, kPairs> pairs_{};
  std::size_t count_ = 0;
  std::optional<std::chrono::nanoseconds> last_news_;
};

}  // namespace reckon::peer
