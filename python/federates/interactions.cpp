// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The part of a session that handles every PDU type.
#include <stdexcept>

#include "reckon/pdu/pdu_types.hpp"
#include "reckon/python/federates/session.hpp"
#include "reckon/python/records/codec_calls.hpp"

namespace reckon::python {
namespace py = pybind11;
namespace {

using Hear = std::function<void(std::span<const std::byte>, bool owns)>;

/// False if the type is not in the list.
template <typename... T>
bool subscribe(peer::Federate& federate, unsigned type, const Hear& deliver, pdu::TypeList<T...>) {
  const auto attempt = [&]<typename Pdu>(std::type_identity<Pdu>) {
    if (static_cast<unsigned>(Pdu::kPduType) != type) return false;
    federate.subscribe<Pdu>([deliver](const Pdu& pdu, const peer::InteractionSender& sender) {
      std::vector<std::byte> octets(pdu::wire_size(pdu));
      octets.resize(pdu::encode(pdu, octets));
      deliver(octets, sender.owns);
    });
    return true;
  };
  return (attempt(std::type_identity<T>{}) || ...);
}

}  // namespace

void Session::on_interaction(unsigned pdu_type, py::function callback) {
  callbacks_.push_back(callback);
  const Hear deliver = [this, of = callback.ptr()](std::span<const std::byte> octets, bool owns) {
    const py::gil_scoped_acquire python;
    try {
      pdu::DecodeError error = pdu::DecodeError::none;
      const py::object pdu = decode_pdu(octets, error);
      if (error == pdu::DecodeError::none) py::reinterpret_borrow<py::function>(of)(pdu, owns);
    } catch (...) {
      if (!first_fault_) first_fault_ = std::current_exception();
    }
  };
  if (!subscribe(federate(), pdu_type, deliver, pdu::PduTypes{}))
    throw std::invalid_argument("no PDU type " + std::to_string(pdu_type) + " is known");
}

void Session::send(std::span<const std::byte> octets) {
  peer::Federate& out = federate();
  pdu::PduHeader header;
  pdu::DecodeError error = pdu::decode_header(octets, header);
  if (error == pdu::DecodeError::none)
    error = pdu::visit(
        octets, header,
        [&]<typename Pdu>(const Pdu& message) {
          out.publish<Pdu>();
          out.send(message);
        },
        pdu::PduTypes{});
  if (error != pdu::DecodeError::none)
    throw std::invalid_argument("a federate can send only PDUs with known fields: " +
                                std::string(pdu::sentence(error)));
}

}  // namespace reckon::python
