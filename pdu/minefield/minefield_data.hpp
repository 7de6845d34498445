// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Minefield Data PDU (type 39): single mines, a column for each quantity that data_filter selects.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>

#include "reckon/pdu/codec/codec.hpp"
#include "reckon/pdu/codec/octet_block.hpp"
#include "reckon/pdu/codec/records.hpp"
#include "reckon/pdu/codec/sized_records.hpp"
#include "reckon/pdu/minefield/minefield_records.hpp"

namespace reckon::pdu {

struct MinefieldData {
  static constexpr PduType kPduType = PduType::minefield_data;
  static constexpr ProtocolFamily kProtocolFamily = ProtocolFamily::minefield;
  using SensorTypes = Records<SensorType, std::uint8_t>;

  PduHeader header = header_of<MinefieldData>();
  EntityId minefield_id;
  EntityId requesting_entity_id;
  std::uint16_t minefield_sequence = 0;
  std::uint8_t request_id = 0;
  std::uint8_t pdu_sequence_number = 0;
  std::uint8_t number_of_pdus = 0;
  std::uint8_t number_of_mines = 0;
  std::span<const std::byte> sensor_types;  ///< read with records_of<SensorType>
  std::uint8_t padding = 0;
  std::uint32_t data_filter = 0;
  EntityType mine_type;
  RestOfPdu mines;  ///< shown by fields if the selected columns fill it exactly
};

/// Cuts the octets of the mines into columns.
class MineColumns {
 public:
  explicit MineColumns(const MinefieldData& pdu) noexcept
      : rest_(pdu.mines.bytes), at_(pdu.sensor_types.size()) {}

  /// Empty if there are fewer octets.
  [[nodiscard]] std::span<const std::byte> cut(std::size_t size) noexcept {
    fits_ = fits_ && size <= rest_.size();
    if (!fits_) return {};
    const auto column = rest_.first(size);
    rest_ = rest_.subspan(size);
    at_ += size;
    return column;
  }
  /// The octets up to a multiple of 4, which the end of the PDU may lack.
  [[nodiscard]] std::span<const std::byte> padding() noexcept {
    return cut(rest_.empty() ? 0 : padded_to(at_, 4) - at_);
  }
  [[nodiscard]] bool are_all() const noexcept { return fits_ && rest_.empty(); }

 private:
  std::span<const std::byte> rest_;
  std::size_t at_;  // behind the fixed part, whose size is a multiple of 4
  bool fits_ = true;
};

/// Sum of the numbers in a column.
[[nodiscard]] inline std::size_t sum_of(std::span<const std::byte> column) noexcept {
  std::size_t sum = 0;
  for (const std::byte number : column) sum += std::to_integer<std::size_t>(number);
  return sum;
}

/// Visits the columns in wire order. Returns whether they fill the octets exactly.
bool walk_mines(auto& visitor, const MinefieldData& pdu) {
  MineColumns columns(pdu);
  const std::size_t mines = pdu.number_of_mines;
  const auto list = [&]<typename Record>(std::string_view name, Record, std::size_t count) {
    const auto column = columns.cut(count * kFixedSize<Record>);
    visitor.records(name, column, Records<Record, std::uint16_t>{});
    return column;
  };
  const auto list_if = [&](unsigned bit, std::string_view name, auto record) {
    if ((pdu.data_filter >> bit & 1U) != 0) list(name, record, mines);
  };
  const auto padding = [&](std::string_view name) {
    visitor.walked(name, RestOfPdu{columns.padding()});
  };
  padding("padding_to_32_bits");
  list("mine_locations", Vector3Float{}, mines);
  list_if(0, "ground_burial_depth_offsets", MineReal{});
  list_if(1, "water_burial_depth_offsets", MineReal{});
  list_if(2, "snow_burial_depth_offsets", MineReal{});
  list_if(3, "mine_orientations", EulerAngles{});
  list_if(4, "thermal_contrasts", MineReal{});
  list_if(5, "reflectances", MineReal{});
  list_if(6, "mine_emplacement_times", ClockTime{});
  list("mine_entity_numbers", MineWord{}, mines);
  list_if(8, "fusings", MineWord{});
  if ((pdu.data_filter >> 9 & 1U) != 0)
    list("scalar_detection_coefficients", MineOctet{},
         mines * (pdu.sensor_types.size() / kFixedSize<SensorType>));
  list_if(10, "paint_schemes", MineOctet{});
  padding("padding_behind_mines");
  if ((pdu.data_filter >> 7 & 1U) != 0) {
    const std::size_t wires = sum_of(list("numbers_of_wires", MineOctet{}, mines));
    padding("padding_behind_numbers_of_wires");
    const std::size_t vertices = sum_of(list("numbers_of_vertices", MineOctet{}, wires));
    padding("padding_behind_numbers_of_vertices");
    list("wire_vertices", Vector3Float{}, vertices);
  }
  return columns.are_all();
}

/// Visitor of columns that only checks.
struct NoColumns {
  void records(std::string_view, std::span<const std::byte>, auto) noexcept {}
  void walked(std::string_view, const RestOfPdu&) noexcept {}
};

/// Shows the mines by their fields. False, with nothing done, if there are none, if a selected
/// column is not defined by the standard, or if the columns do not fill the octets exactly.
bool show_mines(auto& visitor, const MinefieldData& pdu) {
  constexpr std::uint32_t kKnown = 0x7FF;
  NoColumns nobody;
  if (pdu.number_of_mines == 0 || (pdu.data_filter & ~kKnown) != 0) return false;
  return walk_mines(nobody, pdu) && walk_mines(visitor, pdu);
}

template <typename Visitor, Is<MinefieldData> Pdu>
constexpr void fields(Visitor& visitor, Pdu& pdu) {
  visitor("header", pdu.header);
  visitor("minefield_id", pdu.minefield_id);
  visitor("requesting_entity_id", pdu.requesting_entity_id);
  visitor("minefield_sequence", pdu.minefield_sequence);
  visitor("request_id", pdu.request_id);
  visitor("pdu_sequence_number", pdu.pdu_sequence_number);
  visitor("number_of_pdus", pdu.number_of_pdus);
  visitor("number_of_mines", pdu.number_of_mines);
  visitor.count("number_of_sensor_types", pdu.sensor_types, MinefieldData::SensorTypes{});
  visitor("padding", pdu.padding);
  visitor("data_filter", pdu.data_filter);
  visitor("mine_type", pdu.mine_type);
  visitor.records("sensor_types", pdu.sensor_types, MinefieldData::SensorTypes{});
  if constexpr (Looks<Visitor, Pdu>) {
    if (show_mines(visitor, pdu)) return;
  }
  visitor.walked("mines", pdu.mines);
}
static_assert(kFixedSize<MinefieldData> == 44);

}  // namespace reckon::pdu
