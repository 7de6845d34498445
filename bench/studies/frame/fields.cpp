// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/bench/studies/frame/fields.hpp"

#include <cmath>

#include "reckon/bench/plots/sortable_page.hpp"
#include "reckon/tools/terminal/json_text.hpp"

namespace reckon::bench {
namespace {

void append_csv(std::string& line, std::string_view text, bool first) {
  if (!first) line += ',';
  line += text;
}

}  // namespace

Value::Value(std::optional<double> number)
    : json(number && std::isfinite(*number) ? fmt::format("{}", *number) : "null"),
      csv(number ? fmt::format("{}", *number) : "") {}

Value::Value(std::string_view word) : csv(word) { tools::append_json_string(json, word); }

Value::Value(const Fields& object) : json(object.object()) {}

Value Value::decimals(std::optional<double> number, int count) {
  Value value(std::optional<double>{});
  if (number) value.json = value.csv = fmt::format("{:.{}f}", *number, count);
  return value;
}

Value Value::quoted(std::string_view text) {
  Value value(text);
  value.csv = csv_quoted(text);
  return value;
}

Value Value::raw(std::string json) {
  Value value(std::optional<double>{});
  value.json = std::move(json);
  return value;
}

std::string csv_quoted(std::string_view text) {
  std::string out = "\"";
  for (const char letter : text) out.append(letter == '"' ? 2 : 1, letter);
  return out + '"';
}

std::string csv_cell(std::string_view text) {
  return text.find_first_of(",\"\r\n") == text.npos ? std::string(text) : csv_quoted(text);
}

Fields& Fields::value(std::string_view name, const Value& value) {
  return json(name, value).csv(name, value);
}

Fields& Fields::json(std::string_view name, const Value& value) {
  json_ += fmt::format("{}\"{}\":{}", json_.empty() ? "" : ",", name, value.json);
  return *this;
}

Fields& Fields::csv(std::string_view name, const Value& value) {
  const bool first = csv_names_.empty();
  append_csv(csv_names_, name, first);
  append_csv(csv_values_, value.csv, first);
  return *this;
}

Fields& Fields::cell(std::string title, std::string text) {
  columns_.push_back({std::move(title), tools::TextTable::Align::right});
  cells_.push_back(std::move(text));
  return *this;
}

Fields& Fields::word(std::string_view title, std::string_view text) {
  columns_.push_back({std::string(title)});
  cells_.emplace_back(text);
  return *this;
}

Fields& Fields::page(std::string_view title, double by, const std::string& html) {
  page_titles_ += fmt::format("<th>{}</th>", title);
  page_cells_.push_back(page_cell(by, html));
  return *this;
}

Fields& Fields::page_word(std::string_view title, const std::string& html) {
  page_titles_ += fmt::format("<th class=\"w\">{}</th>", title);
  page_cells_.push_back(fmt::format("<td class=\"w\">{}</td>", html));
  return *this;
}

Fields& Fields::shown(std::string title, std::string_view page_title, double by,
                      const std::string& text) {
  return cell(std::move(title), text).page(page_title, by, text);
}

Fields& Fields::instead(std::size_t first, std::string_view text) {
  cells_.resize(first);
  cells_.emplace_back(text);
  return *this;
}

Fields& Fields::page_instead(std::size_t first, std::string_view html) {
  const std::size_t wide = page_cells_.size() - first;
  page_cells_.resize(first);
  page_cells_.push_back(fmt::format("<td class=\"w\" colspan=\"{}\">{}</td>", wide, html));
  return *this;
}

std::string Fields::page_cells() const {
  std::string out;
  for (const std::string& cell : page_cells_) out += cell;
  return out;
}

}  // namespace reckon::bench
