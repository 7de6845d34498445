// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The cells of a scene, numbered as they come, and who hears which: by the scene's radius, as every
// peer joins them.
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
class HeardCells {
 public:
  static constexpr std::size_t kMostCells = 4096;
  /// Cells that one message has at most.
  static constexpr std::size_t kMostTold = 512;

  /// @throws std::invalid_argument where the scene's cells cannot be made
  explicit HeardCells(const peer::AoimConfig& config);

  /// Sets the cell of each mark. Some 50 ns each.
  void place(std::span<EntityMark> marks);
  /// The message: the cells that somebody is in, those that `follow` hears, and who hears the one
  /// that it is in.
  [[nodiscard]] std::string message(std::span<const EntityMark> marks, std::uint16_t follow);

 private:
  [[nodiscard]] std::uint16_t number_of(aoim::CellId cell);
  [[nodiscard]] std::vector<std::uint16_t> cells_heard(const EntityMark& mark);
  [[nodiscard]] bool hears(const EntityMark& mark, std::uint16_t cell) const;

  aoim::CellPartition cells_;
  double radius_;
  std::map<aoim::CellId, std::uint16_t> numbers_;
  std::vector<aoim::CellId> by_number_;
};

}  // namespace reckon::tools
