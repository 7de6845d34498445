// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// A file of lines that are written while something runs.
#pragma once

#include <cstdio>
#include <filesystem>
#include <memory>
#include <string>
#include <string_view>

namespace reckon::tools {

/// A CSV file that is open; one that stands there already is replaced.
class CsvOutput {
 public:
  /// @param header without line end  @throws UsageError where the file cannot be written.
  CsvOutput(const std::filesystem::path& file, std::string_view header);

  /// @param line with its end
  void write(std::string_view line);
  /// Writes what is left. @throws EnvironmentError where the disk is full.
  void close();

 private:
  std::string name_;
  std::unique_ptr<std::FILE, int (*)(std::FILE*)> file_;
};

}  // namespace reckon::tools
