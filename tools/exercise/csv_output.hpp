// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// A CSV file that is written during a run.
#pragma once

#include <cstdio>
#include <filesystem>
#include <memory>
#include <string>
#include <string_view>

namespace reckon::tools {

/// An open CSV file; an existing file is replaced.
class CsvOutput {
 public:
  /// @param header without line end  @throws UsageError if the file cannot be written.
  CsvOutput(const std::filesystem::path& file, std::string_view header);

  /// @param line with its line end
  void write(std::string_view line);
  /// Flushes the file. @throws EnvironmentError if the disk is full.
  void close();

 private:
  std::string name_;
  std::unique_ptr<std::FILE, int (*)(std::FILE*)> file_;
};

}  // namespace reckon::tools
