// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// run_scene for Python.
#pragma once

#include <pybind11/pybind11.h>

namespace reckon::python {

void bind_scenes(pybind11::module_& module);

}  // namespace reckon::python
