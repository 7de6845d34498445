// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Writes Python values as octets of the wire, by the form of an object, without its C++ record.
#pragma once

#include <pybind11/pybind11.h>

#include <cstddef>
#include <string>
#include <vector>

#include "reckon/python/records/shape.hpp"

namespace reckon::python {

/// Appends a number or a fixed array. @param where names the field in messages: "Fire.range"
/// @throws error_already_set: TypeError for another type, ValueError if it does not fit
void put_value(PyObject* value, WireKind kind, std::size_t size, const std::string& where,
               std::vector<std::byte>& out);

/// Appends octets, a record, or a list of octets and records. @throws error_already_set
void put_octets(PyObject* value, const std::string& where, std::vector<std::byte>& out);

/// Appends the fields of a record from the step `from` of its form on, and its padding.
/// @throws error_already_set
void put_record(PyObject* object, std::size_t from, std::vector<std::byte>& out);

/// The form of a record. @throws error_already_set if it was not made by its class
[[nodiscard]] const Form& form_of(PyObject* object, const Shape& shape);

/// Raises `kind` of Python with a sentence.
[[noreturn]] void raise(PyObject* kind, const std::string& sentence);

}  // namespace reckon::python
