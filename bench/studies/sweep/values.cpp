// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/bench/studies/sweep/values.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <charconv>
#include <string>

#include "reckon/peer/notation/nearest_word.hpp"
#include "reckon/peer/notation/units.hpp"
#include "reckon/tools/command_line/console.hpp"

namespace reckon::bench {
namespace {

using peer::format_quantity;

std::string_view trimmed(std::string_view text) {
  while (text.starts_with(' ')) text.remove_prefix(1);
  while (text.ends_with(' ')) text.remove_suffix(1);
  return text;
}

bool is_number(std::string_view text) {
  double value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  return error == std::errc() && end == text.data() + text.size();
}

/// The text after the number.
std::string_view unit_of(std::string_view text) {
  double value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc()) return {};
  return trimmed(text.substr(static_cast<std::size_t>(end - text.data())));
}

/// One part of a list: one value, or a range of `count`.
struct Part {
  std::string_view first, last;  // last: empty for one value
  std::size_t count = 1;
};

[[noreturn]] void refuse(std::string_view where, std::string_view what, std::string_view remedy) {
  throw tools::UsageError(fmt::format("{}: '{}' {}", where, what, remedy));
}

Part part_of(std::string_view text, std::string_view where) {
  const std::size_t dots = text.find("..");
  if (dots == text.npos) return {text, {}, 1};
  Part part{trimmed(text.substr(0, dots)), trimmed(text.substr(dots + 2)), kRangeValues};
  const std::size_t slash = part.last.rfind('/');
  const std::string_view count =
      slash == part.last.npos ? std::string_view{} : trimmed(part.last.substr(slash + 1));
  if (count.empty() || std::isdigit(static_cast<unsigned char>(count.front())) == 0) return part;
  const auto [end, error] = std::from_chars(count.data(), count.data() + count.size(), part.count);
  if (error != std::errc() || end != count.data() + count.size() || part.count < 2 ||
      part.count > kMostValues)
    refuse(where, count,
           fmt::format("is not a count from 2 to {}; write for example 0..1/5", kMostValues));
  part.last = trimmed(part.last.substr(0, slash));
  return part;
}

double value_of(std::string_view text, std::string_view unit_if_none, const ValueRule& rule,
                std::string_view where) {
  if (text.empty()) refuse(where, text, "has no value; write A..B/N or A,B,C");
  std::string whole(text);
  if (is_number(text) && !unit_if_none.empty()) whole += fmt::format(" {}", unit_if_none);
  const peer::Quantity quantity = peer::parse_quantity(whole, rule.unit);
  if (!quantity.good()) throw tools::UsageError(fmt::format("{}: {}", where, quantity.error));
  const double value = quantity.value;
  const bool low = rule.open ? !(value > rule.least) : !(value >= rule.least);
  if (low || !(value <= rule.most))
    refuse(
        where, whole,
        fmt::format("is not {} {} to {}", rule.open ? "above" : "from",
                    format_quantity(rule.least, rule.unit), format_quantity(rule.most, rule.unit)));
  return value;
}

}  // namespace

std::vector<std::string_view> parts_between_commas(std::string_view text) {
  std::vector<std::string_view> parts;
  for (;;) {
    const std::size_t comma = text.find(',');
    parts.push_back(trimmed(text.substr(0, comma)));
    if (comma == text.npos) return parts;
    text.remove_prefix(comma + 1);
  }
}

std::vector<double> read_values(std::string_view text, const ValueRule& rule,
                                std::string_view where) {
  std::vector<Part> parts;
  for (const std::string_view part : parts_between_commas(text))
    parts.push_back(part_of(part, where));
  // From the end, because a number without a unit takes the unit of the next one.
  std::vector<double> values;
  std::string_view unit;
  for (auto part = parts.rbegin(); part != parts.rend(); ++part) {
    const auto read = [&](std::string_view word) {
      const double value = value_of(word, unit, rule, where);
      if (const std::string_view own = unit_of(word); !own.empty()) unit = own;
      return value;
    };
    if (part->last.empty() && part->count == 1) {
      values.push_back(read(part->first));
      continue;
    }
    const double last = read(part->last), first = read(part->first);
    const auto steps = static_cast<double>(part->count - 1);
    for (std::size_t i = part->count; i-- > 0;)
      values.push_back(
          i == part->count - 1 ? last : first + (last - first) * static_cast<double>(i) / steps);
  }
  std::reverse(values.begin(), values.end());
  if (values.size() > kMostValues)
    throw tools::UsageError(
        fmt::format("{}: {} values; write at most {}", where, values.size(), kMostValues));
  for (auto value = values.begin(); value != values.end(); ++value)
    if (std::find(values.begin(), value, *value) != value)
      refuse(where, format_quantity(*value, rule.unit), "is given twice; write each value once");
  return values;
}

void refuse_name(std::string_view where, std::string_view name,
                 std::span<const std::string_view> known, std::string_view more) {
  const std::string_view nearest = peer::nearest_word(name, known);
  throw tools::UsageError(
      fmt::format("{}: there is no '{}'{}; known: {}{}", where, name,
                  nearest.empty() ? "" : fmt::format(" (did you mean '{}'?)", nearest),
                  fmt::join(known, ", "), more));
}

}  // namespace reckon::bench
