// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Pictures of one connection as differences: the server knows what the page shows, and sends what
// differs from the world by more than half a quantum. The page moves each entity on by its last
// velocity, so uniform motion costs nothing. docs/viewer_protocol.md defines the layout.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "reckon/tools/viewer/protocol/picture.hpp"

namespace reckon::tools {

inline constexpr std::uint32_t kDifferenceMagic = 0x34564B52;  ///< "RKV4"
/// Bit of the flags in the head: begins with no entity, does not depend on earlier pictures.
inline constexpr std::uint16_t kDifferenceWhole = 16;
inline constexpr std::size_t kDifferenceHead = kPictureHead + 4;

/// An entity as differences compare it: the part of the work that pages share.
struct SteadyEntity {
  std::array<double, 3> position{}, shown{};  ///< finite [m]
  std::array<double, 3> velocity{};           ///< finite [m/s]
  std::int64_t updated_ms = 0;
  std::array<std::int16_t, 4> turn{};
  std::uint16_t cell = 0, group = 0, rate = 0, jump = 0;
  std::uint16_t slot = kNoNumber;
  std::uint8_t side = 0, cause = 0;
  bool is_right = false;  ///< shown is predicted
};
/// Replaces `out`. Cost: linear in the entities, once for all live tabs.
void steady_entities(const PictureRows& rows, std::vector<SteadyEntity>& out);

/// Encodes the pictures of one connection. Holds 104 octets for each slot up to the highest one
/// that it has sent. Cost of a picture: 8 ns an entity, and 6 to 26 ns for each that changes.
class PictureDifference {
 public:
  /// A picture of at most kFineEntities has the finer quantum [m]: a power of two. Three axes of
  /// half a quantum are 0.85 mm and 7 um.
  static constexpr std::size_t kFineEntities = 512;
  static constexpr int kCoarse = 10, kFine = 17;  ///< negative exponents
  /// A velocity unit is this many quanta a second.
  static constexpr double kVelocityQuanta = 0.5;
  /// A rate of updates is sent if it differs by more than one part in so many.
  static constexpr int kRateParts = 64;
  /// Longest record of an entity [octets].
  static constexpr std::size_t kLongestRecord = 128;

  struct Options {
    std::uint32_t number = 0;
    std::optional<std::uint16_t> own_hand;  ///< gets kHandYours
    bool whole = false;  ///< send a whole picture, as after a leap in time
  };
  /// Encodes the next picture. @param entities of `rows`, by rising slot, none twice
  /// @param room memory for the result, which grows if it has to  @return the octets, in `room`
  [[nodiscard]] std::string_view encode(const PictureRows& rows,
                                        std::span<const SteadyEntity> entities,
                                        const Options& options, std::string& room);

 private:
  using Triple = std::array<double, 3>;
  /// An entity as the page has it.
  struct Known {
    Triple position{};           // [m]
    Triple velocity{}, error{};  // whole numbers: of velocity units, and of quanta
    std::int64_t updated_ms = 0;
    std::array<std::int16_t, 4> turn{};
    std::uint16_t cell = 0, group = 0, rate = 0, jump = 0;
    std::uint8_t side = 0, cause = 0;
    bool is_shown = false;
  };

  class Record;
  void begin(double time, std::span<const SteadyEntity> entities, bool whole);
  void write_records(std::span<const SteadyEntity> entities, OctetWriter& out);

  double quantum_ = 0;  // [m]
  int exponent_ = 0;
  double time_ = 0;                   // of the last picture [s]
  double step_ = 0;                   // from a velocity to the way since the last picture
  std::vector<Known> known_;          // by slot
  std::vector<std::uint16_t> shown_;  // slots of the last picture, rising
  std::uint16_t records_ = 0;
};

}  // namespace reckon::tools
