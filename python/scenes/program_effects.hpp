// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Effects written in C++ outside this project, passed through Python.
#pragma once

#include <pybind11/pybind11.h>

#include "reckon/haptics/effects/effect_custom.hpp"

namespace reckon::python {

/// Name of the capsule that holds a haptics::CustomEffects.
inline constexpr const char* kEffectsCapsule = "reckon.CustomEffects";

/// The effects of a capsule; no effects for None. @throws py::type_error for anything else
[[nodiscard]] inline haptics::CustomEffects effects_of(const pybind11::object& effects) {
  if (effects.is_none()) return {};
  if (PyCapsule_IsValid(effects.ptr(), kEffectsCapsule) == 0)
    throw pybind11::type_error(
        "effects must be the capsule reckon.CustomEffects that a module of effects returns");
  return *static_cast<const haptics::CustomEffects*>(
      PyCapsule_GetPointer(effects.ptr(), kEffectsCapsule));
}

}  // namespace reckon::python
