// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/tools/terminal/text_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>

namespace reckon::tools {
namespace {

constexpr std::string_view kGap = "  ";

void append_cell(std::string& line, std::string_view cell, std::size_t width,
                 TextTable::Align align) {
  const std::size_t padding = width - text_width(cell);
  if (align == TextTable::Align::right) line.append(padding, ' ');
  line += cell;
  if (align == TextTable::Align::left) line.append(padding, ' ');
}

void end_line(std::string& line) {
  line.erase(line.find_last_not_of(' ') + 1);
  line += '\n';
}

}  // namespace

std::size_t text_width(std::string_view utf8) {
  return static_cast<std::size_t>(std::count_if(utf8.begin(), utf8.end(), [](char octet) {
    return (static_cast<unsigned char>(octet) & 0xC0U) != 0x80U;
  }));
}

std::string counted(std::uint64_t count, std::string_view noun) {
  return fmt::format("{} {}{}", count, noun, count == 1 ? "" : "s");
}

TextTable::TextTable(std::vector<Column> columns) : columns_(std::move(columns)) {}

void TextTable::add(std::vector<std::string> cells) {
  assert(cells.size() <= columns_.size());
  cells.resize(columns_.size());
  rows_.push_back(std::move(cells));
}

std::vector<std::size_t> TextTable::widths() const {
  std::vector<std::size_t> widths;
  for (const Column& column : columns_) widths.push_back(text_width(column.title));
  for (const auto& row : rows_) {
    for (std::size_t i = 0; i < row.size(); ++i)
      widths[i] = std::max(widths[i], text_width(row[i]));
  }
  return widths;
}

std::string TextTable::text() const {
  const std::vector<std::size_t> width = widths();
  std::string text;
  const auto add_line = [&](const auto& cell) {
    std::string line;
    for (std::size_t i = 0; i < columns_.size(); ++i) {
      if (i > 0) line += kGap;
      append_cell(line, cell(i), width[i], columns_[i].align);
    }
    end_line(line);
    text += line;
  };
  add_line([&](std::size_t i) -> std::string_view { return columns_[i].title; });
  for (const auto& row : rows_) add_line([&](std::size_t i) -> std::string_view { return row[i]; });
  return text;
}

void TextTable::print(std::FILE* out) const {
  const std::string all = text();
  std::fwrite(all.data(), 1, all.size(), out);
}

std::string cut_to(std::string_view utf8, std::size_t columns) {
  constexpr char kDelete = 127;
  std::string cut;
  std::size_t width = 0;
  for (const char octet : utf8) {
    const bool begins = (static_cast<unsigned char>(octet) & 0xC0U) != 0x80U;
    if (begins && ++width > columns) break;
    const bool is_control = (octet >= 0 && octet < ' ') || octet == kDelete;
    cut += is_control ? '.' : octet;
  }
  return cut;
}

std::vector<std::string> wrap(std::string_view utf8, std::size_t columns) {
  constexpr std::string_view kSetIn = "  ";
  std::vector<std::string> lines;
  std::string_view before;
  while (before.size() + text_width(utf8) > columns) {
    std::string line = cut_to(utf8, columns - before.size());
    const std::size_t space = utf8.substr(0, line.size() + 1).rfind(' ');
    const bool has_word = space != std::string_view::npos && space > 0;
    if (has_word) line.resize(space);
    utf8.remove_prefix(line.size() + (has_word ? 1 : 0));
    lines.push_back(std::string(before) + line);
    before = kSetIn;
  }
  lines.push_back(std::string(before) + cut_to(utf8, columns - before.size()));
  return lines;
}

std::string distance_text(double metres) {
  constexpr double kSmallest = 1e-5;
  if (!(metres >= kSmallest)) return "0";
  if (metres < 0.095) return fmt::format("{:.2g} mm", 1e3 * metres);
  if (metres < 9.95) return fmt::format("{:.2f} m", metres);
  if (metres < 9950) return fmt::format("{:.0f} m", metres);
  return fmt::format("{:.0f} km", 1e-3 * metres);
}

std::string angle_text(double degrees) {
  constexpr double kSmallest = 1e-3;
  if (!(degrees >= kSmallest)) return "0";
  return degrees < 9.95 ? fmt::format("{:.2g} deg", degrees) : fmt::format("{:.0f} deg", degrees);
}

std::string printable_text(std::string_view text) {
  std::string shown(text);
  std::replace_if(
      shown.begin(), shown.end(), [](char letter) { return letter < ' ' || letter > '~'; }, '.');
  return shown;
}

}  // namespace reckon::tools
