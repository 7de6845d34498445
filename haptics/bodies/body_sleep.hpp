// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The end of a step: bodies at rest fall asleep, and each body notes its contact island.
#pragma once

#include "reckon/haptics/bodies/body_slots.hpp"
#include "reckon/haptics/bodies/contact_joints.hpp"

namespace reckon::haptics {

/// An island falls asleep as a whole: a single sleeping body would be woken by the others and
/// disturb them. @param acting bodies of the step  @param dt [s]
void put_to_sleep(BodySlots& slots, BodySet acting, ContactJoints& joints, double dt) noexcept;

}  // namespace reckon::haptics
