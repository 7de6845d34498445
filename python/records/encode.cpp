// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include <unordered_map>

#include "reckon/pdu/codec/codec.hpp"
#include "reckon/pdu/pdu_types.hpp"
#include "reckon/python/records/codec_calls.hpp"
#include "reckon/python/records/octets_of.hpp"
#include "reckon/python/records/pdu_filler.hpp"
#include "reckon/python/records/unknown_pdu.hpp"

namespace reckon::python {
namespace py = pybind11;
namespace {

using Encode = void (*)(PyObject*, std::vector<std::byte>&);

/// Octets at the end that belong to no field.
void put_padding(PyObject* object, const Shape& shape, bool fills_words,
                 std::vector<std::byte>& out) {
  std::vector<std::byte> padding;
  PyObject* const kept = value_at(object, shape.padding_offset());
  if (kept != nullptr) put_octets(kept, shape.name() + "._padding", padding);
  // Pads bits to whole words, unless the decoded PDU had no padding or other octets there.
  constexpr std::size_t kWord = 4;
  const bool is_filling = kept == nullptr || (!padding.empty() && padding.size() < kWord);
  if (fills_words && is_filling && (out.size() + padding.size()) % kWord != 0)
    padding.assign((kWord - out.size() % kWord) % kWord, std::byte{0});
  out.insert(out.end(), padding.begin(), padding.end());
}

void set_length(std::vector<std::byte>& out, const Shape& shape) {
  if (out.size() > pdu::kMaxPduSize)
    raise(PyExc_ValueError, shape.name() + " has " + std::to_string(out.size()) +
                                " octets: a PDU has at most 65535; shorten its lists");
  pdu::store_big_endian(out.data() + 8, static_cast<std::uint16_t>(out.size()));
}

template <typename Pdu>
void encode_as(PyObject* object, std::vector<std::byte>& out) {
  const Shape& shape = shape_of<Pdu>();
  OctetArena arena;
  Pdu pdu;
  PduFiller filler(object, shape, arena);
  fields(filler, pdu);
  out.resize(pdu::wire_size(pdu));
  if (out.size() > pdu::kMaxPduSize) set_length(out, shape);
  if (pdu::encode(pdu, out) != out.size())
    raise(PyExc_ValueError,
          shape.name() + " has a list that is too long for its count field; shorten it");
  put_padding(object, shape,
              std::is_same_v<Pdu, pdu::Signal> || std::is_same_v<Pdu, pdu::IntercomSignal>, out);
  set_length(out, shape);
  // Numbers within records of varying size are as the object has them.
  Pdu again;
  const pdu::DecodeError error = pdu::decode(out, again);
  if (error != pdu::DecodeError::none)
    raise(PyExc_ValueError,
          shape.name() + " would be refused by receivers: " + std::string(pdu::sentence(error)) +
              " Set the counts and lengths in its records to their contents");
}

void encode_unknown(PyObject* object, std::vector<std::byte>& out) {
  put_record(object, 0, out);
  set_length(out, shape_of<UnknownPdu>());
}

template <typename... T>
std::unordered_map<const Shape*, Encode> encoders(pdu::TypeList<T...>) {
  std::unordered_map<const Shape*, Encode> all;
  (all.emplace(&shape_of<T>(), encode_as<T>), ...);
  all.emplace(&shape_of<UnknownPdu>(), encode_unknown);
  return all;
}

}  // namespace

std::vector<std::byte> encode_pdu(const py::object& pdu) {
  static const auto kEncoders = encoders(pdu::PduTypes{});
  const auto found = kEncoders.find(shape_of_class(Py_TYPE(pdu.ptr())));
  if (found == kEncoders.end())
    raise(PyExc_TypeError, "encode() takes a PDU, such as reckon.EntityState(), not " +
                               py::repr(pdu).cast<std::string>());
  std::vector<std::byte> octets;
  found->second(pdu.ptr(), octets);
  return octets;
}

}  // namespace reckon::python
