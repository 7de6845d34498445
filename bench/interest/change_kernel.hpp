// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Exact comparison, at two ticks, of the pairs of slots that a border kernel named: finds which
// have begun or ceased to receive each other. It is the second loop of incremental interest.
#pragma once

#include <cstddef>
#include <cstdint>

#include "reckon/bench/interest/hearer.hpp"
#include "reckon/bench/interest/hearing_change.hpp"
#include "reckon/bench/interest/overlap_kernel.hpp"

namespace reckon::bench {

/// Slots of one layout, and the places of the same entities in the layout of the other tick.
struct ChangeColumns {
  const Hearer *here = nullptr, *there = nullptr;
  const std::uint32_t* link = nullptr;    ///< slots in `there`
  const std::uint32_t* entity = nullptr;  ///< entity of each slot in `here`
  const Apart* apart = nullptr;           ///< of `here`; only `no` is compared
};

/// Changes of a pair that are written.
enum class ChangeTold : std::uint8_t {
  both,   ///< reception differs between here and there: writes the state here
  began,  ///< receives here and not there: written as begun
  ceased  ///< receives here and not there: written as ceased, because `here` is the earlier tick
};

/// Writes keys of HearingChanges for the pairs (own[i], other[i]), i < count, in both directions
/// and in order. Returns the end of the keys. The output has room for two keys a pair and one more.
using ChangeKernel = std::uint64_t* (*)(const ChangeColumns& columns, const std::uint32_t* own,
                                        const std::uint32_t* other, std::size_t count,
                                        std::uint64_t* out);

/// Uses the best available level if the processor lacks `level`. All levels give the same keys.
[[nodiscard]] ChangeKernel change_kernel(SimdLevel level, ChangeTold told) noexcept;

}  // namespace reckon::bench
