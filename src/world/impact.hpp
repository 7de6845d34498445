// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// A blow of a hand on another one, as a Collision-Elastic PDU.
#pragma once

#include <chrono>
#include <optional>

#include "reckon/deadreckon/motion/geocentric.hpp"
#include "reckon/haptics/exchange/servo_types.hpp"
#include "reckon/pdu/entity/collision_elastic.hpp"
#include "reckon/peer/world/state_table.hpp"

namespace reckon::peer {

/// The impact of our hand, of `radius` [m], on a remote one at `now`; the caller sets header,
/// issuer and event. Nullopt if the contact is too slow for a collision.
[[nodiscard]] std::optional<pdu::CollisionElastic> impact_of(const haptics::ServoSnapshot& servo,
                                                             double radius,
                                                             const haptics::ContactAccount& contact,
                                                             const RemoteEntity& row,
                                                             const deadreckon::LocalFrame& frame,
                                                             std::chrono::nanoseconds now) noexcept;

}  // namespace reckon::peer
