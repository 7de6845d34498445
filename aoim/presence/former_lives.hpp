// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The lives of peers that are over, as far as presence knows: what comes late in their names is
// known by them, and so are those that come back.
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "reckon/aoim/groups/peer_id.hpp"
#include "reckon/aoim/presence/life_chain.hpp"
#include "reckon/aoim/presence/proof_judge.hpp"
#include "reckon/aoim/presence/source_address.hpp"

namespace reckon::aoim {

struct FormerLife {
  PeerId id;
  std::uint32_t epoch = 0;
  std::chrono::nanoseconds since{};  ///< it is over
  SourceAddress source;
  LifeTip tip;
  std::chrono::nanoseconds known_since{}, last_heard{};
  bool said_goodbye = false;
};

/// The last 64 of them. One that may come back and was heard for long is remembered longest. One
/// thread; allocates nothing after construction.
class FormerLives {
 public:
  static constexpr std::size_t kMost = 64;

  FormerLives() { lives_.reserve(kMost); }

  /// Null where this life is not known to be over; good until the next call.
  [[nodiscard]] FormerLife* find(std::uint32_t epoch) noexcept;
  [[nodiscard]] bool contains(std::uint32_t epoch) const noexcept;
  /// Whether the life that announces itself is over. Who proves itself lives, and who offers no
  /// proof where it speaks long after, or under another id; one from elsewhere is believed after
  /// `pin`.
  [[nodiscard]] bool is_over(const pdu::Presence& heard, std::chrono::nanoseconds now,
                             const SourceAddress& from, ProofJudge& proofs,
                             std::chrono::nanoseconds pin) noexcept;
  /// This one is over, too.
  void add(const FormerLife& life);
  /// It is forgotten. @return what was known of it
  std::optional<FormerLife> take(std::uint32_t epoch) noexcept;

 private:
  std::vector<FormerLife> lives_;  // oldest first
};

}  // namespace reckon::aoim
