// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Epochs of peers that presence has found to have ended. They identify stale datagrams, and peers
// that return.
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
  std::chrono::nanoseconds since{};  ///< end of the epoch
  SourceAddress source;
  LifeTip tip;
  std::chrono::nanoseconds known_since{}, last_heard{};
  bool has_announced_end = false;
};

/// The last 64 ended epochs. Epochs that may return and were received for long are kept longest.
/// One thread; allocates nothing after construction.
class FormerLives {
 public:
  static constexpr std::size_t kMost = 64;

  FormerLives() { lives_.reserve(kMost); }

  /// Null if this epoch is not known to have ended; valid until the next call.
  [[nodiscard]] FormerLife* find(std::uint32_t epoch) noexcept;
  [[nodiscard]] bool contains(std::uint32_t epoch) const noexcept;
  /// Whether the announced epoch has ended. An epoch that proves its identity is alive. One without
  /// a proof is alive if it is received long after its end, or with another ID. From another
  /// address it is accepted after `pin`.
  [[nodiscard]] bool is_over(const pdu::Presence& heard, std::chrono::nanoseconds now,
                             const SourceAddress& from, ProofJudge& proofs,
                             std::chrono::nanoseconds pin) noexcept;
  /// Adds an ended epoch.
  void add(const FormerLife& life);
  /// Removes an epoch. @return its stored data
  std::optional<FormerLife> take(std::uint32_t epoch) noexcept;

 private:
  std::vector<FormerLife> lives_;  // oldest first
};

}  // namespace reckon::aoim
