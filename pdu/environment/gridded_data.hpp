// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Gridded Data PDU (type 42): values on a grid. Axes and values are kept as octets.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>

#include "reckon/pdu/codec/codec.hpp"
#include "reckon/pdu/codec/octet_block.hpp"
#include "reckon/pdu/codec/records.hpp"
#include "reckon/pdu/codec/sized_records.hpp"

namespace reckon::pdu {

/// Head of a grid axis. A regular axis (type 0) ends with it, an irregular one (type 1) has its
/// points.
struct GridAxis {
  double domain_initial_xi = 0.0;
  double domain_final_xi = 0.0;
  std::uint16_t domain_points_xi = 0;
  std::uint8_t interleaf_factor = 0;
  std::uint8_t axis_type = 0;
  std::uint16_t number_of_points_on_xi_axis = 0;
  std::uint16_t initial_index = 0;

  [[nodiscard]] WalkResult extent(std::span<const std::byte>) const noexcept {
    if (axis_type > 1) return {0, DecodeError::record};
    const std::size_t points = std::size_t{number_of_points_on_xi_axis} * 2;
    return {axis_type == 0 ? 0 : padded_to(16 + points, 8), DecodeError::none};
  }
};

constexpr void fields(auto& visitor, Is<GridAxis> auto& record) {
  visitor("domain_initial_xi", record.domain_initial_xi);
  visitor("domain_final_xi", record.domain_final_xi);
  visitor("domain_points_xi", record.domain_points_xi);
  visitor("interleaf_factor", record.interleaf_factor);
  visitor("axis_type", record.axis_type);
  visitor("number_of_points_on_xi_axis", record.number_of_points_on_xi_axis);
  visitor("initial_index", record.initial_index);
}
static_assert(kFixedSize<GridAxis> == 24);

/// Precedes the points of an irregular axis.
struct GridAxisScale {
  double coordinate_scale_xi = 0.0;
  double coordinate_offset_xi = 0.0;
};

/// One number of an axis or of a sample.
template <typename NumberType>
struct GridValue {
  using Number = NumberType;
  Number value = 0;
};

/// Shows the first \p count numbers of `octets`, then their padding.
template <typename Number, typename Visitor>
void show_grid_values(Visitor& visitor, std::span<const std::byte> octets, std::size_t count) {
  const std::size_t size = count * sizeof(Number);
  visitor.records("values", octets.first(size), Records<GridValue<Number>, std::uint16_t>{});
  visitor.walked("padding", RestOfPdu{octets.subspan(size)});
}

void parts(auto& visitor, const GridAxis& axis, std::span<const std::byte> body) {
  GridAxisScale scale;
  if (!load_record(body, scale)) return;
  fields(visitor, std::as_const(scale));
  show_grid_values<std::uint16_t>(visitor, body.subspan(kFixedSize<GridAxisScale>),
                                  axis.number_of_points_on_xi_axis);
}

/// Head of the samples of one quantity. Representation 0 has a number of octets and the octets.
/// Representation 1 has scale and offset (f32), a number of values and the values (u16).
/// Representation 2 has a number of values, two octets of padding and the values (f32).
struct GridSamples {
  std::uint16_t sample_type = 0;
  std::uint16_t data_representation = 0;

  /// Octets between the head and the values.
  [[nodiscard]] constexpr std::size_t lead() const noexcept {
    constexpr std::array<std::size_t, 3> kLead{2, 10, 4};
    return kLead[data_representation];
  }
  /// Number of values at the start of `behind`; 0 if there is none.
  [[nodiscard]] std::size_t number_of_values(std::span<const std::byte> behind) const noexcept {
    const std::size_t at = data_representation == 1 ? 8 : 0;
    return behind.size() < at + 2 ? 0 : load_big_endian<std::uint16_t>(behind.data() + at);
  }
  [[nodiscard]] WalkResult extent(std::span<const std::byte> behind) const noexcept {
    if (data_representation > 2) return {0, DecodeError::record};
    constexpr std::array<std::size_t, 3> kEach{1, 2, 4};
    const std::size_t held = lead() + number_of_values(behind) * kEach[data_representation];
    return {padded_to(held, data_representation == 0 ? 2 : 4), DecodeError::none};
  }
};

constexpr void fields(auto& visitor, Is<GridSamples> auto& record) {
  visitor("sample_type", record.sample_type);
  visitor("data_representation", record.data_representation);
}
static_assert(kFixedSize<GridSamples> == 4);

void parts(auto& visitor, const GridSamples& samples, std::span<const std::byte> body) {
  const std::size_t count = samples.number_of_values(body);
  const std::span<const std::byte> values = body.subspan(samples.lead());
  if (samples.data_representation == 1) {
    visitor("field_scale", load_big_endian<float>(body.data()));
    visitor("field_offset", load_big_endian<float>(body.data() + 4));
  }
  visitor("number_of_values", static_cast<std::uint16_t>(count));
  switch (samples.data_representation) {
    case 0:
      return visitor.walked("values", RestOfPdu{values});
    case 1:
      return show_grid_values<std::uint16_t>(visitor, values, count);
    default:
      visitor("padding_1", load_big_endian<std::uint16_t>(body.data() + 2));
      return show_grid_values<float>(visitor, values, count);
  }
}

struct GriddedData {
  static constexpr PduType kPduType = PduType::gridded_data;
  static constexpr ProtocolFamily kProtocolFamily = ProtocolFamily::synthetic_environment;

  PduHeader header = header_of<GriddedData>();
  EntityId environmental_simulation_application_id;
  std::uint16_t field_number = 0;
  std::uint16_t pdu_number = 0;
  std::uint16_t pdu_total = 0;
  std::uint16_t coordinate_system = 0;
  std::uint8_t number_of_grid_axes = 0;
  std::uint8_t constant_grid = 0;
  EntityType environment_type;
  EulerAngles orientation;  ///< [rad]
  ClockTime sample_time;
  std::uint32_t total_values = 0;
  std::uint8_t vector_dimension = 0;
  std::uint8_t padding_1 = 0;
  std::uint16_t padding_2 = 0;
  RestOfPdu grid_axes_and_data;  ///< shown by fields if axes and samples fill it exactly
};

/// Shows axes and samples by their fields. False, with nothing done, if they do not fill the octets
/// exactly: public sources differ in the padding after samples.
bool show_grid(auto& visitor, const GriddedData& pdu) {
  const std::span<const std::byte> all = pdu.grid_axes_and_data.bytes;
  using Axes = SizedRecords<GridAxis, std::uint8_t>;
  using Samples = SizedRecords<GridSamples, std::uint8_t>;
  const WalkResult axes = Axes::walk(pdu.number_of_grid_axes, all);
  if (axes.error != DecodeError::none) return false;
  const std::span<const std::byte> behind = all.subspan(axes.size);
  const WalkResult samples = Samples::walk(pdu.vector_dimension, behind);
  if (samples.error != DecodeError::none || samples.size != behind.size()) return false;
  visitor.walked("grid_axes", Axes{pdu.number_of_grid_axes, all.first(axes.size)});
  visitor.walked("grid_data", Samples{pdu.vector_dimension, behind});
  return true;
}

template <typename Visitor, Is<GriddedData> Pdu>
constexpr void fields(Visitor& visitor, Pdu& pdu) {
  visitor("header", pdu.header);
  visitor("environmental_simulation_application_id", pdu.environmental_simulation_application_id);
  visitor("field_number", pdu.field_number);
  visitor("pdu_number", pdu.pdu_number);
  visitor("pdu_total", pdu.pdu_total);
  visitor("coordinate_system", pdu.coordinate_system);
  visitor("number_of_grid_axes", pdu.number_of_grid_axes);
  visitor("constant_grid", pdu.constant_grid);
  visitor("environment_type", pdu.environment_type);
  visitor("orientation", pdu.orientation);
  visitor("sample_time", pdu.sample_time);
  visitor("total_values", pdu.total_values);
  visitor("vector_dimension", pdu.vector_dimension);
  visitor("padding_1", pdu.padding_1);
  visitor("padding_2", pdu.padding_2);
  if constexpr (Looks<Visitor, Pdu>) {
    if (show_grid(visitor, pdu)) return;
  }
  visitor.walked("grid_axes_and_data", pdu.grid_axes_and_data);
}
static_assert(kFixedSize<GriddedData> == 64);

}  // namespace reckon::pdu
