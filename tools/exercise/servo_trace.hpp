// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Writes every servo step as a CSV line, for plots and to reproduce a run.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>

#include "reckon/haptics/exchange/servo_types.hpp"
#include "reckon/tools/exercise/csv_output.hpp"

namespace reckon::tools {

/// A CSV file with a header line; SI units, scene frame.
class ServoTrace {
 public:
  /// @param turns with columns of torque, orientation and turn rate
  /// @throws UsageError if the file cannot be written.
  explicit ServoTrace(const std::filesystem::path& file, bool turns = false);

  /// @param peer, device numbered from 0; from 1 in the file
  /// @param pace of the peer's bodies, see haptics::BodyWorld::set_pace(); 1 without bodies
  void write(std::size_t peer, std::size_t device, double pace,
             const haptics::ServoSnapshot& step);
  /// As CsvOutput::close().
  void close() { file_.close(); }

 private:
  bool turns_;
  CsvOutput file_;
  std::string line_;
};

}  // namespace reckon::tools
