// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Visitor of field tables that fills a C++ PDU from a Python object, to be encoded.
#pragma once

#include <pybind11/pybind11.h>

#include <cstddef>
#include <deque>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include "reckon/pdu/codec/codec.hpp"
#include "reckon/pdu/codec/octet_block.hpp"
#include "reckon/python/records/octets_of.hpp"
#include "reckon/python/records/shape.hpp"

namespace reckon::python {

/// Octets that the views of a PDU point into.
using OctetArena = std::deque<std::vector<std::byte>>;

/// Counts of lists and of octets are computed from the object's content; its own count fields are
/// ignored. A field with a record of another kind, which the wire format allows at some places, is
/// taken as octets. Throws error_already_set with the field and the reason.
class PduFiller {
 public:
  PduFiller(PyObject* object, const Shape& shape, OctetArena& arena)
      : object_(object), shape_(shape), arena_(arena) {}

  template <typename T>
  void operator()(std::string_view name, T& value) {
    PyObject* const given = find(name);
    if constexpr (pdu::Scalar<T> || pdu::kIsStdArray<T>) {
      load(name, given, value);
    } else if (Py_TYPE(need(name, given)) == shape_of<T>().type()) {
      PduFiller inner(given, shape_of<T>(), arena_);
      fields(inner, value);
    } else {
      std::vector<std::byte> octets;
      put_octets(given, where(name), octets);
      if (octets.size() != pdu::kFixedSize<T> || !pdu::load_record(octets, value))
        refuse_size(name, octets.size(), pdu::kFixedSize<T>);
    }
  }
  void when(bool present, std::string_view name, auto& value) {
    if (present) (*this)(name, value);
  }
  template <typename Record, typename Count>
  void count(std::string_view name, std::span<const std::byte>&, pdu::Records<Record, Count>) {
    static_cast<void>(find(name));
  }
  template <typename Record, typename Count>
  void records(std::string_view name, std::span<const std::byte>& view,
               pdu::Records<Record, Count>) {
    view = octets_of(name, find(name));
    if (view.size() % pdu::kFixedSize<Record> != 0)
      refuse_size(name, view.size(), pdu::kFixedSize<Record>);
  }
  template <typename View>
  void walked(std::string_view name, View& view) {
    PyObject* const given = find(name);
    view.bytes = given == nullptr ? rest() : octets_of(name, given);
    if constexpr (std::is_same_v<View, pdu::BitBlock>) {
      // The bits of the last octet may be fewer.
      if ((view.count + 7U) / 8 != view.bytes.size()) {
        if (view.bytes.size() > 0xFFFF / 8) refuse_size(name, view.bytes.size(), 0xFFFF / 8);
        view.count = static_cast<std::uint16_t>(8 * view.bytes.size());
      }
    } else if constexpr (pdu::OctetView<View>) {
      if constexpr (!std::is_same_v<View, pdu::RestOfPdu>)
        set_count(name, view.count, view.bytes.size());
    } else if constexpr (std::is_assignable_v<decltype((view.count)), std::uint8_t>) {
      if (given != nullptr && PyList_Check(given))
        set_count(name, view.count, static_cast<std::size_t>(PyList_GET_SIZE(given)));
    }
  }

 private:
  /// The value of a field, or nullptr. Borrowed.
  PyObject* find(std::string_view name);
  PyObject* need(std::string_view name, PyObject* given) const;
  [[nodiscard]] std::string where(std::string_view name) const;
  [[noreturn]] void refuse_size(std::string_view name, std::size_t is, std::size_t wanted) const;
  std::span<const std::byte> octets_of(std::string_view name, PyObject* given);
  /// All fields behind the last one found: an object shows fields that the codec takes as octets.
  std::span<const std::byte> rest();

  template <typename Count>
  void set_count(std::string_view name, Count& count, std::size_t size) const {
    count = static_cast<Count>(size);
    if (count != size) refuse_size(name, size, static_cast<Count>(-1));
  }
  template <typename T>
  void load(std::string_view name, PyObject* given, T& value) const {
    std::vector<std::byte> octets;
    put_value(need(name, given), kWireKind<T>, sizeof(T), where(name), octets);
    if constexpr (pdu::Scalar<T>) {
      value = pdu::load_big_endian<T>(octets.data());
    } else {
      std::memcpy(value.data(), octets.data(), value.size());
    }
  }

  PyObject* object_;
  const Shape& shape_;
  OctetArena& arena_;
  std::size_t found_ = 0;  // steps of the form up to the last field that was found
};

}  // namespace reckon::python
