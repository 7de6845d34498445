// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Common parts of the inspector's views: the output format, and times, IDs and cells in it.
#pragma once

#include <chrono>
#include <cstdint>
#include <string>
#include <string_view>

#include "reckon/pdu/codec/records.hpp"

namespace reckon::tools {

/// Format of a view's rows.
enum class Format : std::uint8_t { text, json, csv };

/// Seconds with 9 decimals, exactly: a double would round them.
void append_time(std::string& out, std::chrono::nanoseconds time);

/// A whole number.
void append_number(std::string& out, std::uint64_t value);

/// Three decimals, the same text as fmt's "{:.3f}" (rounded to nearest, ties to even) in half the
/// time; NaN and infinities as in fmt.
void append_thousandths(std::string& out, double value);

/// "site:application:entity".
void append_id(std::string& out, pdu::EntityId id);
[[nodiscard]] std::string id_text(pdu::EntityId id);

/// One cell of CSV by RFC 4180, for untrusted text. It is quoted if it has a comma or a quote, and
/// control characters and invalid UTF-8 are replaced (append_clean_text()). Text that begins with =
/// + - or @ and is not a number gets an apostrophe, so that no spreadsheet evaluates it as a
/// formula.
void append_csv_cell(std::string& out, std::string_view cell);

/// Appends `,"key":value` with the value as a JSON string.
void append_json_member(std::string& out, std::string_view key, std::string_view value);

/// A number in few digits, like "%g" with `digits`; "null" for a number that JSON lacks.
[[nodiscard]] std::string json_number(double value, int digits = 6);

}  // namespace reckon::tools
