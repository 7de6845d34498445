// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Writes every step of every body as a CSV line.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "reckon/haptics/bodies/body_world.hpp"
#include "reckon/haptics/scene/scene.hpp"
#include "reckon/tools/exercise/csv_output.hpp"

namespace reckon::tools {

/// A CSV file with a header line; SI units, scene frame. A sleeping body has no lines.
class BodyTrace {
 public:
  /// @throws UsageError if the file cannot be written, or nothing in the scene moves.
  BodyTrace(const std::filesystem::path& file, const haptics::Scene& scene);

  void write(const haptics::BodyStep& step);
  /// As CsvOutput::close().
  void close() { file_.close(); }

 private:
  std::vector<std::string> objects_;  // names, as CSV
  CsvOutput file_;
  std::string line_;
};

}  // namespace reckon::tools
