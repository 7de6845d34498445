// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Who may lean on how much of the device's damping: the sampled bound b > K T/2 + B holds for the
// sum of all contacts, so what one takes another cannot have.
#pragma once

#include <span>

#include "reckon/haptics/exchange/servo_types.hpp"

namespace reckon::haptics {

/// One contact's claim, in N s/m.
struct DampingClaim {
  double wanted = 0.0;    ///< >= 0, may be infinite; 0 = far from any contact
  double held = 0.0;      ///< of the step before
  bool touching = false;  ///< what is held is in use: it changes gradually
};

/// Shares `total` [N s/m] between the claims: each gets what it wants while there is enough, else
/// equal parts of what the modest leave. A share in use shrinks and grows by at most `total * step`
/// a call, and nobody grows before another has shrunk: the sum never exceeds `total`. Lowering a
/// share lowers stored energy, so all of it is passive. Linear in the claims, but for as many
/// rounds as there are modest ones that turn others modest.
/// @param claims at most kMaxRemoteHands
/// @param step fraction of `total`, e.g. 0.01 for 100 ms
/// @param shares filled in, as many as claims and in their order
void share_damping(std::span<const DampingClaim> claims, double total, double step,
                   std::span<double> shares) noexcept;

}  // namespace reckon::haptics
