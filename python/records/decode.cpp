// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include <array>

#include "reckon/pdu/bundle.hpp"
#include "reckon/pdu/pdu_types.hpp"
#include "reckon/pdu/type_names.hpp"
#include "reckon/python/records/codec_calls.hpp"
#include "reckon/python/records/object_maker.hpp"
#include "reckon/python/records/octets_of.hpp"
#include "reckon/python/records/unknown_pdu.hpp"

namespace reckon::python {
namespace py = pybind11;
namespace {

using Decode = pdu::DecodeError (*)(std::span<const std::byte>, PyObject*&);

template <typename Pdu>
pdu::DecodeError decode_as(std::span<const std::byte> octets, PyObject*& made) {
  Pdu pdu;
  const pdu::DecodeError error = pdu::decode(octets, pdu);
  if (error == pdu::DecodeError::none) made = make_object(pdu, octets.first(pdu.header.length));
  return error;
}

pdu::DecodeError decode_unknown(std::span<const std::byte> octets, PyObject*& made) {
  UnknownPdu pdu;
  const pdu::DecodeError error = pdu::decode_header(octets, pdu.header);
  if (error != pdu::DecodeError::none) return error;
  pdu.body.bytes = octets.first(pdu.header.length).subspan(pdu::kHeaderSize);
  made = make_object(pdu);
  return error;
}

template <typename... T>
constexpr std::array<Decode, 256> decoders(pdu::TypeList<T...>) {
  std::array<Decode, 256> all{};
  all.fill(decode_unknown);
  ((all[static_cast<std::size_t>(T::kPduType)] = decode_as<T>), ...);
  return all;
}

const char* remedy(pdu::DecodeError error) {
  switch (error) {
    case pdu::DecodeError::truncated:
      return "pass all octets of its length field";
    case pdu::DecodeError::version:
      return "versions 5, 6 and 7 are supported";
    case pdu::DecodeError::stray:
      return "pass one PDU to decode(), several to decode_datagram()";
    default:
      return "correct the sender; `reckon inspect FILE check` lists its faults";
  }
}

}  // namespace

py::object decode_pdu(std::span<const std::byte> octets, pdu::DecodeError& error) {
  static constexpr std::array<Decode, 256> kDecoders = decoders(pdu::PduTypes{});
  PyObject* made = nullptr;
  error = octets.size() < pdu::kHeaderSize
              ? pdu::DecodeError::truncated
              : kDecoders[static_cast<std::size_t>(octets[2])](octets, made);
  return py::reinterpret_steal<py::object>(made);
}

py::list decode_datagram(std::span<const std::byte> octets, const std::string& where) {
  py::list all;
  for (const pdu::BundledPdu& pdu : pdu::BundleReader(octets)) {
    pdu::DecodeError error = pdu.error;
    py::object made;
    if (error == pdu::DecodeError::none) made = decode_pdu(pdu.bytes, error);
    if (error != pdu::DecodeError::none)
      raise_decode_error(error, where, pdu.offset, pdu.header, pdu.bytes.size());
    all.append(std::move(made));
  }
  return all;
}

void raise_decode_error(pdu::DecodeError error, const std::string& place, std::size_t octet,
                        const pdu::PduHeader& header, std::size_t given) {
  std::string what = place + "octet " + std::to_string(octet) + ": ";
  if (header.length != 0) what += std::string(pdu::name(header.pdu_type)) + " ";
  what += "PDU of " + std::to_string(given) + " octets";
  if (header.length != 0 && header.length != given)
    what += ", " + std::to_string(header.length) + " by its length field";
  what.append(": ").append(pdu::rule(error)).append(": ").append(pdu::sentence(error));
  what.pop_back();  // the full stop
  what.append("; ").append(remedy(error));
  const py::object kind = py::module_::import("reckon").attr("DecodeError");
  const py::object raised = kind(what);
  raised.attr("rule") = std::string(pdu::rule(error));
  raised.attr("octet") = octet;
  PyErr_SetObject(kind.ptr(), raised.ptr());
  throw py::error_already_set();
}

}  // namespace reckon::python
