// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// One step of an area of interest manager, checked the same way in every target that feeds one.
#pragma once

#include <chrono>
#include <cstddef>
#include <span>

#include "reckon/aoim/area_of_interest_manager.hpp"
#include "reckon/pdu/bundle.hpp"
#include "reckon/tests/fuzz/fuzz_target.hpp"

namespace reckon::fuzz {

/// Steps it: sent datagrams read back and go to the base group or one of the `pool`, and the next
/// step is due after this one.
inline void step_soundly(aoim::AreaOfInterestManager& aoim, std::size_t pool,
                         std::chrono::nanoseconds now) {
  aoim.step(now, [pool](aoim::GroupIndex group, std::span<const std::byte> octets) {
    require(group.value <= pool, "a datagram left for a group that does not exist");
    for (const pdu::BundledPdu& bundled : pdu::BundleReader(octets)) {
      require(bundled.error == pdu::DecodeError::none, "what was sent cannot be read");
    }
  });
  require(aoim.next_step() > now, "the next step is due before this one");
}

}  // namespace reckon::fuzz
