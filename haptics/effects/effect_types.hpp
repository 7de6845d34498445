// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// THE list of effects. A new effect is one header in effects/, named as its kName, and one row here
// (and the header's line in CMakeLists.txt). Scene files, their check and hash, `scene explain` and
// the servo all use this list.
#pragma once

#include <tuple>
#include <type_traits>

#include "reckon/haptics/effects/effect_hooks.hpp"
#include "reckon/haptics/effects/place_friction.hpp"
#include "reckon/haptics/effects/relief.hpp"
#include "reckon/haptics/effects/skin.hpp"
#include "reckon/haptics/effects/snags.hpp"
#include "reckon/haptics/effects/spring_damper.hpp"
#include "reckon/haptics/effects/stick_slip_friction.hpp"
#include "reckon/haptics/effects/stribeck_friction.hpp"
#include "reckon/haptics/effects/surface_drag.hpp"
#include "reckon/haptics/effects/tap_vibration.hpp"
#include "reckon/haptics/effects/texture.hpp"

namespace reckon::haptics {

using EffectTypes = std::tuple<SpringDamper, StickSlipFriction, PlaceFriction, StribeckFriction,
                               Snags, Skin, Texture, Relief, SurfaceDrag, TapVibration>;

/// Calls f(std::type_identity<Effect>{}) once per effect, in the order of the list.
template <class Types = EffectTypes, class F>
constexpr void for_each_effect(F&& f) {
  [&]<class... Effects>(std::type_identity<std::tuple<Effects...>>) {
    (f(std::type_identity<Effects>{}), ...);
  }(std::type_identity<Types>{});
}

/// Compile-time check that the effect can be declared and run.
template <class Effect>
struct CheckedEffect {
  static_assert(DescribedEffect<Effect>,
                "an effect is a CountedEffect of itself with Parameters, kName, kKey, kCost, "
                "kParameters, parameters() and a constructor from its Parameters, and owns no "
                "memory (std::vector, std::string) unless copies share it (kSharesMemory): see "
                "DescribedEffect in effect_hooks.hpp");
  static_assert(
      HookedEffect<Effect>,
      "an effect needs a hook: cone(), or spring_force() with stored_energy() and stiffness(), or "
      "force() with damping(); each noexcept. Is one misspelt? See effect_hooks.hpp");
  static_assert(WholeHooks<Effect>,
                "a hook of this effect is incomplete, or its types or noexcept differ from those "
                "in effect_hooks.hpp");
  static constexpr bool kSpring = StoresEnergy<Effect> && AlwaysThere<Effect>;
};

static_assert(
    []<class... Effects>(std::type_identity<std::tuple<Effects...>>) {
      return (CheckedEffect<Effects>::kSpring || ...);
    }(std::type_identity<EffectTypes>{}),
    "every touchable surface needs a spring: one effect that stores energy must be kAlways");

}  // namespace reckon::haptics
