// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Makes the Python classes of all PDUs and records.
#pragma once

#include <pybind11/pybind11.h>

namespace reckon::python {

/// Called once, when the module is imported. Adds the classes to `module`. @param base their base
/// class, with slots `_form` and `_padding`. @param pdu_base the same for PDUs
void make_classes(pybind11::module_& module, const pybind11::object& base,
                  const pybind11::object& pdu_base);

}  // namespace reckon::python
