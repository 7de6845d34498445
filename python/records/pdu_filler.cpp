// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/python/records/pdu_filler.hpp"

namespace reckon::python {

PyObject* PduFiller::find(std::string_view name) {
  const Py_ssize_t offset = shape_.offset(name);
  if (offset < 0) return nullptr;
  const std::vector<FormStep>& steps = form_of(object_, shape_).steps();
  for (std::size_t i = found_; i < steps.size(); ++i) {
    if (steps[i].offset != offset) continue;
    found_ = i + 1;
    break;
  }
  return value_at(object_, offset);
}

PyObject* PduFiller::need(std::string_view name, PyObject* given) const {
  if (given == nullptr) raise(PyExc_ValueError, where(name) + " is missing: set it");
  return given;
}

std::string PduFiller::where(std::string_view name) const {
  return shape_.name() + "." + std::string(name);
}

void PduFiller::refuse_size(std::string_view name, std::size_t is, std::size_t wanted) const {
  raise(PyExc_ValueError, where(name) + " has a size of " + std::to_string(is) + ": it must be " +
                              std::to_string(wanted) + ", or of records of that size");
}

std::span<const std::byte> PduFiller::octets_of(std::string_view name, PyObject* given) {
  std::vector<std::byte>& octets = arena_.emplace_back();
  put_octets(need(name, given), where(name), octets);
  return octets;
}

std::span<const std::byte> PduFiller::rest() {
  std::vector<std::byte>& octets = arena_.emplace_back();
  put_record(object_, found_, octets);
  return octets;
}

}  // namespace reckon::python
