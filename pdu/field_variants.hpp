// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Example PDUs of one type. Together they have every field that a PDU of this type may have, for
// walks through examples (field_walk.hpp).
#pragma once

#include <array>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string_view>
#include <utility>

#include "reckon/pdu/fixed_fields.hpp"
#include "reckon/pdu/pdu_types.hpp"

namespace reckon::pdu {

/// Visitor: sets the octets of flags that switch fields on.
struct AllFlags : FixedFields {
  template <typename T>
  void operator()(std::string_view name, T& value) {
    if constexpr (std::same_as<T, std::uint8_t>) {
      if (name.ends_with("flags")) value = 0xFF;
    }
  }
};

/// Calls `f` with PDUs of this type that have different fields.
template <typename Pdu, typename F>
void each_variant(F&& f) {
  static constexpr std::array<std::byte, 128> kZeros{};
  const auto pdu = std::make_unique<Pdu>();
  AllFlags flags;
  fields(flags, *pdu);
  f(std::as_const(*pdu));
  if constexpr (std::same_as<Pdu, Fire> || std::same_as<Pdu, Detonation>) {
    for (const std::uint8_t status : {std::uint8_t{0x10}, std::uint8_t{0x20}}) {
      pdu->header.pdu_status = status;
      f(std::as_const(*pdu));
    }
  } else if constexpr (std::same_as<Pdu, Transmitter>) {
    pdu->antenna_pattern_type = BeamAntennaPattern::kBeam;
    pdu->antenna_pattern.bytes = std::span(kZeros).first(kFixedSize<BeamAntennaPattern>);
    for (const auto& [system, size] :
         {std::pair<std::uint16_t, std::size_t>{2, 16}, {6, 16}, {8, 8}}) {
      pdu->modulation_type.radio_system = system;
      pdu->modulation_parameters.bytes = std::span(kZeros).first(size);
      f(std::as_const(*pdu));
    }
  } else if constexpr (std::same_as<Pdu, GriddedData>) {
    pdu->number_of_grid_axes = 1;  // more than present, so that the part stays octets
    f(std::as_const(*pdu));
  } else if constexpr (std::same_as<Pdu, AggregateState>) {
    pdu->silent_systems_and_variable_datums.bytes = std::span(kZeros).first(8);
    f(std::as_const(*pdu));
    pdu->number_of_silent_entity_systems = 1;  // more than present, so that the part stays octets
    pdu->silent_systems_and_variable_datums.bytes = {};
    f(std::as_const(*pdu));
  }
  if constexpr (std::same_as<Pdu, IsGroupOf>) {
    pdu->number_of_grouped_entities = 1;
    for (const std::size_t size : {20U, 24U, 20U, 24U, 24U, 28U, 20U, 24U, 16U}) {
      ++pdu->grouped_entity_category;
      pdu->grouped_entity_descriptions.bytes = std::span(kZeros).first(size);
      f(std::as_const(*pdu));
    }
  } else if constexpr (std::same_as<Pdu, MinefieldData>) {
    pdu->number_of_mines = 1;
    pdu->data_filter = 0x7FF;
    pdu->mines.bytes = std::span(kZeros).first(12 + 3 * 4 + 12 + 2 * 4 + 8 + 2 + 2 + 1 + 3 + 4);
    f(std::as_const(*pdu));
  }
  pdu->header.protocol_version = 6;
  f(std::as_const(*pdu));
}

}  // namespace reckon::pdu
