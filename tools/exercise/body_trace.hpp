// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Every step of every body as a line of CSV.
#pragma once

#include <cstdio>
#include <filesystem>
#include <string>
#include <vector>

#include "reckon/haptics/bodies/body_world.hpp"
#include "reckon/haptics/scene/scene.hpp"

namespace reckon::tools {

/// A CSV file with a header line; SI units, scene frame. A body that sleeps has no lines.
class BodyTrace {
 public:
  /// @throws UsageError where the file cannot be written, or the scene has nothing that moves.
  BodyTrace(const std::filesystem::path& file, const haptics::Scene& scene);
  ~BodyTrace();
  BodyTrace(const BodyTrace&) = delete;
  BodyTrace& operator=(const BodyTrace&) = delete;

  void write(const haptics::BodyStep& step);
  /// Writes what is left. @throws EnvironmentError where the disk is full.
  void close();

 private:
  std::string name_;
  std::vector<std::string> objects_;  // their names, as CSV
  std::string line_;
  std::FILE* file_;
};

}  // namespace reckon::tools
