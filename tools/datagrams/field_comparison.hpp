// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// A comparison of a filter with a field of the field tables, of any PDU type: "frequency > 2e8".
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "reckon/pdu/field_search.hpp"
#include "reckon/tools/datagrams/filter_words.hpp"
#include "reckon/tools/datagrams/pdu_row.hpp"

namespace reckon::tools {

/// True if it is true for any value of the field in the PDU. A number is compared with numbers (in
/// the precision of the field) and, as typed, with text and hexadecimal octets. A word is compared
/// with the names of numbers, with text (* matches any letters) and with octets; 1:2:3 with IDs.
class FieldComparison {
 public:
  FieldComparison(pdu::FieldPath path, FilterOperator op, std::string_view value);

  /// The reason why the value does not suit the field; empty if it does.
  [[nodiscard]] std::string misfit() const;

  [[nodiscard]] bool holds(const PduRow& row) const;

 private:
  [[nodiscard]] std::string unlisted_name() const;
  [[nodiscard]] bool holds(const pdu::FieldValue& value) const;
  [[nodiscard]] bool holds_for_number(const pdu::FieldValue& value) const;
  [[nodiscard]] bool holds_for_id(const pdu::FieldValue& value) const;

  pdu::FieldPath path_;
  FilterOperator op_;
  std::string text_;                   // in lower case
  std::optional<long double> number_;  // exact for whole numbers
  double real_ = 0;
  float single_ = 0;
  std::array<std::optional<std::uint16_t>, 3> id_;
  std::size_t id_parts_ = 0;  // 0: the value is no ID
};

}  // namespace reckon::tools
