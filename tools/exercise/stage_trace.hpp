// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Writes every stage of every pass of the model loops as a CSV line.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>

#include "reckon/peer/loops/loop_trace.hpp"
#include "reckon/tools/exercise/csv_output.hpp"

namespace reckon::tools {

/// A CSV file with a header line; a peer's stages are in the order in which they ran.
class StageTrace {
 public:
  /// @throws UsageError if the file cannot be written.
  explicit StageTrace(const std::filesystem::path& file);

  /// @param peer numbered from 0; from 1 in the file
  void write(std::size_t peer, const peer::LoopStep& step);
  /// As CsvOutput::close().
  void close() { file_.close(); }

 private:
  CsvOutput file_;
  std::string line_;
};

}  // namespace reckon::tools
