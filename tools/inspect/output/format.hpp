// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// What the views of the inspector share: the form of the output, and times, ids and cells in it.
#pragma once

#include <chrono>
#include <cstdint>
#include <string>
#include <string_view>

#include "reckon/pdu/codec/records.hpp"

namespace reckon::tools {

/// How a view writes its rows.
enum class Format : std::uint8_t { text, json, csv };

/// Seconds with 9 decimals, exactly: a double would round them.
void append_time(std::string& out, std::chrono::nanoseconds time);

/// A whole number.
void append_number(std::string& out, std::uint64_t value);

/// Three decimals, the octets of fmt's "{:.3f}" (the nearest, and the even one of two as near) in
/// half of its time; NaN and infinities as fmt writes them.
void append_thousandths(std::string& out, double value);

/// "site:application:entity".
void append_id(std::string& out, pdu::EntityId id);
[[nodiscard]] std::string id_text(pdu::EntityId id);

/// One cell of CSV by RFC 4180, of text of any origin: quoted where it holds a comma or a quote,
/// without control characters and octets that are no UTF-8 (append_clean_text()). What a
/// spreadsheet would take for a formula, for it begins with = + - or @ and is no number, has an
/// apostrophe before it.
void append_csv_cell(std::string& out, std::string_view cell);

/// Appends `,"key":value` with the value as a JSON string.
void append_json_member(std::string& out, std::string_view key, std::string_view value);

/// A number of few digits, as "%g" with `digits` gives it; "null" where JSON has none for it.
[[nodiscard]] std::string json_number(double value, int digits = 6);

}  // namespace reckon::tools
