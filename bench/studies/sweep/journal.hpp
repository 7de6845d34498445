// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The results of a sweep in a CSV file that grows with each result, so that an interrupted sweep
// can continue.
#pragma once

#include <cstddef>
#include <cstdio>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace reckon::bench {

/// First line "# STUDY: OPTIONS", second line the names of the columns, then a line for each
/// result. A partial last line is dropped. One process writes at a time.
class SweepJournal {
 public:
  /// Opens or creates the file. @param path empty: nothing is stored @param options "name=value"
  /// separated by "; ": the inputs that affect results
  /// @throws UsageError if the file cannot be written, belongs to another study, or has other
  ///     options; the message names the first that differs
  SweepJournal(std::string path, std::string_view study, std::string_view options,
               std::string_view columns);
  ~SweepJournal();
  SweepJournal(const SweepJournal&) = delete;
  SweepJournal& operator=(const SweepJournal&) = delete;

  /// Complete lines that were already in the file, without line ends.
  [[nodiscard]] const std::vector<std::string>& found() const noexcept { return found_; }
  /// Appends one result, without the end of the line. Not thread-safe. @throws UsageError if the
  /// disk is full
  void append(const std::string& line);
  /// Replaces all results by these, atomically: a reader sees the old file or the new one.
  void finish(const std::vector<std::string>& lines);

 private:
  void read();
  void begin();

  std::string path_, header_, columns_;
  std::vector<std::string> found_;
  std::unique_ptr<std::FILE, int (*)(std::FILE*)> file_;
};

}  // namespace reckon::bench
