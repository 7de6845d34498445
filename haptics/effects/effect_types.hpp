// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// THE list of effects. A new effect is one header in effects/ and one row here.
#pragma once

#include <tuple>
#include <type_traits>

#include "reckon/haptics/effects/spring_damper.hpp"
#include "reckon/haptics/effects/stick_slip_friction.hpp"

namespace reckon::haptics {

using EffectTypes = std::tuple<SpringDamper, StickSlipFriction>;

/// Calls f(std::type_identity<Effect>{}) once per effect, in the order of the list.
template <class F>
void for_each_effect(F&& f) {
  [&]<class... Effects>(std::type_identity<std::tuple<Effects...>>) {
    (f(std::type_identity<Effects>{}), ...);
  }(std::type_identity<EffectTypes>{});
}

}  // namespace reckon::haptics
