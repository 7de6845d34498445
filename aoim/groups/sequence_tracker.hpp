// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Counts the network's effects on the datagrams of each (sender, group), from the sequence numbers
// in their trailers. DIS has no sequence numbers, so loss would go unnoticed. The epoch identifies
// the sender, so a restarted peer begins a new count by itself.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "reckon/aoim/groups/group_index.hpp"

namespace reckon::aoim {

/// Result for one datagram.
enum class SequenceVerdict : std::uint8_t {
  in_order,   ///< the next one, or after a gap
  first,      ///< the first of this sender in this group
  late,       ///< fills a gap: reordered on the way, usable
  leap,       ///< far ahead of all before: usable; a second one like it changes the numbering
  duplicate,  ///< received before: not usable
  too_old,    ///< more than the window behind: undecidable, not usable
};

/// True if the datagram's PDUs are to be used.
[[nodiscard]] constexpr bool is_usable(SequenceVerdict verdict) noexcept {
  return verdict != SequenceVerdict::duplicate && verdict != SequenceVerdict::too_old;
}

/// Sums since the start. `lost` counts the presently missing numbers, so it falls when a late
/// datagram arrives.
struct SequenceCounts {
  std::uint64_t received = 0;    ///< datagrams, duplicates included
  std::uint64_t lost = 0;        ///< gaps not filled (yet)
  std::uint64_t duplicated = 0;  ///< copies of one already received
  std::uint64_t reordered = 0;   ///< arrived after a newer one
  std::uint64_t too_old = 0;     ///< behind the window
  std::uint64_t leaps = 0;       ///< too far from all before to be believed alone
  /// Pairs dropped to make room. Losses between their last datagram and their next are not in
  /// `lost`, and copies of that time are not recognised.
  std::uint64_t given_up = 0;
};

/// Tracks the most recently received (sender, group) pairs. One thread; allocates nothing after
/// construction.
class SequenceTracker {
 public:
  /// Datagrams that may overtake one before it can no longer be distinguished from a duplicate.
  static constexpr std::size_t kWindow = 256;
  /// A number farther than this from the last one, a minute at 1,000 a second, shows no loss: the
  /// sender has restarted its count.
  static constexpr std::uint32_t kFarthest = 1U << 16;

  /// 1,000 peers in 16 groups each.
  static constexpr std::size_t kCapacity = 16384;

  /// @param capacity (sender, group) pairs, 1 .. 2^24, some 80 octets each; the pair that was
  /// silent for the longest makes room for a new one.
  explicit SequenceTracker(std::size_t capacity = kCapacity);

  /// Records one datagram of the sender with this epoch. About 15 ns. A number more than the window
  /// ahead, or kFarthest behind, does not move the count. It is believed when another one comes
  /// within a window of it, so that a single forged number cannot make the genuine ones too old.
  SequenceVerdict note(std::uint32_t epoch, GroupIndex group, std::uint32_t sequence) noexcept;

  /// Removes a group that was left or newly joined: what was sent meanwhile is not loss.
  void forget(GroupIndex group) noexcept;
  /// Removes a sender that has gone.
  void forget(std::uint32_t epoch) noexcept;

  [[nodiscard]] const SequenceCounts& counts() const noexcept { return counts_; }
  /// (sender, group) pairs tracked now.
  [[nodiscard]] std::size_t size() const noexcept { return tracks_.size(); }

 private:
  static constexpr std::size_t kWords = kWindow / 64;
  static constexpr std::uint32_t kNone = ~std::uint32_t{0};
  struct Track {
    std::uint32_t epoch = 0;
    GroupIndex group;
    std::uint32_t highest = 0;
    std::uint32_t span = 0;      ///< from the first sequence number received to the highest
    std::uint32_t leapt_to = 0;  ///< the number of the last leap, if has_leapt
    bool has_leapt = false;
    std::uint32_t newer = kNone, older = kNone;  ///< places of the next and previous pair received
    std::array<std::uint64_t, kWords> seen{};    ///< bit i = highest - i was received
  };
  Track& find_or_add(std::uint32_t epoch, GroupIndex group) noexcept;
  /// Place of the pair in the index, or the gap for it.
  [[nodiscard]] std::size_t slot_of(std::uint32_t epoch, GroupIndex group) const noexcept;
  void erase(std::uint32_t place) noexcept;
  void close_gap(std::size_t slot) noexcept;
  void link_newest(std::uint32_t place) noexcept;
  void unlink(std::uint32_t place) noexcept;
  static SequenceVerdict begin(Track& track, std::uint32_t sequence) noexcept;
  SequenceVerdict advance(Track& track, std::uint32_t ahead) noexcept;
  SequenceVerdict look_back(Track& track, std::uint32_t behind) noexcept;
  SequenceVerdict hold_leap(Track& track, std::uint32_t sequence) noexcept;
  void follow_leap(Track& track, std::uint32_t sequence) noexcept;
  void reach_leap(Track& track) noexcept;
  void forget_if(auto predicate) noexcept;

  std::size_t capacity_;
  std::vector<Track> tracks_;
  /// Places in tracks_ by open addressing, half full at most (peer::KeyIndex is in a higher layer).
  std::vector<std::uint32_t> index_;
  std::uint32_t newest_ = kNone, oldest_ = kNone;
  SequenceCounts counts_;
};

}  // namespace reckon::aoim
