// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Handler of a walk through the fields of a PDU (pdu/field_walk.hpp) that makes Python objects of
// them.
#pragma once

#include <pybind11/pybind11.h>

#include <array>
#include <cstddef>
#include <span>
#include <string_view>
#include <type_traits>

#include "reckon/pdu/field_walk.hpp"
#include "reckon/python/records/shape.hpp"

namespace reckon::python {

/// A number or an array as a Python object; new reference. Text keeps its characters up to the last
/// one other than NUL, each an octet.
template <typename T>
[[nodiscard]] PyObject* to_python(const T& value) {
  if constexpr (pdu::kIsStdArray<T>) {
    const auto* const octets = reinterpret_cast<const char*>(value.data());
    auto size = static_cast<Py_ssize_t>(value.size());
    if constexpr (kWireKind<T> == WireKind::text) {
      while (size > 0 && octets[size - 1] == '\0') --size;
      return PyUnicode_DecodeLatin1(octets, size, nullptr);
    } else {
      return PyBytes_FromStringAndSize(octets, size);
    }
  } else if constexpr (std::is_floating_point_v<T>) {
    return PyFloat_FromDouble(static_cast<double>(value));
  } else if constexpr (kWireKind<T> == WireKind::signed_number) {
    return PyLong_FromLongLong(static_cast<long long>(value));
  } else {
    return PyLong_FromUnsignedLongLong(static_cast<unsigned long long>(value));
  }
}

/// Makes one object with all its contents. Requires the interpreter's lock; throws
/// error_already_set if Python has no memory.
class ObjectMaker {
 public:
  static constexpr bool kExamples = false;

  ObjectMaker() = default;
  ~ObjectMaker() {
    while (depth_ > 0) Py_DECREF(frames_[--depth_].object);
    Py_XDECREF(made_);
  }
  ObjectMaker(const ObjectMaker&) = delete;
  ObjectMaker& operator=(const ObjectMaker&) = delete;

  template <typename Record>
  bool enter(std::string_view name, std::size_t index, const Record&) {
    enter_shape(name, index, shape_of<Record>());
    return true;
  }
  void leave();
  template <typename T>
  void leaf(std::string_view name, const T& value, const pdu::FieldMeanings&) {
    set(name, kWireKind<T>, sizeof(T), checked(to_python(value)));
    frames_[depth_ - 1].octets += sizeof(T);
  }
  void octets(std::string_view name, std::span<const std::byte> octets);
  void list(std::string_view name);
  /// Keeps octets at the end of the record that belong to no field.
  void extent(std::span<const std::byte> whole);

  /// The object; new reference.
  [[nodiscard]] PyObject* take() noexcept;

 private:
  struct Frame {
    PyObject* object = nullptr;
    const Shape* shape = nullptr;
    Form* form = nullptr;
    PyObject* list = nullptr;  // of the newest list in it, borrowed
    std::size_t octets = 0;    // visited
  };
  static constexpr std::size_t kDeepest = 16;

  static PyObject* checked(PyObject* made) {
    if (made == nullptr) throw pybind11::error_already_set();
    return made;
  }
  void enter_shape(std::string_view name, std::size_t index, Shape& shape);
  void set(std::string_view name, WireKind kind, std::size_t size, PyObject* value);

  std::array<Frame, kDeepest> frames_{};
  std::size_t depth_ = 0;
  PyObject* made_ = nullptr;
};

/// Makes an object of one PDU from its octets, or of a PDU made in code (then without octets); new
/// reference.
[[nodiscard]] PyObject* make_object(const auto& pdu, std::span<const std::byte> octets = {}) {
  ObjectMaker maker;
  maker.enter({}, pdu::kNoIndex, pdu);
  pdu::FieldWalk walk(maker, pdu);
  fields(walk, pdu);
  if (!octets.empty()) maker.extent(octets);
  maker.leave();
  return maker.take();
}

}  // namespace reckon::python
