// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/tools/datagrams/filter.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <cmath>

#include "reckon/pdu/field_search.hpp"
#include "reckon/pdu/type_names.hpp"
#include "reckon/tools/command_line/command_line.hpp"
#include "reckon/tools/datagrams/filter_fields.hpp"

namespace reckon::tools {
namespace {

/// Entity fields can also be named by their last word: kind for entity.kind.
std::string_view short_name(std::string_view name) {
  constexpr std::string_view kEntity = "entity.";
  return name.starts_with(kEntity) ? name.substr(kEntity.size()) : name;
}

/// The last parts of a path, as many as `typed` has.
std::string_view end_of_path(std::string_view path, std::string_view typed) {
  std::size_t at = path.size();
  for (auto dots = std::count(typed.begin(), typed.end(), '.'); dots >= 0 && at != path.npos;
       --dots)
    at = at == 0 ? path.npos : path.rfind('.', at - 1);
  return at == path.npos ? path : path.substr(at + 1);
}

/// The field of the field tables nearest to a mistyped one; empty if none is near.
std::string nearest_table_field(std::string_view typed) {
  WordSearch search(typed);
  for (unsigned number = 0; number < 256; ++number) {
    const auto type = static_cast<pdu::PduType>(number);
    if (!pdu::is_listed(type)) continue;
    pdu::each_field_path(type,
                         [&](std::string_view path) { search.look_at(end_of_path(path, typed)); });
  }
  return search.nearest();
}

std::string text_with_mark(std::string_view text, std::size_t column, std::string_view why) {
  std::string shown(text);
  for (char& letter : shown) {
    if (letter < ' ' || letter > '~') letter = '.';
  }
  return fmt::format("--where, column {}: {}\n  {}\n  {:>{}}", column, why, shown, '^', column);
}

}  // namespace

FilterError::FilterError(std::string_view text, std::size_t column_, std::string_view why)
    : UsageError(text_with_mark(text, column_, why)), column(column_) {}

/// Recursive-descent parser of a filter.
class FilterParser {
 public:
  FilterParser(std::string_view text, Filter& filter) : text_(text), filter_(filter) {}

  void parse() {
    if (text_.size() > Filter::kLongest)
      fail(Filter::kLongest, fmt::format("a filter has at most {} characters", Filter::kLongest));
    advance();
    (void)disjunction();
    if (token_.kind == TokenKind::end) return;
    fail(token_.at,
         token_.text == ")" ? "no parenthesis is open here" : "expected 'and', 'or' or the end");
  }

 private:
  enum class TokenKind : std::uint8_t { word, quoted, sign, end };
  struct Token {
    TokenKind kind = TokenKind::end;
    std::string_view text;
    std::size_t at = 0;
  };
  using Kind = Filter::Kind;

  [[noreturn]] void fail(std::size_t at, std::string_view why) const {
    throw FilterError(text_, at + 1, why);
  }

  [[nodiscard]] static bool is_word_letter(char letter) {
    return std::isalnum(static_cast<unsigned char>(letter)) != 0 ||
           std::string_view("_.:*-+[]").find(letter) != std::string_view::npos;
  }

  void advance() {
    at_ = std::min(text_.find_first_not_of(" \t\r\n", at_), text_.size());
    const std::size_t begin = at_;
    if (begin == text_.size()) {
      token_ = {TokenKind::end, {}, begin};
    } else if (is_word_letter(text_[begin])) {
      while (at_ < text_.size() && is_word_letter(text_[at_])) ++at_;
      token_ = {TokenKind::word, text_.substr(begin, at_ - begin), begin};
    } else if (text_[begin] == '"' || text_[begin] == '\'') {
      quoted(begin);
    } else {
      sign(begin);
    }
  }
  void quoted(std::size_t begin) {
    const std::size_t end = text_.find(text_[begin], begin + 1);
    if (end == std::string_view::npos) fail(begin, "this quote is not closed");
    token_ = {TokenKind::quoted, text_.substr(begin + 1, end - begin - 1), begin};
    at_ = end + 1;
  }
  void sign(std::size_t begin) {
    constexpr std::array<std::string_view, 12> kSigns{"==", "!=", "<=", ">=", "&&", "||",
                                                      "=",  "!",  "<",  ">",  "(",  ")"};
    for (const std::string_view sign : kSigns) {
      if (!text_.substr(begin).starts_with(sign)) continue;
      token_ = {TokenKind::sign, text_.substr(begin, sign.size()), begin};
      at_ = begin + sign.size();
      return;
    }
    fail(begin, "unexpected character; put text in quotes");
  }
  /// Takes the token if it is one of these.
  [[nodiscard]] bool take(std::string_view word, std::string_view sign) {
    const bool is = (token_.kind == TokenKind::word && lower(token_.text) == word) ||
                    (token_.kind == TokenKind::sign && token_.text == sign);
    if (is) advance();
    return is;
  }

  std::size_t add(Kind kind, std::size_t left, std::size_t right = 0) {
    filter_.nodes_.push_back({kind, left, right});
    return filter_.nodes_.size() - 1;
  }
  std::size_t disjunction() {
    std::size_t left = conjunction();
    while (take("or", "||")) left = add(Kind::disjunction, left, conjunction());
    return left;
  }
  std::size_t conjunction() {
    std::size_t left = negation();
    while (take("and", "&&")) left = add(Kind::conjunction, left, negation());
    return left;
  }
  std::size_t negation() {
    const std::size_t at = token_.at;
    if (++depth_ > Filter::kDeepest)
      fail(at, fmt::format("nested more than {} deep", Filter::kDeepest));
    std::size_t node = 0;
    if (take("not", "!")) {
      node = add(Kind::negation, negation());
    } else if (take("(", "(")) {
      node = disjunction();
      if (!take(")", ")"))
        fail(token_.at, fmt::format("expected ')' for the parenthesis of column {}", at + 1));
    } else {
      node = comparison();
    }
    --depth_;
    return node;
  }

  std::size_t comparison() {
    if (token_.kind != TokenKind::word)
      fail(token_.at, "expected a field, for example kind == platform");
    const auto row = row_named(lower(token_.text));
    Filter::Comparison comparison;
    if (row.has_value()) {
      advance();
      comparison = with_row(*row);
    } else {
      comparison.field = with_table();
      comparison.of_table = true;
    }
    filter_.comparisons_.push_back(std::move(comparison));
    return add(Kind::comparison, filter_.comparisons_.size() - 1);
  }
  /// The row of the list with this name: `type` is the PDU type, not an abbreviation of
  /// entity.type.
  [[nodiscard]] static std::optional<std::size_t> row_named(std::string_view typed) {
    const auto rows = filter_fields();
    auto row = std::ranges::find(rows, typed, &FilterField::name);
    if (row == rows.end())
      row = std::ranges::find(rows, typed, [](const auto& of) { return short_name(of.name); });
    if (row == rows.end()) return std::nullopt;
    return static_cast<std::size_t>(row - rows.begin());
  }
  Filter::Comparison with_row(std::size_t row) {
    Filter::Comparison comparison;
    comparison.field = row;
    const FilterField& of = filter_fields()[row];
    const std::size_t at = token_.at;
    comparison.op = operation();
    const bool ordered = of.kind == ValueKind::number || of.kind == ValueKind::name;
    if (!ordered && comparison.op > Filter::Operator::unequal)
      fail(at, fmt::format("{} allows == and != only", of.name));
    value(of, comparison);
    return comparison;
  }
  /// A field of the field tables; returns its index among these.
  std::size_t with_table() {
    constexpr std::string_view kFields = "fields.";  // as in JSON, the whole path
    const std::string_view written = token_.text;
    const std::string typed = lower(written);
    const bool whole = typed.starts_with(kFields);
    auto path =
        pdu::FieldPath::find(std::string_view(typed).substr(whole ? kFields.size() : 0), whole);
    if (!path.has_value()) fail_unknown(typed);
    advance();
    const std::size_t at = token_.at;
    const Filter::Operator op = operation();
    if (op > Filter::Operator::unequal && !path->has_numbers())
      fail(at, fmt::format("{} allows == and != only", written));
    if (token_.kind == TokenKind::end || token_.kind == TokenKind::sign)
      fail(token_.at, fmt::format("expected a value of {}", written));
    FieldComparison comparison(std::move(*path), op, token_.text);
    if (const std::string why = comparison.misfit(); !why.empty()) fail(token_.at, why);
    advance();
    filter_.tables_.push_back(std::move(comparison));
    return filter_.tables_.size() - 1;
  }
  [[noreturn]] void fail_unknown(const std::string& typed) const {
    if (short_name(typed) == "force")
      fail(token_.at, fmt::format("there is no field '{}', forces are newtons; the force ID of an "
                                  "entity is '{}'",
                                  token_.text, typed == "force" ? "side" : "entity.side"));
    WordSearch search(typed);
    for (const FilterField& field : filter_fields()) {
      search.look_at(field.name);
      search.look_at(short_name(field.name));
    }
    search.look_at(nearest_table_field(typed));
    fail(token_.at,
         fmt::format("there is no field '{}'{}", token_.text,
                     suggestion(search.nearest(),
                                "; `reckon inspect --help` lists the fields of every PDU, `reckon "
                                "inspect --fields TYPE` the fields of a PDU type")));
  }

  Filter::Operator operation() {
    using Operator = Filter::Operator;
    struct Row {
      std::string_view sign;
      Operator op;
    };
    constexpr std::array kRows{Row{"==", Operator::equal},    Row{"=", Operator::equal},
                               Row{"!=", Operator::unequal},  Row{"<=", Operator::at_most},
                               Row{">=", Operator::at_least}, Row{"<", Operator::less},
                               Row{">", Operator::greater}};
    for (const Row& row : kRows) {
      if (token_.kind != TokenKind::sign || token_.text != row.sign) continue;
      advance();
      return row.op;
    }
    fail(token_.at, "expected ==, !=, <, <=, > or >=");
  }

  void value(const FilterField& field, Filter::Comparison& comparison) {
    if (token_.kind == TokenKind::end || token_.kind == TokenKind::sign)
      fail(token_.at, fmt::format("expected a value: {} is {}", field.name, field.meaning));
    if (field.kind == ValueKind::text)
      comparison.text = text_value(field);
    else if (field.kind == ValueKind::id)
      comparison.id = id_pattern();
    else if (field.kind == ValueKind::type)
      comparison.type = type_pattern();
    else if (const auto number = plain_number())
      comparison.number = *number;
    else if (field.kind == ValueKind::name)
      comparison.number = named_value(field);
    else
      fail(token_.at,
           fmt::format("'{}' is not a number: {} is {}", token_.text, field.name, field.meaning));
    advance();
  }
  [[nodiscard]] std::optional<double> plain_number() const {
    double number = 0;
    const char* end = token_.text.data() + token_.text.size();
    const auto result = std::from_chars(token_.text.data(), end, number);
    if (result.ec != std::errc{} || result.ptr != end || !std::isfinite(number))
      return std::nullopt;
    return number;
  }
  [[nodiscard]] double named_value(const FilterField& field) const {
    const std::string typed = word_of(token_.text);
    WordSearch search(typed);
    for (const auto name_of : {field.value_name, field.short_name}) {
      for (unsigned value = 0; name_of != nullptr && value < field.values; ++value) {
        const std::string_view name = name_of(value);
        if (name.empty()) continue;
        search.look_at(word_of(name));
        if (search.is_found()) return value;
      }
    }
    fail_unnamed(field, search.nearest());
  }
  [[noreturn]] void fail_unnamed(const FilterField& field, std::string_view nearest) const {
    fail(token_.at, fmt::format("{} has no value '{}'{}", field.name, token_.text,
                                suggestion(nearest, fmt::format("; it is {}", field.meaning))));
  }
  /// Text; if the field has a list of values, it must match one of them.
  [[nodiscard]] std::string text_value(const FilterField& field) const {
    std::string typed = lower(token_.text);
    if (field.value_name == nullptr) return typed;
    WordSearch search(token_.text);
    for (unsigned value = 0; value < field.values; ++value) {
      const std::string_view name = field.value_name(value);
      if (name.empty()) continue;
      if (is_like(lower(name), typed)) return typed;
      search.look_at(name);
    }
    fail_unnamed(field, search.nearest());
  }

  /// One part of an ID; `at` is its offset in the token.
  [[nodiscard]] std::optional<std::uint16_t> id_part(std::string_view part, std::size_t at) const {
    if (part == "*") return std::nullopt;
    std::uint16_t number = 0;
    const char* end = part.data() + part.size();
    const auto result = std::from_chars(part.data(), end, number);
    if (part.empty() || result.ec != std::errc{} || result.ptr != end)
      fail(token_.at + at, fmt::format("'{}' is neither * nor a number from 0 to 65535", part));
    return number;
  }
  /// "1:2:3" or "1-2-3"; parts may be *.
  [[nodiscard]] Filter::IdPattern id_pattern() const {
    const std::string_view text = token_.text;
    const std::size_t first = text.find_first_of(":-");
    const std::size_t second =
        first == std::string_view::npos ? first : text.find_first_of(":-", first + 1);
    if (second == std::string_view::npos)
      fail(token_.at, "an entity ID has three parts, for example 1:2:3 or 1:*:*");
    return {id_part(text.substr(0, first), 0),
            id_part(text.substr(first + 1, second - first - 1), first + 1),
            id_part(text.substr(second + 1), second + 1)};
  }

  [[nodiscard]] TypePattern type_pattern() const {
    const TypePatternText parsed = parse_type_pattern(token_.text);
    if (!parsed.error.empty()) fail(token_.at + parsed.at, parsed.error);
    return parsed.pattern;
  }

  std::string_view text_;
  Filter& filter_;
  std::size_t at_ = 0;
  Token token_;
  std::size_t depth_ = 0;
};

Filter::Filter(std::string_view text) { FilterParser(text, *this).parse(); }

}  // namespace reckon::tools
