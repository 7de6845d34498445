// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Every step of every body as a line of CSV.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "reckon/haptics/bodies/body_world.hpp"
#include "reckon/haptics/scene/scene.hpp"
#include "reckon/tools/exercise/csv_output.hpp"

namespace reckon::tools {

/// A CSV file with a header line; SI units, scene frame. A body that sleeps has no lines.
class BodyTrace {
 public:
  /// @throws UsageError where the file cannot be written, or the scene has nothing that moves.
  BodyTrace(const std::filesystem::path& file, const haptics::Scene& scene);

  void write(const haptics::BodyStep& step);
  /// As CsvOutput::close().
  void close() { file_.close(); }

 private:
  std::vector<std::string> objects_;  // their names, as CSV
  CsvOutput file_;
  std::string line_;
};

}  // namespace reckon::tools
