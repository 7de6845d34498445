// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The cells of a scene, numbered as they come, and who subscribes to which: those within the
// scene's radius, whose groups every peer joins.
#pragma once

#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <vector>

#include "reckon/aoim/cells/cell_partition.hpp"
#include "reckon/peer/scene/peer_config.hpp"
#include "reckon/tools/viewer/protocol/picture.hpp"

namespace reckon::tools {

/// One thread. Numbers at most kMostCells cells; others have none.
class SubscribedCells {
 public:
  static constexpr std::size_t kMostCells = 4096;
  /// Cells that one message has at most.
  static constexpr std::size_t kMostSent = 512;

  /// @throws std::invalid_argument where the scene's cells cannot be made
  explicit SubscribedCells(const peer::AoimConfig& config);

  /// Sets the cell of each mark. Some 50 ns each.
  void place(std::span<EntityMark> marks);
  /// The message: the cells that somebody is in, those that `follow` subscribes to, and who
  /// subscribes to the one that it is in.
  [[nodiscard]] std::string message(std::span<const EntityMark> marks, std::uint16_t follow);

 private:
  [[nodiscard]] std::uint16_t number_of(aoim::CellId cell);
  [[nodiscard]] std::vector<std::uint16_t> cells_subscribed(const EntityMark& mark);
  [[nodiscard]] bool is_subscribed(const EntityMark& mark, std::uint16_t cell) const;

  aoim::CellPartition cells_;
  double radius_;
  std::map<aoim::CellId, std::uint16_t> numbers_;
  std::vector<aoim::CellId> by_number_;
};

}  // namespace reckon::tools
