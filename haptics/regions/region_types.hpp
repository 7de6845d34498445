// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// THE list of effects of regions. A new one is one header in regions/, named as its kName, and one
// row here (and the header's line in CMakeLists.txt).
#pragma once

#include <tuple>
#include <type_traits>

#include "reckon/haptics/effects/effect_declarations.hpp"
#include "reckon/haptics/effects/effect_set.hpp"
#include "reckon/haptics/regions/attraction.hpp"
#include "reckon/haptics/regions/border_spring.hpp"
#include "reckon/haptics/regions/constant_force.hpp"
#include "reckon/haptics/regions/dry_friction.hpp"
#include "reckon/haptics/regions/oscillation.hpp"
#include "reckon/haptics/regions/point_spring.hpp"
#include "reckon/haptics/regions/region_guard.hpp"
#include "reckon/haptics/regions/region_hooks.hpp"
#include "reckon/haptics/regions/viscosity.hpp"

namespace reckon::haptics {

using RegionTypes = std::tuple<Viscosity, DryFriction, ConstantForce, PointSpring, Attraction,
                               Oscillation, BorderSpring>;

/// Calls f(std::type_identity<Effect>{}) once per effect, in the order of the list.
constexpr void for_each_region_effect(auto&& f) { for_each_effect<RegionTypes>(f); }

static_assert(
    []<class... Effects>(std::type_identity<std::tuple<Effects...>>) {
      return ((DescribedEffect<Effects> && HookedRegionEffect<Effects> &&
               WholeRegionHooks<Effects>)&&...);
    }(std::type_identity<RegionTypes>{}),
    "an effect of a region has Parameters, kName, kKey, kCost, kParameters, parameters(), a "
    "constructor from its Parameters, no memory of its own, and a hook; each hook is complete and "
    "has the types of region_hooks.hpp");

/// The effects that a scene declares for a region.
using DeclaredRegionEffects = EffectDeclarations<RegionTypes>;
/// The effects of a region, ready to run; a copy has its own state.
using PlannedRegionEffects = EffectSet<RegionTypes, GuardedRegionEffect>;

}  // namespace reckon::haptics
