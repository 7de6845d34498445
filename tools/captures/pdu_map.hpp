// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Changes IDs and place in the octets of one PDU, using its field table.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string_view>

#include "reckon/pdu/codec/decode_error.hpp"
#include "reckon/pdu/codec/pdu_header.hpp"
#include "reckon/tools/captures/id_map.hpp"
#include "reckon/tools/captures/place_shift.hpp"

namespace reckon::tools {

/// Result for a PDU.
struct MappedPdu {
  /// none: mapped; else nothing was changed.
  pdu::DecodeError error = pdu::DecodeError::none;
  bool has_octets = false;  ///< contains octets without fields: vendor records, datums, signals
  bool kept_place = false;  ///< contains a place that cannot be moved: live entities, grids
  bool kept_id = false;     ///< contains an 8-bit ID that is too small for the new one
};

/// Maps a whole PDU in place; its length stays. Non-finite places and 0, 0, 0 are unchanged.
/// @param shift null: places stay  @param body_axes whether the velocity of an Entity State Update
/// is in body axes
[[nodiscard]] MappedPdu map_pdu(std::span<std::byte> pdu, const pdu::PduHeader& header,
                                const IdMap& ids, const PlaceShift* shift, bool body_axes);

/// The first place of a PDU that is finite and not 0, 0, 0.
[[nodiscard]] std::optional<Eigen::Vector3d> first_place(std::span<const std::byte> pdu,
                                                         const pdu::PduHeader& header);

/// Axes of a vector, by the name of its field; no value for an unknown name.
enum class VectorAxes : std::uint8_t {
  world,    ///< geocentric
  model,    ///< geocentric or body axes, by the dead-reckoning algorithm
  another,  ///< axes of another entity, or none: not rotated
};
[[nodiscard]] std::optional<VectorAxes> axes_of(std::string_view field);

}  // namespace reckon::tools
