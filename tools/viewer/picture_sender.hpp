// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Pictures for one tab: differences, of which some are whole, or pictures for a saved file.
#pragma once

#include <chrono>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "reckon/tools/viewer/protocol/picture_difference.hpp"

namespace reckon::tools {

/// A picture before it is encoded, for all tabs that show its instant.
struct FilledPicture {
  PictureRows rows;                    ///< entities by rising slot
  std::vector<SteadyEntity> entities;  ///< of `rows`
  std::uint64_t tick = 0;              ///< in which it was filled
};

class PictureSender {
 public:
  /// A tab gets a picture that depends on no earlier one this often.
  static constexpr std::chrono::nanoseconds kWholeEvery = std::chrono::seconds(2);

  /// From now on each picture is as a saved file has it.
  void store() { difference_.reset(); }
  /// The next picture depends on no earlier one.
  void need_whole() { needs_whole_ = true; }
  /// @param now time of the stage  @param room memory that grows as it has to
  [[nodiscard]] std::shared_ptr<const std::string> encode(const FilledPicture& picture,
                                                          std::uint32_t number,
                                                          std::optional<std::uint16_t> own_hand,
                                                          std::chrono::nanoseconds now,
                                                          std::string& room);

 private:
  // Null: pictures are stored.
  std::unique_ptr<PictureDifference> difference_ = std::make_unique<PictureDifference>();
  bool needs_whole_ = true;
  std::chrono::nanoseconds next_whole_{};
};

}  // namespace reckon::tools
