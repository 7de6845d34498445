// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/tools/datagrams/first_location.hpp"

#include <concepts>
#include <string_view>

#include "reckon/pdu/fixed_fields.hpp"
#include "reckon/pdu/pdu_types.hpp"

namespace reckon::tools {
namespace {

/// Visitor: the first position in W among the fields of a PDU.
class FirstLocation : public pdu::FixedFields {
 public:
  template <typename T>
  void operator()(std::string_view, const T& value) {
    if constexpr (std::same_as<T, pdu::WorldCoordinates>) {
      if (!location_.has_value()) location_ = value;
    }
  }

  [[nodiscard]] const std::optional<pdu::WorldCoordinates>& location() const { return location_; }

 private:
  std::optional<pdu::WorldCoordinates> location_;
};

}  // namespace

std::optional<pdu::WorldCoordinates> first_location(const PduRow& row) {
  if (row.entity_state != nullptr) return row.entity_state->location;
  if (!row.decoded) return std::nullopt;
  FirstLocation first;
  (void)pdu::visit(row.bytes, row.header, [&](const auto& pdu) { fields(first, pdu); });
  return first.location();
}

}  // namespace reckon::tools
