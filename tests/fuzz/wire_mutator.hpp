// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Most of the engine's changes break a header, so that nothing behind it is reached. These repairs,
// made to most but not all inputs, let it reach the bodies.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "reckon/pdu/codec/pdu_header.hpp"
#include "reckon/pdu/pdu_types.hpp"

namespace reckon::fuzz {

/// PDU type number `i` of the list, modulo its length.
template <typename... T>
[[nodiscard]] pdu::PduType listed_type(std::size_t i, pdu::TypeList<T...>) noexcept {
  constexpr std::array kTypes{T::kPduType...};
  return kTypes[i % kTypes.size()];
}
[[nodiscard]] inline pdu::PduType listed_type(std::size_t i) noexcept {
  return listed_type(i, pdu::PduTypes{});
}

/// Gives the PDU at `octets` a supported version and the correct length field; does nothing without
/// room for a header.
void repair_header(std::span<std::byte> octets) noexcept;

/// Makes the last PDU of a datagram end at the end of the datagram.
void repair_last_length(std::span<std::byte> datagram) noexcept;

}  // namespace reckon::fuzz

/// Function of the engine: changes `data` at random, returns the new size.
extern "C" std::size_t LLVMFuzzerMutate(std::uint8_t* data, std::size_t size, std::size_t max_size);
