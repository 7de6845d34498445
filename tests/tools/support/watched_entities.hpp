// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Entities for the view `top`, at given positions and times.
#pragma once

#include <chrono>
#include <cmath>
#include <cstdint>
#include <string_view>

#include "reckon/pdu/pdu_types.hpp"
#include "reckon/pdu/timestamp.hpp"

namespace reckon::tools::watched {

using std::chrono::nanoseconds;
using std::chrono::seconds;

inline constexpr nanoseconds kStart = seconds(1'700'000'000);
inline constexpr double kRadius = 6'378'137.0;  ///< [m], of the earth

/// `time` [s] after the start.
inline nanoseconds after(double time) { return kStart + nanoseconds(std::llround(1e9 * time)); }

/// An aircraft 1:2:`entity` at `time` [s], `z` [m] along the axis of the earth.
inline pdu::EntityState entity_at(double time, double z, std::uint16_t entity,
                                  std::string_view marking) {
  pdu::EntityState pdu;
  pdu.header.timestamp = pdu::to_dis_timestamp(after(time), true);
  pdu.entity_id = {1, 2, entity};
  pdu.force_id = pdu::ForceId::friendly;
  pdu.entity_type.kind = pdu::EntityKind::platform;
  pdu.entity_type.domain = pdu::EntityDomain::air;
  pdu.dead_reckoning.algorithm = pdu::DeadReckoningAlgorithm::fpw;
  pdu.location = {kRadius, 0, z};
  pdu.marking.set(marking);
  return pdu;
}

}  // namespace reckon::tools::watched
