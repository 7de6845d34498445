// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/python/records/octets_of.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

#include "reckon/pdu/management/datum.hpp"

namespace reckon::python {
namespace py = pybind11;
namespace {

std::string text_of(PyObject* value) { return py::repr(py::handle(value)).cast<std::string>(); }

void put_big_endian(std::uint64_t value, std::size_t size, std::vector<std::byte>& out) {
  for (std::size_t i = size; i-- > 0;) out.push_back(static_cast<std::byte>(value >> (8 * i)));
}

void put_number(PyObject* value, bool is_signed, std::size_t size, const std::string& where,
                std::vector<std::byte>& out) {
  const py::object index = py::reinterpret_steal<py::object>(PyNumber_Index(value));
  if (!index) {
    PyErr_Clear();
    raise(PyExc_TypeError, where + " must be a whole number, not " + text_of(value));
  }
  const unsigned bits = static_cast<unsigned>(8 * size);
  std::uint64_t number = 0;
  bool fits = false;
  if (is_signed) {
    const long long given = PyLong_AsLongLong(index.ptr());
    const long long most = std::numeric_limits<std::int64_t>::max() >> (64 - bits);
    fits = PyErr_Occurred() == nullptr && given <= most && given >= -most - 1;
    number = static_cast<std::uint64_t>(given);
  } else {
    number = PyLong_AsUnsignedLongLong(index.ptr());
    fits = PyErr_Occurred() == nullptr &&
           number <= std::numeric_limits<std::uint64_t>::max() >> (64 - bits);
  }
  if (!fits) {
    PyErr_Clear();
    raise(PyExc_ValueError, where + " is " + text_of(value) + ": it must fit " +
                                std::to_string(bits) + " bits" +
                                (is_signed ? " with a sign" : ", 0 or more"));
  }
  put_big_endian(number, size, out);
}

void put_real(PyObject* value, std::size_t size, const std::string& where,
              std::vector<std::byte>& out) {
  const double number = PyFloat_AsDouble(value);
  if (PyErr_Occurred() != nullptr) {
    PyErr_Clear();
    raise(PyExc_TypeError, where + " must be a number, not " + text_of(value));
  }
  if (size == sizeof(double)) return put_big_endian(std::bit_cast<std::uint64_t>(number), 8, out);
  if (std::isfinite(number) && std::abs(number) > std::numeric_limits<float>::max())
    raise(PyExc_ValueError, where + " is " + text_of(value) + ": it must fit 32 bits");
  put_big_endian(std::bit_cast<std::uint32_t>(static_cast<float>(number)), 4, out);
}

void put_array(PyObject* value, WireKind kind, std::size_t size, const std::string& where,
               std::vector<std::byte>& out) {
  const bool is_text = kind == WireKind::text;
  if (is_text ? !PyUnicode_Check(value) : !PyBytes_Check(value))
    raise(PyExc_TypeError,
          where + " must be " + (is_text ? "str" : "bytes") + ", not " + text_of(value));
  py::object octets = py::reinterpret_borrow<py::object>(value);
  if (is_text) octets = py::reinterpret_steal<py::object>(PyUnicode_AsLatin1String(value));
  if (!octets) {
    PyErr_Clear();
    raise(PyExc_ValueError, where + " is " + text_of(value) + ": a character must fit one octet");
  }
  const auto given = static_cast<std::size_t>(PyBytes_GET_SIZE(octets.ptr()));
  if (given > size || (!is_text && given != size))
    raise(PyExc_ValueError, where + " has " + std::to_string(given) + " octets: it must have " +
                                (is_text ? "at most " : "") + std::to_string(size));
  const auto* const at = reinterpret_cast<const std::byte*>(PyBytes_AS_STRING(octets.ptr()));
  out.insert(out.end(), at, at + given);
  out.resize(out.size() + size - given);
}

// A variable datum states the bits of its value, and fills up to 8 octets: both follow the value.
void put_variable_datum(PyObject* object, const Shape& shape, std::vector<std::byte>& out) {
  const auto field = [&](std::string_view name) {
    PyObject* const value = value_at(object, shape.offset(name));
    return value == nullptr ? Py_None : value;
  };
  std::vector<std::byte> value;
  put_octets(field("variable_datum_value"), "VariableDatum.variable_datum_value", value);
  std::vector<std::byte> head;
  put_value(field("variable_datum_id"), WireKind::unsigned_number, 4,
            "VariableDatum.variable_datum_id", head);
  const py::int_ bits(8 * value.size());
  PyObject* const stated = field("variable_datum_length");
  const unsigned long long length = PyLong_Check(stated) ? PyLong_AsUnsignedLongLong(stated) : 0;
  PyErr_Clear();
  const bool is_true = (length + 7) / 8 == value.size();
  put_value(is_true ? stated : bits.ptr(), WireKind::unsigned_number, 4,
            "VariableDatum.variable_datum_length", head);
  out.insert(out.end(), head.begin(), head.end());
  out.insert(out.end(), value.begin(), value.end());
  PyObject* const padding = value_at(object, shape.padding_offset());
  if (is_true && padding != nullptr) return put_octets(padding, "padding", out);
  out.resize(out.size() + (8 - value.size() % 8) % 8);
}

}  // namespace

void raise(PyObject* kind, const std::string& sentence) {
  PyErr_SetString(kind, sentence.c_str());
  throw py::error_already_set();
}

void put_value(PyObject* value, WireKind kind, std::size_t size, const std::string& where,
               std::vector<std::byte>& out) {
  switch (kind) {
    case WireKind::unsigned_number:
      return put_number(value, false, size, where, out);
    case WireKind::signed_number:
      return put_number(value, true, size, where, out);
    case WireKind::real:
      return put_real(value, size, where, out);
    default:
      return size == 0 ? put_octets(value, where, out) : put_array(value, kind, size, where, out);
  }
}

void put_octets(PyObject* value, const std::string& where, std::vector<std::byte>& out) {
  if (PyBytes_Check(value)) {
    const auto* const at = reinterpret_cast<const std::byte*>(PyBytes_AS_STRING(value));
    out.insert(out.end(), at, at + PyBytes_GET_SIZE(value));
  } else if (PyList_Check(value) || PyTuple_Check(value)) {
    for (const py::handle item : py::reinterpret_borrow<py::sequence>(value))
      put_octets(item.ptr(), where, out);
  } else if (shape_of_class(Py_TYPE(value)) != nullptr) {
    put_record(value, 0, out);
  } else {
    raise(PyExc_TypeError,
          where + " must be a record, a list of records or bytes, not " + text_of(value));
  }
}

const Form& form_of(PyObject* object, const Shape& shape) {
  PyObject* const token = value_at(object, shape.form_offset());
  const Form* const form = token == nullptr ? nullptr : Form::of_token(token);
  if (form == nullptr) {
    PyErr_Clear();
    raise(PyExc_ValueError, shape.name() + " has no fields: create it with " + shape.name() + "()");
  }
  return *form;
}

void put_record(PyObject* object, std::size_t from, std::vector<std::byte>& out) {
  const Shape& shape = *shape_of_class(Py_TYPE(object));
  if (&shape == &shape_of<pdu::VariableDatum>()) return put_variable_datum(object, shape, out);
  const std::vector<FormStep>& steps = form_of(object, shape).steps();
  for (std::size_t i = from; i < steps.size(); ++i) {
    const FormStep& step = steps[i];
    const std::string where = shape.name() + "." + std::string(step.name);
    PyObject* const value = value_at(object, step.offset);
    if (value == nullptr) raise(PyExc_ValueError, where + " is missing: set it");
    put_value(value, step.kind, step.size, where, out);
  }
  PyObject* const padding = value_at(object, shape.padding_offset());
  if (padding != nullptr) put_octets(padding, shape.name() + "._padding", out);
}

}  // namespace reckon::python
