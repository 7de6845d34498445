// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// One row of a study's results, described once for table, JSON Lines, CSV and page.
//
//   Fields fields_of(const Row& row) {
//     return Fields("setting").value("error_m", row.error).cell("ERROR", length_text(row.error));
//   }
//   csv_of(rows, fields_of), json_of(rows, fields_of), table_of(rows, fields_of);
#pragma once

#include <fmt/format.h>

#include <concepts>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "reckon/tools/terminal/text_table.hpp"

namespace reckon::bench {

class Fields;

/// A value in the form of JSON and CSV. JSON has null for no value and for one that is not finite.
struct Value {
  std::string json, csv;

  Value(double number) : Value(std::optional(number)) {}
  /// Empty in CSV if there is no number.
  Value(std::optional<double> number);
  Value(bool is) : json(is ? "true" : "false"), csv(is ? "1" : "0") {}
  template <std::integral T>
  Value(T number) : json(fmt::format("{}", number)), csv(json) {}
  /// A word without commas and quotes.
  Value(std::string_view word);
  Value(const std::string& word) : Value(std::string_view(word)) {}
  Value(const char* word) : Value(std::string_view(word)) {}
  /// An object in JSON, nothing in CSV.
  Value(const Fields& object);

  /// With this number of decimals; null and empty if there is no number.
  [[nodiscard]] static Value decimals(std::optional<double> number, int count);
  /// Any text; quoted in CSV.
  [[nodiscard]] static Value quoted(std::string_view text);
  /// Text that is already JSON; empty in CSV.
  [[nodiscard]] static Value raw(std::string json);
  /// An array of objects in JSON; empty in CSV.
  template <class Rows, class Of>
  [[nodiscard]] static Value array(const Rows& rows, Of&& fields_of) {
    std::string all;
    for (const auto& row : rows) all += (all.empty() ? "" : ",") + fields_of(row).object();
    return raw('[' + all + ']');
  }
};

/// `text` within quotes, quotes doubled (RFC 4180).
[[nodiscard]] std::string csv_quoted(std::string_view text);
/// The same if the text contains a comma, quote or line end, else unchanged.
[[nodiscard]] std::string csv_cell(std::string_view text);

/// The fields of one row. Each function appends to the outputs that it names, in call order.
class Fields {
 public:
  Fields() = default;
  /// @param kind of the JSON object
  explicit Fields(std::string_view kind) { json("kind", kind); }

  /// In JSON and in CSV.
  Fields& value(std::string_view name, const Value& value);
  Fields& json(std::string_view name, const Value& value);
  Fields& csv(std::string_view name, const Value& value);

  /// A cell of the table: numbers are right-aligned, words left-aligned.
  Fields& cell(std::string title, std::string text);
  Fields& word(std::string_view title, std::string_view text);
  /// A cell of the page's table. @param by sort key of the column @param html escaped already
  Fields& page(std::string_view title, double by, const std::string& html);
  Fields& page_word(std::string_view title, const std::string& html);
  /// A number of table and page.
  Fields& shown(std::string title, std::string_view page_title, double by, const std::string& text);
  /// A word of table and page. @param text without characters that HTML escapes
  Fields& shown_word(std::string_view title, std::string_view page_title, const std::string& text) {
    return word(title, text).page_word(page_title, text);
  }

  /// Replaces all cells of the table from number `first` on by `text`.
  Fields& instead(std::size_t first, std::string_view text);
  /// The same in the page, as one cell of the same width.
  Fields& page_instead(std::size_t first, std::string_view html);

  /// "{..}"
  [[nodiscard]] std::string object() const { return "{" + json_ + "}"; }
  [[nodiscard]] std::string line() const { return object() + '\n'; }
  [[nodiscard]] const std::string& csv_names() const noexcept { return csv_names_; }
  [[nodiscard]] const std::string& csv_values() const noexcept { return csv_values_; }
  [[nodiscard]] const std::vector<tools::TextTable::Column>& columns() const { return columns_; }
  [[nodiscard]] const std::vector<std::string>& cells() const noexcept { return cells_; }
  [[nodiscard]] const std::string& page_titles() const noexcept { return page_titles_; }
  [[nodiscard]] std::string page_cells() const;

 private:
  std::string json_, csv_names_, csv_values_, page_titles_;
  std::vector<tools::TextTable::Column> columns_;
  std::vector<std::string> cells_, page_cells_;
};

/// A header line, then a line for each row. @param fields_of fields of a row; the header comes from
/// an empty row
template <class Rows, class Of>
[[nodiscard]] std::string csv_of(const Rows& rows, Of&& fields_of) {
  std::string out = fields_of(typename Rows::value_type{}).csv_names() + '\n';
  for (const auto& row : rows) out += fields_of(row).csv_values() + '\n';
  return out;
}

/// One object a line.
template <class Rows, class Of>
[[nodiscard]] std::string json_of(const Rows& rows, Of&& fields_of) {
  std::string out;
  for (const auto& row : rows) out += fields_of(row).line();
  return out;
}

/// Titles, then one line a row.
template <class Rows, class Of>
[[nodiscard]] std::string table_of(const Rows& rows, Of&& fields_of) {
  tools::TextTable table(fields_of(typename Rows::value_type{}).columns());
  for (const auto& row : rows) table.add(fields_of(row).cells());
  return table.text();
}

/// The JSON Lines or the table.
template <class Rows, class Of>
[[nodiscard]] std::string lines_of(bool json, const Rows& rows, Of&& fields_of) {
  return json ? json_of(rows, fields_of) : table_of(rows, fields_of);
}

struct NoneBeaten {
  bool operator()(const auto& /*row*/) const { return false; }
};

/// A table of a page; rows with `is_beaten` are marked as dominated.
template <class Rows, class Of, class Beaten = NoneBeaten>
[[nodiscard]] std::string page_table_of(const Rows& rows, Of&& fields_of,
                                        const Beaten& is_beaten = {}) {
  std::string out =
      fmt::format("<div class=\"wide\"><table>\n<thead><tr>{}</tr></thead>\n<tbody>\n",
                  fields_of(typename Rows::value_type{}).page_titles());
  for (const auto& row : rows)
    out += fmt::format("<tr{}>{}</tr>\n", is_beaten(row) ? " class=\"d\"" : "",
                       fields_of(row).page_cells());
  return out + "</tbody></table></div>\n";
}

}  // namespace reckon::bench
