// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Moves a recorded exercise: other exercise numbers, other entity IDs, another place on the earth.
// The PDUs keep their lengths; the field tables locate IDs and places.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <unordered_map>
#include <vector>

#include "reckon/tools/captures/id_map.hpp"
#include "reckon/tools/captures/pdu_map.hpp"
#include "reckon/tools/captures/place_shift.hpp"
#include "reckon/tools/command_line/command_line.hpp"

namespace reckon::tools {

/// The options as typed.
struct ExerciseMapOptions {
  std::vector<std::string> exercises;  ///< "1=7", or "7" for all
  std::vector<std::string> ids;        ///< "1:2:*=9:2:*"
  std::string place;                   ///< "48.1,11.6=34.0,-118.2", or "34.0,-118.2"

  void declare(CommandLine& line);
};

/// Numbers of PDUs by result.
struct ExerciseMapCounts {
  std::uint64_t mapped = 0;    ///< all fields that the tables name
  std::uint64_t octets = 0;    ///< of these, with records without a field table
  std::uint64_t places = 0;    ///< of these, with a place that cannot be moved
  std::uint64_t ids = 0;       ///< of these, with a short ID that is too small for the new one
  std::uint64_t untabled = 0;  ///< types without a field table: only the exercise
  std::uint64_t broken = 0;    ///< damaged or sealed: at most the exercise
};

/// The map. One thread. Stores the axes of at most 65,536 entities, for their Entity State Updates.
class ExerciseMap {
 public:
  /// @param lenient treats a length field of 0, which stays 0, as the rest of the datagram
  /// @throws UsageError with the word and the remedy.
  explicit ExerciseMap(const ExerciseMapOptions& options, bool lenient = false);

  [[nodiscard]] bool is_active() const {
    return maps_exercise_ || !ids_.empty() || request_.has_value();
  }
  /// Maps all PDUs of a datagram in place. Accepts any octets.
  void apply(std::span<std::byte> datagram);
  [[nodiscard]] const ExerciseMapCounts& counts() const { return counts_; }
  /// Lines for the user: mapped and unchanged PDUs; empty without a map.
  [[nodiscard]] std::string summary() const;

 private:
  void apply_to_all(std::span<std::byte> datagram);
  void parse_exercise(const std::string& text);
  void apply_to_pdu(std::span<std::byte> octets, const pdu::PduHeader& header);
  void count(const MappedPdu& done);
  [[nodiscard]] bool has_body_axes(std::span<const std::byte> octets, const pdu::PduHeader& header);

  std::array<std::uint8_t, 256> exercise_;
  bool lenient_;
  bool maps_exercise_ = false;
  IdMap ids_;
  std::optional<ShiftRequest> request_;
  std::optional<PlaceShift> shift_;  // set at the first place
  std::unordered_map<std::uint64_t, bool> body_axes_;
  ExerciseMapCounts counts_;
};

}  // namespace reckon::tools
