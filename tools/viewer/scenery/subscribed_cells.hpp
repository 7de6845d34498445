// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Numbers the cells of a scene in the order of their use, and finds their subscribers: a peer
// subscribes to the cells within the scene's radius.
#pragma once

#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <vector>

#include "reckon/aoim/cells/cell_partition.hpp"
#include "reckon/peer/settings/aoim_config.hpp"
#include "reckon/tools/viewer/protocol/picture.hpp"

namespace reckon::tools {

/// One thread. Numbers at most kMostCells cells; further ones have no number.
class SubscribedCells {
 public:
  static constexpr std::size_t kMostCells = 4096;
  /// Limit of cells in one message.
  static constexpr std::size_t kMostSent = 512;

  /// @throws std::invalid_argument if the scene's cells are invalid
  explicit SubscribedCells(const peer::AoimConfig& config);

  /// Sets the cell of each mark. Some 50 ns each.
  void place(std::span<EntityMark> marks);
  /// The message: the occupied cells, the cells that `follow` subscribes to, and the subscribers of
  /// its own cell.
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
