// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/peer/tracks/csv_reader.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>

#include "reckon/haptics/input_files/load_budget.hpp"

namespace reckon::peer {
namespace {

constexpr int kEnd = -1;

// The part of a cell that a message shows.
std::string shown(std::string_view text) {
  constexpr std::size_t kMost = 24;
  std::string out;
  for (const char letter : text.substr(0, kMost)) {
    const auto octet = static_cast<unsigned char>(letter);
    out += octet < 0x20 || octet > 0x7E ? '?' : letter;
  }
  return text.size() > kMost ? out + "..." : out;
}

}  // namespace

haptics::InputFile CsvReader::opened(const std::filesystem::path& file) try {
  return {file, haptics::kMostTableOctets};
} catch (const std::invalid_argument& error) {
  throw CsvError(fmt::format("{}: {}", file.string(), error.what()));
}

CsvReader::CsvReader(const std::filesystem::path& path)
    : name_(path.string()), file_(opened(path)) {
  constexpr std::string_view kMark = "\xEF\xBB\xBF";
  if (peek() != kEnd && std::string_view(buffer_.data(), filled_).starts_with(kMark))
    at_ = kMark.size();
  if (!read_record()) throw CsvError(fmt::format("{} is empty", name_));
  for (std::size_t i = 0; i < cells_.size(); ++i) {
    std::string name(text(i));
    for (char& letter : name)
      letter = static_cast<char>(std::tolower(static_cast<unsigned char>(letter)));
    columns_.push_back(std::move(name));
  }
}

std::optional<std::size_t> CsvReader::find(std::string_view name) const {
  const auto found = std::find(columns_.begin(), columns_.end(), name);
  if (found == columns_.end()) return std::nullopt;
  return static_cast<std::size_t>(found - columns_.begin());
}

bool CsvReader::next() {
  while (read_record()) {
    if (cells_.size() == 1 && text(0).empty()) continue;
    if (cells_.size() == columns_.size()) {
      charge_row();
      return true;
    }
    fail(
        cells_.size() - 1,
        fmt::format("{} cells, but the header has {}; give every row as many, including empty ones",
                    cells_.size(), columns_.size()));
  }
  return false;
}

void CsvReader::charge_row() const try {
  haptics::LoadBudget::take(haptics::LoadWork::rows, 1);
} catch (const haptics::LoadLimitError& error) {
  fail(0, error.what());
}

std::string_view CsvReader::text(std::size_t column) const noexcept {
  const Cell& cell = cells_[column];
  std::string_view text = std::string_view(row_).substr(cell.begin, cell.end - cell.begin);
  const auto blank = [](char letter) { return letter == ' ' || letter == '\t'; };
  while (!text.empty() && blank(text.front())) text.remove_prefix(1);
  while (!text.empty() && blank(text.back())) text.remove_suffix(1);
  return text;
}

std::optional<double> CsvReader::number(std::size_t column) const {
  std::string_view cell = text(column);
  if (cell.empty()) return std::nullopt;
  if (cell.front() == '+') cell.remove_prefix(1);
  double value = 0;
  const auto [end, error] = std::from_chars(cell.data(), cell.data() + cell.size(), value);
  const bool whole = error == std::errc{} && end == cell.data() + cell.size();
  if (!whole || !std::isfinite(value))
    fail(column, fmt::format("{} '{}' is not a finite number; write it as 12.5 or leave it empty",
                             columns_[column], shown(text(column))));
  return value;
}

double CsvReader::required(std::size_t column) const {
  const std::optional<double> value = number(column);
  if (!value) fail(column, fmt::format("{} is empty; every row needs it", columns_[column]));
  return *value;
}

void CsvReader::fail(std::size_t column, std::string_view what) const {
  throw CsvError(fmt::format("{}:{}:{}: {}", name_, row_line_, cells_.at(column).column, what));
}

int CsvReader::peek() {
  if (at_ == filled_) {
    at_ = 0;
    try {
      filled_ = file_.read(buffer_);
    } catch (const std::invalid_argument& error) {
      throw CsvError(fmt::format("{}: after line {} it {}", name_, line_, error.what()));
    }
    if (filled_ == 0) return kEnd;
  }
  return static_cast<unsigned char>(buffer_[at_]);
}

int CsvReader::letter() {
  const int octet = peek();
  if (octet == kEnd) return octet;
  ++at_;
  ++column_;
  return octet;
}

void CsvReader::keep(int octet) {
  if (row_.size() >= kLongestRow)
    throw CsvError(fmt::format("{}:{}: the row is longer than {} octets; this is not a CSV table",
                               name_, row_line_, kLongestRow));
  row_ += static_cast<char>(octet);
}

void CsvReader::read_quoted() {
  for (;;) {
    const int octet = letter();
    if (octet == kEnd)
      throw CsvError(fmt::format("{}:{}: a quote opens here and is not closed", name_, row_line_));
    if (octet == '"' && peek() != '"') return;
    if (octet == '"') (void)letter();
    if (octet == '\n') {
      ++line_;
      column_ = 0;
    }
    keep(octet);
  }
}

// @param stop the comma, the end of the line or of the file after the cell.
void CsvReader::read_cell(int& stop) {
  while (peek() == ' ') (void)letter();
  Cell cell{row_.size(), row_.size(), column_ + 1};
  if (peek() == '"') {
    (void)letter();
    read_quoted();
  }
  for (stop = letter(); stop != ',' && stop != '\n' && stop != '\r' && stop != kEnd;
       stop = letter())
    keep(stop);
  cell.end = row_.size();
  if (cells_.size() == kMostColumns)
    throw CsvError(fmt::format("{}:{}: more than {} columns; this is not a table of tracks", name_,
                               row_line_, kMostColumns));
  cells_.push_back(cell);
}

bool CsvReader::read_record() {
  row_.clear();
  cells_.clear();
  row_line_ = line_;
  column_ = 0;
  if (peek() == kEnd) return false;
  int stop = ',';
  while (stop == ',') read_cell(stop);
  if (stop == '\r' && peek() == '\n') (void)letter();
  ++line_;
  return true;
}

}  // namespace reckon::peer
