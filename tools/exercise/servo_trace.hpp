// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Every servo step as a line of CSV, for plots and for reproducing a run.
#pragma once

#include <cstdio>
#include <filesystem>
#include <string>

#include "reckon/haptics/exchange/servo_types.hpp"

namespace reckon::tools {

/// A CSV file with a header line; SI units, scene frame.
class ServoTrace {
 public:
  /// @param turns with columns of torque, orientation and turn rate
  /// @throws UsageError where the file cannot be written.
  explicit ServoTrace(const std::filesystem::path& file, bool turns = false);
  ~ServoTrace();
  ServoTrace(const ServoTrace&) = delete;
  ServoTrace& operator=(const ServoTrace&) = delete;

  /// @param peer, device numbered from 0; from 1 in the file
  void write(std::size_t peer, std::size_t device, const haptics::ServoSnapshot& step);
  /// Writes what is left. @throws EnvironmentError where the disk is full.
  void close();

 private:
  std::string name_;
  bool turns_;
  std::string line_;
  std::FILE* file_;
};

}  // namespace reckon::tools
