// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// A Python module with an effect of its own, as a user writes it.
#include <pybind11/pybind11.h>

#include "honey.hpp"

PYBIND11_MODULE(honey, module) {
  using Effects = reckon::haptics::CustomEffects;
  module.def("effects", [] {
    return pybind11::capsule(new Effects(reckon::haptics::custom_effects<Honey>()),
                             "reckon.CustomEffects", [](PyObject* capsule) {
                               delete static_cast<Effects*>(
                                   PyCapsule_GetPointer(capsule, "reckon.CustomEffects"));
                             });
  });
}
