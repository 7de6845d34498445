// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Makes the Python classes of all PDUs and records.
#pragma once

#include <pybind11/pybind11.h>

namespace reckon::python {

/// Once, when the module is imported. The classes stand in `module`. @param base what they derive
/// from, with slots `_form` and `_padding`. @param pdu_base the same for PDUs
void make_classes(pybind11::module_& module, const pybind11::object& base,
                  const pybind11::object& pdu_base);

}  // namespace reckon::python
