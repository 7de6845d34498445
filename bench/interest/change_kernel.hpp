// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Pairs of slots that a border kernel named, exactly, at two ticks: which have begun to hear each
// other or ceased to? The second loop of incremental interest.
#pragma once

#include <cstddef>
#include <cstdint>

#include "reckon/bench/interest/hearer.hpp"
#include "reckon/bench/interest/hearing_change.hpp"
#include "reckon/bench/interest/overlap_kernel.hpp"

namespace reckon::bench {

/// Slots of one layout, and where the same entities are in that of the other tick.
struct ChangeColumns {
  const Hearer *here = nullptr, *there = nullptr;
  const std::uint32_t* link = nullptr;    ///< slots of `there`
  const std::uint32_t* entity = nullptr;  ///< of `here`
  const Apart* apart = nullptr;           ///< of `here`; who is not `no` is left out
};

/// What is told of a pair.
enum class ChangeTold : std::uint8_t {
  both,   ///< hearing here differs from there: what it is here
  began,  ///< hears here and not there: heard
  ceased  ///< the same: heard no longer, for `here` is the earlier tick
};

/// Writes keys of HearingChanges of the pairs (own[i], other[i]), i < count, in both directions and
/// in their order; returns the end of them. There is room for two of each pair and one more.
using ChangeKernel = std::uint64_t* (*)(const ChangeColumns& columns, const std::uint32_t* own,
                                        const std::uint32_t* other, std::size_t count,
                                        std::uint64_t* out);

/// Where the processor lacks `level`, the best that it has. All give the same keys.
[[nodiscard]] ChangeKernel change_kernel(SimdLevel level, ChangeTold told) noexcept;

}  // namespace reckon::bench
