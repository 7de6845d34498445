// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/pdu/bundle.hpp"
#include "reckon/pdu/pdu_types.hpp"
#include "reckon/pdu/type_names.hpp"
#include "reckon/python/records/classes.hpp"
#include "reckon/python/records/codec_calls.hpp"
#include "reckon/python/records/octets_of.hpp"
#include "reckon/python/records/shape.hpp"

namespace reckon::python {
namespace py = pybind11;
namespace {

py::object decode_one(const py::object& given) {
  const OctetBuffer buffer(given);
  pdu::PduHeader header;
  static_cast<void>(pdu::decode_header(buffer.octets(), header));
  pdu::DecodeError error = pdu::DecodeError::none;
  py::object made = decode_pdu(buffer.octets(), error);
  if (error == pdu::DecodeError::none && header.length == buffer.octets().size()) return made;
  const bool is_more = error == pdu::DecodeError::none;
  raise_decode_error(is_more ? pdu::DecodeError::stray : error, "", is_more ? header.length : 0,
                     header, buffer.octets().size());
}

py::bytes encode_one(const py::object& pdu) {
  const std::vector<std::byte> octets = encode_pdu(pdu);
  return {reinterpret_cast<const char*>(octets.data()), octets.size()};
}

py::bytes trailing_of(const py::object& given) {
  const OctetBuffer buffer(given);
  pdu::PduHeader header;
  std::span<const std::byte> trailing;
  if (pdu::decode_header(buffer.octets(), header) == pdu::DecodeError::none)
    static_cast<void>(pdu::visit(buffer.octets(), header, [&](const auto& pdu) {
      trailing = pdu::trailing_octets(buffer.octets(), pdu);
    }));
  return {reinterpret_cast<const char*>(trailing.data()), trailing.size()};
}

py::object initial(const py::type& kind) {
  const Shape* const shape = shape_of_class(reinterpret_cast<PyTypeObject*>(kind.ptr()));
  if (shape == nullptr || shape->make_initial == nullptr)
    raise(PyExc_TypeError,
          py::repr(kind).cast<std::string>() + " is not a class of PDUs or records");
  return py::reinterpret_steal<py::object>(shape->make_initial());
}

py::dict fields_of_classes() {
  py::dict all;
  for (const auto& shape : all_shapes()) {
    py::dict fields;
    for (const Shape::Field& field : shape->fields()) fields[field.name.c_str()] = field.type;
    all[shape->name().c_str()] = fields;
  }
  return all;
}

}  // namespace

OctetBuffer::OctetBuffer(const py::object& object) {
  if (PyObject_GetBuffer(object.ptr(), &view_, PyBUF_SIMPLE) == 0) return;
  PyErr_Clear();
  raise(PyExc_TypeError, "octets must be bytes or a contiguous buffer, not " +
                             py::repr(py::type::of(object)).cast<std::string>());
}

void bind_records(py::module_& module) {
  module.def("make_classes", [module](const py::object& base, const py::object& pdu_base) mutable {
    make_classes(module, base, pdu_base);
  });
  module.def("initial", initial);
  module.def("fields_of_classes", fields_of_classes);
  module.def("decode", decode_one, py::arg("octets"));
  module.def(
      "decode_datagram",
      [](const py::object& octets) { return decode_datagram(OctetBuffer(octets).octets(), ""); },
      py::arg("octets"));
  module.def("encode", encode_one, py::arg("pdu"));
  module.def("trailing", trailing_of, py::arg("octets"));
  module.def("pdu_name",
             [](unsigned type) { return std::string(pdu::name(static_cast<pdu::PduType>(type))); });
}

}  // namespace reckon::python
