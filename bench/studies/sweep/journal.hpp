// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The results of a sweep in a CSV file that grows with each of them, so that one that was cut off
// goes on.
#pragma once

#include <cstddef>
#include <cstdio>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace reckon::bench {

/// First line "# STUDY: OPTIONS", second the names of the columns, then a line for each result as
/// it comes. A last line that was cut off is dropped. One process writes at a time.
class SweepJournal {
 public:
  /// Opens the file, or begins it. @param path empty: nothing is kept  @param options "name=value"
  /// with "; " between: what results depend on
  /// @throws UsageError where the file cannot be written, is none of this study, or has other
  /// options: the first that differs is named
  SweepJournal(std::string path, std::string_view study, std::string_view options,
               std::string_view columns);
  ~SweepJournal();
  SweepJournal(const SweepJournal&) = delete;
  SweepJournal& operator=(const SweepJournal&) = delete;

  /// Whole lines that were there, without their ends.
  [[nodiscard]] const std::vector<std::string>& found() const noexcept { return found_; }
  /// One result, without the end of the line. Not from two threads at once. @throws UsageError
  /// where the disk takes no more
  void append(const std::string& line);
  /// Replaces all results by these, at once: whoever looks sees the old file or the new.
  void finish(const std::vector<std::string>& lines);

 private:
  void read();
  void begin();

  std::string path_, header_, columns_;
  std::vector<std::string> found_;
  std::unique_ptr<std::FILE, int (*)(std::FILE*)> file_;
};

}  // namespace reckon::bench
