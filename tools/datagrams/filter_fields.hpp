// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// THE list of the fields of a filter: one row each in filter_fields.cpp.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "reckon/tools/datagrams/filter.hpp"

namespace reckon::tools {

/// Syntax and comparison of a field's value.
enum class ValueKind : std::uint8_t { number, name, id, text, type };

/// One field.
struct FilterField {
  std::string_view name;
  std::string_view meaning;
  ValueKind kind;
  std::optional<double> (*number)(const FilterSubject&) = nullptr;  ///< number and name
  std::string_view (*value_name)(unsigned) = nullptr;  ///< name, or text with a list: name of each
                                                       ///< value
  std::optional<std::string> (*text)(const FilterSubject&) = nullptr;  ///< text
  std::string_view (*short_name)(unsigned) = nullptr;  ///< name: an accepted alternative
  unsigned values = 256;                               ///< name, text: number of possible values
};

[[nodiscard]] std::span<const FilterField> filter_fields();

}  // namespace reckon::tools
