// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Where a scene object keeps the parameters of each effect. Private to the scene reader: one pair
// of functions per effect, all else follows from the effect's own parameter table.
#pragma once

#include <type_traits>

#include "reckon/haptics/effects/effect_types.hpp"
#include "reckon/haptics/scene/scene.hpp"

namespace reckon::peer {

/// The parameters as declared, null when the object does not declare the effect.
[[nodiscard]] inline const haptics::Surface* declared(const haptics::SceneObject& object,
                                                      std::type_identity<haptics::Surface>) {
  return &object.surface;  // whatever can be touched has a surface
}

[[nodiscard]] inline const haptics::Friction* declared(const haptics::SceneObject& object,
                                                       std::type_identity<haptics::Friction>) {
  return object.friction ? &*object.friction : nullptr;
}

/// Declares the effect with its defaults, to be filled in.
[[nodiscard]] inline haptics::Surface& declare(haptics::SceneObject& object,
                                               std::type_identity<haptics::Surface>) {
  return object.surface;
}

[[nodiscard]] inline haptics::Friction& declare(haptics::SceneObject& object,
                                                std::type_identity<haptics::Friction>) {
  return object.friction.emplace();
}

}  // namespace reckon::peer
