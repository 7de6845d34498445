// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The filter of `--where`: "entity.id == 1:*:* and kind == platform". Compiled once, then evaluated
// for each PDU. Its fields are the list in filter_fields.cpp, where a new one is one row, and then
// all fields of the field tables: "frequency > 2e8", "systems.beams.beam_function == search".
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "reckon/pdu/entity/entity_state.hpp"
#include "reckon/tools/command_line/console.hpp"
#include "reckon/tools/datagrams/field_comparison.hpp"
#include "reckon/tools/datagrams/filter_words.hpp"
#include "reckon/tools/datagrams/pdu_row.hpp"
#include "reckon/tools/datagrams/type_pattern.hpp"

namespace reckon::tools {

/// Invalid filter text. what() has the reason and the text with a mark under the column.
struct FilterError : UsageError {
  FilterError(std::string_view text, std::size_t column_, std::string_view why);
  std::size_t column;  ///< from 1; one more than the text's length if the text ends too early
};

/// Input of a field.
struct FilterSubject {
  const PduRow& row;
  const peer::SourceDatagram& datagram;
  const PduRow& entity;                  ///< the PDU, or one of the states restored from it
  const pdu::EntityState* entity_state;  ///< its state; null if it is no Entity State
};

/// A compiled filter. A comparison with a field that the PDU lacks is false for every operator.
/// Compressed States match if one of their states does; a state also has the fields of the PDU. Any
/// thread; a match allocates only for text and octets.
class Filter {
 public:
  /// Longest text [octets] and deepest nesting of parentheses and `not`.
  static constexpr std::size_t kLongest = 4096;
  static constexpr std::size_t kDeepest = 64;

  /// @throws FilterError.
  explicit Filter(std::string_view text);

  [[nodiscard]] bool matches(const PduRow& row, const peer::SourceDatagram& datagram) const;

  using Operator = FilterOperator;
  /// An entity ID with optional wildcards as parts.
  struct IdPattern {
    std::optional<std::uint16_t> site;
    std::optional<std::uint16_t> application;
    std::optional<std::uint16_t> entity;
  };
  struct Comparison {
    std::size_t field = 0;  ///< row of the list of fields, or index of a comparison of_table
    bool of_table = false;  ///< with a field of the field tables
    Operator op = Operator::equal;
    double number = 0;
    IdPattern id;
    TypePattern type;
    std::string text;  ///< in lower case; * matches any letters
  };

 private:
  friend class FilterParser;
  enum class Kind : std::uint8_t { comparison, negation, conjunction, disjunction };
  /// Operands are other nodes. In a comparison, `left` is its index in the list of comparisons.
  struct Node {
    Kind kind;
    std::size_t left = 0;
    std::size_t right = 0;
  };

  [[nodiscard]] bool evaluate(std::size_t node, const FilterSubject& subject) const;
  [[nodiscard]] bool holds(const Comparison& comparison, const FilterSubject& subject) const;

  std::vector<Node> nodes_;  // the last one is the root
  std::deque<Comparison> comparisons_;
  std::deque<FieldComparison> tables_;
};

/// Names and descriptions of the fields of the list, for help: "kind  kind of the entity: platform,
/// ...".
[[nodiscard]] std::string filter_fields_text();

/// The fields of one PDU type in the field tables, one per line, named as in --full.
/// @throws UsageError for a word that is no PDU type.
[[nodiscard]] std::string table_fields_text(std::string_view type);
/// The types that table_fields_text() takes: "entity_state fire ", a space after each.
[[nodiscard]] std::string types_with_fields();

}  // namespace reckon::tools
