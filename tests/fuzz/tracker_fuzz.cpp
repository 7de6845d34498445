// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Sequence numbers of up to 16 senders in 8 groups, some near the wrap and far apart, with
// forgotten senders. While the tracker has evicted nothing, its verdicts and counts equal the
// results from the sets of received numbers. Its table stays within bounds and allocates no heap.
#include <algorithm>
#include <array>

#include "reckon/aoim/groups/sequence_tracker.hpp"
#include "reckon/tests/fuzz/fuzz_target.hpp"
#include "reckon/tests/fuzz/peers/counted_truth.hpp"

namespace reckon::fuzz {
namespace {

constexpr std::size_t kStep = 4;         // octets an operation
constexpr std::int32_t kMost = 1 << 18;  // range of numbers without base: four times the farthest
constexpr std::size_t kPairs = 16 * 8;

void check_counts(const aoim::SequenceCounts& counts, const aoim::SequenceCounts& right) {
  require(counts.received == right.received, "received datagrams are counted wrong");
  require(counts.lost == right.lost, "lost datagrams are counted wrong");
  require(counts.duplicated == right.duplicated, "copies are counted wrong");
  require(counts.reordered == right.reordered, "late datagrams are counted wrong");
  require(counts.too_old == right.too_old, "datagrams behind the window are counted wrong");
  require(counts.leaps == right.leaps, "datagrams far from all others are counted wrong");
}

/// An operation: sender and group, and the distance from the number before.
struct Operation {
  std::uint8_t kind, pair;
  std::int32_t ahead;
};

Operation operation_of(std::span<const std::byte> octets) noexcept {
  const auto at = [&](std::size_t i) { return std::to_integer<unsigned>(octets[i]); };
  const std::int32_t ahead = static_cast<std::int16_t>(at(2) << 8 | at(3));
  // Mostly within the window, else around its borders, or around the limit of missing numbers.
  const std::int32_t step = at(0) % 8 < 5 ? ahead % 256 : at(0) % 8 == 7 ? 4 * ahead : ahead;
  return {static_cast<std::uint8_t>(at(0)), static_cast<std::uint8_t>(at(1) % kPairs), step};
}

}  // namespace

void check(std::span<const std::byte> input) {
  if (input.empty()) return;
  const std::size_t capacity = 1 + std::to_integer<std::size_t>(input[0]);
  aoim::SequenceTracker tracker(capacity);
  CountedTruth truth;
  std::array<std::int32_t, kPairs> last{};
  last.fill(kMost / 2);
  for (std::span rest = input.subspan(1); rest.size() >= kStep; rest = rest.subspan(kStep)) {
    const Operation op = operation_of(rest);
    const std::uint32_t epoch = 1U + op.pair % 16U;
    const aoim::GroupIndex group{static_cast<std::uint16_t>(op.pair / 16)};
    if (op.kind == 255) {
      tracker.forget(epoch);
      truth.forget(epoch);
    } else if (op.kind == 254) {
      tracker.forget(group);
      truth.forget(group);
    } else {
      std::int32_t& number = last[op.pair];
      number = std::clamp(number + op.ahead, 1, kMost);
      // The numbers of each sender begin elsewhere, some just before the wrap.
      const std::uint32_t base = epoch % 2 == 0 ? 0U - std::uint32_t{kMost} / 2 : epoch << 28;
      const HeapMeter heap;
      const auto verdict = tracker.note(epoch, group, base + static_cast<std::uint32_t>(number));
      require(heap.allocations() == 0, "the tracker took heap");
      const auto right = truth.note(epoch, group, static_cast<std::uint32_t>(number));
      if (tracker.counts().given_up == 0) require(verdict == right, "a verdict is wrong");
    }
    require(tracker.size() <= capacity, "more pairs are tracked than there is room for");
    if (tracker.counts().given_up == 0) check_counts(tracker.counts(), truth.counts());
  }
}

}  // namespace reckon::fuzz
