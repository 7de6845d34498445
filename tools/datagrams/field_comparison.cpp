// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/tools/datagrams/field_comparison.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <charconv>
#include <cmath>
#include <functional>
#include <iterator>
#include <limits>
#include <set>
#include <utility>

namespace reckon::tools {
namespace {

static_assert(std::numeric_limits<long double>::digits >= 64, "every 64-bit number matches it");

/// A number that takes the whole text.
template <typename Number>
std::optional<Number> number_in(std::string_view text) {
  Number number{};
  const char* end = text.data() + text.size();
  const auto read = std::from_chars(text.data(), end, number);
  if (read.ec != std::errc{} || read.ptr != end) return std::nullopt;
  return number;
}

/// Hexadecimal digits, two per octet.
std::string hex_of(std::span<const std::byte> octets) {
  std::string text;
  for (const std::byte octet : octets)
    fmt::format_to(std::back_inserter(text), "{:02x}", std::to_integer<unsigned>(octet));
  return text;
}

}  // namespace

FieldComparison::FieldComparison(pdu::FieldPath path, FilterOperator op, std::string_view value)
    : path_(std::move(path)), op_(op), text_(lower(value)) {
  if (const auto positive = number_in<std::uint64_t>(value))
    number_ = *positive;
  else if (const auto negative = number_in<std::int64_t>(value))
    number_ = *negative;
  if (const auto real = number_in<double>(value); real.has_value() && std::isfinite(*real)) {
    real_ = *real;
    single_ = number_in<float>(value).value_or(static_cast<float>(real_));
    if (!number_.has_value()) number_ = real_;
  }
  std::string_view rest = value;
  for (std::size_t i = 0; i < id_.size() && !rest.empty(); ++i) {
    const std::size_t end = std::min(rest.find_first_of(":-"), rest.size());
    const std::string_view part = rest.substr(0, end);
    id_[i] = number_in<std::uint16_t>(part);
    if (!id_[i].has_value() && part != "*") return;
    rest = rest.substr(std::min(end + 1, rest.size()));
    if (rest.empty() && i > 0) id_parts_ = i + 1;
  }
}

std::string FieldComparison::misfit() const {
  const bool is_ordered = op_ != FilterOperator::equal && op_ != FilterOperator::unequal;
  if (is_ordered && !path_.has_numbers()) return "this field allows == and != only";
  if (number_.has_value()) return {};
  if (is_ordered || (!path_.has_names() && !path_.has_others()))
    return fmt::format("'{}' is not a number, but this field is", text_);
  return path_.has_others() && !path_.is_name() ? std::string() : unlisted_name();
}

std::string FieldComparison::unlisted_name() const {
  constexpr std::size_t kShown = 6;
  WordSearch search(path_.is_name() ? text_ : word_of(text_));
  std::set<std::string, std::less<>> names;
  bool is_listed = false;
  path_.each_name([&](std::string_view name) {
    std::string word = path_.is_name() ? lower(name) : word_of(name);
    is_listed = is_listed || (path_.is_name() && is_like(word, text_));
    search.look_at(word);
    names.insert(std::move(word));
  });
  if (is_listed || search.is_found()) return {};
  if (names.empty()) return fmt::format("'{}' is not a number, but this field is", text_);
  const auto end = names.size() > kShown ? std::next(names.begin(), kShown) : names.end();
  const std::string known =
      fmt::format("; it is a number, or {}{}", fmt::join(names.begin(), end, ", "),
                  end == names.end() ? "" : ", ...");
  return fmt::format("this field has no value '{}'{}", text_, suggestion(search.nearest(), known));
}

bool FieldComparison::holds(const PduRow& row) const {
  if (!row.has_header) return false;
  const auto test = [](const void* self, const pdu::FieldValue& value) {
    return static_cast<const FieldComparison*>(self)->holds(value);
  };
  return pdu::any_value(path_, row.bytes, row.header, {this, test});
}

bool FieldComparison::holds(const pdu::FieldValue& value) const {
  using Kind = pdu::FieldValue::Kind;
  switch (value.kind) {
    case Kind::whole:
    case Kind::single:
    case Kind::real:
      return holds_for_number(value);
    case Kind::id:
      return holds_for_id(value);
    case Kind::text:
      return is_like(lower(value.text), text_) == (op_ == FilterOperator::equal);
    case Kind::octets:
      return is_like(hex_of(value.octets), text_) == (op_ == FilterOperator::equal);
  }
  return false;
}

bool FieldComparison::holds_for_number(const pdu::FieldValue& value) const {
  if (!number_.has_value()) {
    const std::string word = word_of(text_);
    const bool is_called = word_of(value.name) == word || word_of(value.code) == word;
    return !value.name.empty() && is_called == (op_ == FilterOperator::equal);
  }
  if (value.kind == pdu::FieldValue::Kind::single)
    return tools::holds(static_cast<float>(value.number), op_, single_);
  if (value.kind == pdu::FieldValue::Kind::real)
    return tools::holds(static_cast<double>(value.number), op_, real_);
  return tools::holds(value.number, op_, *number_);
}

bool FieldComparison::holds_for_id(const pdu::FieldValue& value) const {
  if (id_parts_ != value.id_parts) return false;
  bool is_same = true;
  for (std::size_t i = 0; i < id_parts_; ++i)
    is_same = is_same && id_[i].value_or(value.id[i]) == value.id[i];
  return is_same == (op_ == FilterOperator::equal);
}

}  // namespace reckon::tools
