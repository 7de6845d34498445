// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Octets to objects and back.
#pragma once

#include <pybind11/pybind11.h>

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "reckon/pdu/codec/decode_error.hpp"
#include "reckon/pdu/codec/pdu_header.hpp"

namespace reckon::python {

/// Decodes the PDU at the begin of `octets`; nothing with an error other than none. A type without
/// a field table becomes an UnknownPdu.
[[nodiscard]] pybind11::object decode_pdu(std::span<const std::byte> octets,
                                          pdu::DecodeError& error);

/// All PDUs of a datagram. @param where begins messages: "octet " or "frame 3 of x.pcap, octet ".
/// @throws error_already_set: DecodeError at the first that is damaged
[[nodiscard]] pybind11::list decode_datagram(std::span<const std::byte> octets,
                                             const std::string& where);

/// The octets of a PDU. @throws error_already_set with the field and the reason
[[nodiscard]] std::vector<std::byte> encode_pdu(const pybind11::object& pdu);

/// Raises DecodeError with the place, the reason and the remedy.
[[noreturn]] void raise_decode_error(pdu::DecodeError error, const std::string& place,
                                     std::size_t octet, const pdu::PduHeader& header,
                                     std::size_t given);

/// A view of a Python buffer: bytes, bytearray, memoryview, a numpy array.
class OctetBuffer {
 public:
  /// @throws error_already_set: TypeError
  explicit OctetBuffer(const pybind11::object& object);
  ~OctetBuffer() { PyBuffer_Release(&view_); }
  OctetBuffer(const OctetBuffer&) = delete;
  OctetBuffer& operator=(const OctetBuffer&) = delete;
  [[nodiscard]] std::span<const std::byte> octets() const noexcept {
    return {static_cast<const std::byte*>(view_.buf), static_cast<std::size_t>(view_.len)};
  }

 private:
  Py_buffer view_{};
};

/// decode, decode_datagram, encode, DecodeError and the classes of all PDUs and records.
void bind_records(pybind11::module_& module);

}  // namespace reckon::python
