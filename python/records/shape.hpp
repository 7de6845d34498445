// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The Python class of each record of the wire format, and the orders in which objects of it hold
// their fields. Field tables are walked once through examples to make the classes (classes.cpp);
// a decoded object then remembers its form, so that it can be written back octet for octet.
#pragma once

#include <pybind11/pybind11.h>

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <type_traits>
#include <typeinfo>
#include <unordered_map>
#include <vector>

#include "reckon/pdu/codec/field_table.hpp"

namespace reckon::python {

/// The type of a field on the wire, big-endian.
enum class WireKind : std::uint8_t {
  unsigned_number,
  signed_number,
  real,
  text,
  octets,
  record,
  list
};

/// One field in wire order.
struct FormStep {
  std::string_view name{};
  WireKind kind = WireKind::octets;
  std::size_t size = 0;   ///< of a number or a fixed array [octets]; 0: variable
  Py_ssize_t offset = 0;  ///< of its value in the object

  friend bool operator==(const FormStep&, const FormStep&) = default;
};

class Shape;

/// The fields of an object, in wire order: the fields of `before` and one more.
class Form {
 public:
  Form(const Shape& shape, const Form* before, const FormStep& last);
  /// The form with one more field.
  [[nodiscard]] Form& with(std::string_view name, WireKind kind, std::size_t size);
  /// All fields, in wire order.
  [[nodiscard]] const std::vector<FormStep>& steps() const noexcept { return steps_; }
  [[nodiscard]] Py_ssize_t last_offset() const noexcept { return steps_.back().offset; }
  /// The value that an object keeps to identify its form; borrowed.
  [[nodiscard]] PyObject* token() const noexcept { return token_; }
  /// The form of a token; nullptr with a Python error if it is none.
  [[nodiscard]] static const Form* of_token(PyObject* token);

 private:
  const Shape& shape_;
  std::vector<FormStep> steps_;
  std::vector<std::unique_ptr<Form>> next_;
  PyObject* token_;
};

/// One class. Lives as long as the interpreter.
class Shape {
 public:
  struct Field {
    std::string name;
    std::string type;  ///< for stubs, as Python writes it
  };

  explicit Shape(const char* type_name);

  /// Names the class by "entity_state", which replaces the C++ type.
  void rename(std::string_view snake_name);
  /// Declares a field. It may be declared again; a different type is added to the first.
  void declare(std::string_view name, std::string_view type);
  /// Makes the class, a subclass of `base` with a slot for each field.
  void make_class(const pybind11::object& base);

  [[nodiscard]] const std::string& name() const noexcept { return name_; }
  [[nodiscard]] const std::vector<Field>& fields() const noexcept { return fields_; }
  [[nodiscard]] PyTypeObject* type() const noexcept { return type_; }
  [[nodiscard]] Form& root() noexcept { return *root_; }
  /// Place of a field's value in an object; -1 if there is no such field.
  [[nodiscard]] Py_ssize_t offset(std::string_view name) const;
  [[nodiscard]] Py_ssize_t form_offset() const noexcept { return form_offset_; }
  [[nodiscard]] Py_ssize_t padding_offset() const noexcept { return padding_offset_; }

  /// Makes an object with every field at its initial value; new reference.
  using Maker = PyObject* (*)();
  Maker make_initial = nullptr;

 private:
  std::string name_;
  std::vector<Field> fields_;
  std::unordered_map<std::string_view, Py_ssize_t> offsets_;
  PyTypeObject* type_ = nullptr;
  Py_ssize_t form_offset_ = 0, padding_offset_ = 0;
  std::unique_ptr<Form> root_;
};

/// All shapes, in the order in which they were met.
[[nodiscard]] std::vector<std::unique_ptr<Shape>>& all_shapes();
/// The shape of a Python class; nullptr if it is no record.
[[nodiscard]] Shape* shape_of_class(PyTypeObject* type);

[[nodiscard]] Shape& new_shape(const char* type_name);

/// The shape of a C++ record.
template <typename Record>
[[nodiscard]] Shape& shape_of() {
  static Shape& shape = new_shape(typeid(Record).name());
  return shape;
}

/// The value of a field in an object of this shape.
[[nodiscard]] inline PyObject*& value_at(PyObject* object, Py_ssize_t offset) noexcept {
  return *reinterpret_cast<PyObject**>(reinterpret_cast<char*>(object) + offset);
}

template <typename T>
inline constexpr WireKind kWireKind = [] {
  if constexpr (pdu::kIsStdArray<T>) {
    return std::is_same_v<typename T::value_type, char> ? WireKind::text : WireKind::octets;
  } else if constexpr (std::is_floating_point_v<T>) {
    return WireKind::real;
  } else if constexpr (std::is_enum_v<T>) {
    return std::is_signed_v<std::underlying_type_t<T>> ? WireKind::signed_number
                                                       : WireKind::unsigned_number;
  } else {
    return std::is_signed_v<T> ? WireKind::signed_number : WireKind::unsigned_number;
  }
}();

}  // namespace reckon::python
