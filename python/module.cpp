// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The C++ part of the Python package: reckon._native. reckon/__init__.py lists the names for users.
#include <pybind11/pybind11.h>

#include "reckon/python/captures/bind_captures.hpp"
#include "reckon/python/federates/bind_federates.hpp"
#include "reckon/python/prediction/bind_prediction.hpp"
#include "reckon/python/records/codec_calls.hpp"
#include "reckon/python/scenes/bind_scenes.hpp"

PYBIND11_MODULE(_native, module) {
  module.doc() = "C++ part of the package reckon.";
  reckon::python::bind_records(module);
  reckon::python::bind_captures(module);
  reckon::python::bind_prediction(module);
  reckon::python::bind_scenes(module);
  reckon::python::bind_federates(module);
}
