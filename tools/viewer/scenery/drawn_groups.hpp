// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Near and contact groups of a scene, and its beacons, as drawn by a page.
#pragma once

#include <chrono>
#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <string>

#include "reckon/aoim/cells/cell_partition.hpp"
#include "reckon/peer/scene/scene_file.hpp"
#include "reckon/tools/viewer/history/received_groups.hpp"
#include "reckon/tools/viewer/history/roster.hpp"

namespace reckon::tools {

/// One thread; immutable.
class DrawnGroups {
 public:
  /// @throws std::invalid_argument if the scene's cells are invalid
  explicit DrawnGroups(const peer::SceneFile& scene);

  /// Whether a scene has any of these; without them there is no message.
  [[nodiscard]] static bool has_any(const peer::SceneFile& scene) noexcept;

  /// The message, as of `time`. A beacon is drawn in the cell of one of its owner's entities: where
  /// groups are assigned by number, distant cells may share the number.
  /// @param marks entities at that time  @param start of the source
  [[nodiscard]] std::string message(const ReceivedGroups& received, const Roster& roster,
                                    std::span<const EntityMark> marks,
                                    std::chrono::nanoseconds time,
                                    std::chrono::nanoseconds start) const;

 private:
  [[nodiscard]] std::string name_of(std::uint32_t tag) const;
  [[nodiscard]] std::optional<aoim::Position> place_of(const ReceivedBeacon& beacon,
                                                       const Roster& roster,
                                                       std::span<const EntityMark> marks) const;

  aoim::CellPartition cells_;
  std::map<std::uint32_t, std::string> names_;  // of beacons, by tag
};

}  // namespace reckon::tools
