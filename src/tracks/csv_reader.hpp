// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Rows of numbers from a CSV file with a header, one at a time: RFC 4180 with its quotes, any line
// ends. Errors are reported with file, line and column.
//
//   CsvReader csv("hand.csv");
//   const auto time = csv.find("t_s");
//   while (time && csv.next()) std::printf("%g\n", csv.required(*time));
#pragma once

#include <array>
#include <cstddef>
#include <filesystem>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "reckon/haptics/input_files/input_file.hpp"

namespace reckon::peer {

/// The file cannot be read, or is no valid table; the text has the place and the remedy.
struct CsvError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// Reads a regular file once from begin to end; its memory is the length of the longest row. One
/// thread.
class CsvReader {
 public:
  /// Longest row [octets]; a file with a longer one is no valid table.
  static constexpr std::size_t kLongestRow = std::size_t{1} << 20;

  static constexpr std::size_t kMostColumns = 4096;

  /// Reads the header.
  /// @throws CsvError if the file cannot be read, has no header or more than 128 MiB.
  explicit CsvReader(const std::filesystem::path& path);

  /// Names of the columns in lower case, without blanks around them.
  [[nodiscard]] const std::vector<std::string>& columns() const noexcept { return columns_; }
  /// Place of the column `name`, or nothing.
  [[nodiscard]] std::optional<std::size_t> find(std::string_view name) const;

  /// Reads the next row that is not empty; false at the end. Charges it to haptics::LoadBudget.
  /// @throws CsvError if it has more or fewer cells than the header, an unclosed quote, or if the
  /// tables of one scene have too many rows.
  [[nodiscard]] bool next();

  /// Text of a cell of this row, without blanks around it. `column` < columns().size().
  [[nodiscard]] std::string_view text(std::size_t column) const noexcept;
  /// A finite number; nothing for an empty cell. @throws CsvError for anything else.
  [[nodiscard]] std::optional<double> number(std::size_t column) const;
  /// The same, but an empty cell is an error too.
  [[nodiscard]] double required(std::size_t column) const;

  /// @throws CsvError "file:line:column: what".
  [[noreturn]] void fail(std::size_t column, std::string_view what) const;

 private:
  struct Cell {
    std::size_t begin = 0, end = 0;  // in row_
    std::size_t column = 1;          // of its first character in the line, from 1
  };
  static haptics::InputFile opened(const std::filesystem::path& file);

  void charge_row() const;
  int letter();
  int peek();
  /// One record into row_ and cells_; false at the end of the file.
  bool read_record();
  void read_cell(int& stop);
  void read_quoted();
  void keep(int octet);

  std::string name_;
  haptics::InputFile file_;
  std::array<char, 65536> buffer_{};
  std::size_t at_ = 0, filled_ = 0;
  std::size_t line_ = 1, column_ = 0;  // of the last character read
  std::size_t row_line_ = 1;
  std::string row_;
  std::vector<Cell> cells_;
  std::vector<std::string> columns_;
};

}  // namespace reckon::peer
