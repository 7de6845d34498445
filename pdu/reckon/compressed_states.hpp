// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Compressed States (experimental PDU 149): Entity States of one sender in fewer octets, many in
// one PDU. docs/compression.md describes the forms.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>

#include "reckon/pdu/codec/codec.hpp"
#include "reckon/pdu/codec/octet_block.hpp"
#include "reckon/pdu/codec/records.hpp"

namespace reckon::pdu {

struct CompressedStates {
  static constexpr PduType kPduType = PduType::compressed_states;
  static constexpr ProtocolFamily kProtocolFamily = ProtocolFamily::experimental;
  static constexpr std::string_view kName = "Compressed States";

  PduHeader header = header_of<CompressedStates>();
  SimulationAddress simulation;  ///< of all entities
  CompressedForm form = CompressedForm::compact;
  std::uint8_t layout = 1;  ///< of the bodies; other layouts are ignored
  std::uint16_t number_of_states = 0;
  RestOfPdu states;  ///< read with CompressedStateReader
};

constexpr void fields(auto& visitor, Is<CompressedStates> auto& pdu) {
  visitor("header", pdu.header);
  visitor("simulation_address", pdu.simulation);
  visitor("form", pdu.form);
  visitor("layout", pdu.layout);
  visitor("number_of_states", pdu.number_of_states);
  visitor.walked("states", pdu.states);
}
inline constexpr std::size_t kCompressedStatesSize = kFixedSize<CompressedStates>;
static_assert(kCompressedStatesSize == 20);

/// One state: an octet of its length, the entity's number (u16) and the body. The highest bit of
/// the length marks a body of the compact form, whatever the form of the PDU.
inline constexpr std::size_t kCompressedHeadSize = 3;
inline constexpr std::size_t kMostCompressedBody = 127;

struct CompressedState {
  std::uint16_t entity = 0;
  CompressedForm form = CompressedForm::compact;
  std::span<const std::byte> body;
};

/// Writes head and body. Returns the octets written, 0 if the body is longer than
/// kMostCompressedBody or there is no room.
[[nodiscard]] inline std::size_t store_compressed(const CompressedState& state,
                                                  std::span<std::byte> out) noexcept {
  const std::size_t size = kCompressedHeadSize + state.body.size();
  if (state.body.size() > kMostCompressedBody || out.size() < size) return 0;
  const unsigned whole = state.form == CompressedForm::compact ? 0x80U : 0U;
  out[0] = static_cast<std::byte>(whole | state.body.size());
  store_big_endian(out.data() + 1, state.entity);
  std::copy(state.body.begin(), state.body.end(), out.begin() + kCompressedHeadSize);
  return size;
}

/// Iterates over the states of a PDU with bounds: `while (reader.next(state))`.
class CompressedStateReader {
 public:
  explicit CompressedStateReader(const CompressedStates& states) noexcept
      : form_(states.form), count_(states.number_of_states), rest_(states.states.bytes) {}

  /// False at the end and at the first state that does not fit.
  [[nodiscard]] bool next(CompressedState& out) noexcept {
    if (count_ == 0 || rest_.size() < kCompressedHeadSize) return false;
    const auto head = std::to_integer<unsigned>(rest_[0]);
    const std::size_t size = kCompressedHeadSize + (head & 0x7FU);
    if (rest_.size() < size) return false;
    out.form = (head & 0x80U) != 0 ? CompressedForm::compact : form_;
    out.entity = load_big_endian<std::uint16_t>(rest_.data() + 1);
    out.body = rest_.subspan(kCompressedHeadSize, size - kCompressedHeadSize);
    rest_ = rest_.subspan(size);
    --count_;
    return true;
  }
  /// Announced states that were not read: not 0 at the end of a damaged PDU.
  [[nodiscard]] std::size_t left() const noexcept { return count_; }

 private:
  CompressedForm form_;
  std::size_t count_;
  std::span<const std::byte> rest_;
};

}  // namespace reckon::pdu
