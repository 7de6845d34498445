// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/peer/notation/entity_type_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <stdexcept>
#include <vector>

#include "reckon/pdu/codec/siso_names.hpp"
#include "reckon/pdu/codec/text_sink.hpp"
#include "reckon/pdu/print.hpp"
#include "reckon/peer/notation/nearest_word.hpp"

namespace reckon::peer {
namespace {

/// The numbers of a type in wire order.
constexpr std::size_t kParts = 7;
constexpr std::array<std::string_view, kParts> kPartNames = {
    "kind", "domain", "country", "category", "subcategory", "specific", "extra"};
using Parts = std::array<std::uint32_t, kParts>;

constexpr std::uint32_t most_of(std::size_t part) { return part == 2 ? 65535 : 255; }

pdu::EntityType type_of(const Parts& parts) {
  const auto octet = [&](std::size_t part) { return static_cast<std::uint8_t>(parts[part]); };
  return {static_cast<pdu::EntityKind>(parts[0]),
          static_cast<pdu::EntityDomain>(parts[1]),
          static_cast<std::uint16_t>(parts[2]),
          octet(3),
          octet(4),
          octet(5),
          octet(6)};
}

EntityTypeText by_number(std::string_view text) {
  Parts parts{};
  for (std::size_t part = 0; part < kParts; ++part) {
    const std::string_view number = text.substr(0, text.find('.'));
    const auto [end, error] =
        std::from_chars(number.data(), number.data() + number.size(), parts[part]);
    if (error != std::errc() || end != number.data() + number.size() ||
        parts[part] > most_of(part)) {
      return {{},
              fmt::format("its {} '{}' is not a whole number from 0 to {}", kPartNames[part],
                          number, most_of(part))};
    }
    if (number.size() == text.size()) return {type_of(parts), {}};
    text.remove_prefix(number.size() + 1);
  }
  return {{}, "it has more than 7 numbers"};
}

std::string lower(std::string_view text) {
  std::string out(text);
  for (char& c : out) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return out;
}

std::string_view without_blanks(std::string_view text) {
  const auto begin = text.find_first_not_of(" \t");
  if (begin == std::string_view::npos) return {};
  return text.substr(begin, text.find_last_not_of(" \t") - begin + 1);
}

/// The text up to its n-th blank.
std::string_view first_words(std::string_view text, std::size_t n) {
  std::size_t end = 0;
  for (; n > 0 && end < text.size(); --n) end = std::min(text.find(' ', end + 1), text.size());
  return text.substr(0, end);
}

/// Kind, domain, country and category by name, each from the table that the earlier ones select.
class WordSearch {
 public:
  /// True if `text` consists of names from `part` on; fills the parts.
  bool match(std::string_view text, std::size_t part) {
    text = without_blanks(text);
    if (text.empty() && part >= kLeast) return true;
    if (part == kNamed) return false;
    note(text, part);
    const pdu::SisoTable table = table_of(part);
    for (std::size_t i = 0; i < pdu::siso_size(table); ++i) {
      const pdu::SisoEntry entry = pdu::siso_entry(table, i);
      if (!starts_with_name(text, entry.name)) continue;
      parts_[part] = entry.value;
      if (match(text.substr(entry.name.size()), part + 1)) return true;
    }
    parts_[part] = 0;
    return part >= kLeast && match(text, part + 1);
  }

  [[nodiscard]] const Parts& parts() const { return parts_; }

  /// Error message with the unreadable part and its likely meaning.
  [[nodiscard]] std::string error() const {
    if (stuck_.empty()) return fmt::format("it has no {}", kPartNames[stuck_part_]);
    const std::string hint = nearest();
    return fmt::format("'{}' is no {}{}{}", stuck_, kPartNames[stuck_part_],
                       stuck_part_ == kLeast ? " and no category" : "",
                       hint.empty() ? "; `reckon inspect --tree` shows types in words and numbers"
                                    : fmt::format(" (did you mean \"{}\"?)", hint));
  }

 private:
  static constexpr std::size_t kLeast = 2;  // kind and domain
  static constexpr std::size_t kNamed = 4;

  [[nodiscard]] pdu::SisoTable table_of(std::size_t part) const {
    const pdu::EntityType type = type_of(parts_);
    if (part == 0) return pdu::SisoTable::entity_kind;
    if (part == 1) return pdu::domain_table(type.kind);
    if (part == 2) return pdu::SisoTable::country;
    return pdu::category_table(type.kind, type.domain);
  }

  static bool starts_with_name(std::string_view text, std::string_view name) {
    if (name.empty() || text.size() < name.size()) return false;
    if (text.size() > name.size() && text[name.size()] != ' ') return false;
    return lower(text.substr(0, name.size())) == lower(name);
  }

  void note(std::string_view text, std::size_t part) {
    if (noted_ && text.size() >= stuck_.size()) return;
    noted_ = true;
    stuck_ = text;
    stuck_part_ = part;
    candidates_.clear();
    for (std::size_t at = part; at < (part >= kLeast ? kNamed : part + 1); ++at) {
      const pdu::SisoTable table = table_of(at);
      for (std::size_t i = 0; i < pdu::siso_size(table); ++i) {
        candidates_.push_back(pdu::siso_entry(table, i).name);
      }
    }
  }

  /// Compares as many words as the name has.
  [[nodiscard]] std::string nearest() const {
    for (std::size_t words = 6; words > 0; --words) {
      std::vector<std::string_view> names;
      std::ranges::copy_if(candidates_, std::back_inserter(names), [&](std::string_view name) {
        return static_cast<std::size_t>(std::ranges::count(name, ' ')) + 1 == words;
      });
      const auto found = nearest_word(first_words(stuck_, words), names);
      if (!found.empty()) return std::string(found);
    }
    return {};
  }

  Parts parts_{};
  bool noted_ = false;
  std::string stuck_;
  std::size_t stuck_part_ = 0;
  std::vector<std::string_view> candidates_;
};

}  // namespace

EntityTypeText parse_entity_type(std::string_view text) {
  text = without_blanks(text);
  if (text.empty()) return {{}, "it is empty"};
  if (std::isdigit(static_cast<unsigned char>(text.front())) != 0) return by_number(text);
  WordSearch search;
  if (search.match(text, 0)) return {type_of(search.parts()), {}};
  return {{}, search.error()};
}

pdu::EntityType entity_type(std::string_view text) {
  const EntityTypeText parsed = parse_entity_type(text);
  if (!parsed.good())
    throw std::invalid_argument(fmt::format("type \"{}\": {}", text, parsed.error));
  return parsed.type;
}

std::string entity_type_numbers(const pdu::EntityType& type) {
  return fmt::format("{}", fmt::join(type.numbers(), "."));
}

std::string entity_type_words(const pdu::EntityType& type) {
  std::string text;
  pdu::TextSink sink(text);
  pdu::put_type_in_words(sink, type);
  return text;
}

}  // namespace reckon::peer
