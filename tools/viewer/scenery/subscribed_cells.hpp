// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Numbers the cells of a scene in the order of their use, and finds their subscribers: a peer
// subscribes to the cells within the scene's radius.
#pragma once

#include <algorithm>
#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <vector>

#include "reckon/aoim/cells/cell_partition.hpp"
#include "reckon/peer/scene/scene_cells.hpp"
#include "reckon/peer/settings/aoim_config.hpp"
#include "reckon/tools/terminal/json_text.hpp"
#include "reckon/tools/viewer/protocol/picture.hpp"

namespace reckon::tools {

/// One thread. Numbers at most kMostCells cells; further ones have no number.
class SubscribedCells {
 public:
  static constexpr std::size_t kMostCells = 4096;
  /// Limit of cells in one message.
  static constexpr std::size_t kMostSent = 512;

  /// @throws std::invalid_argument if the scene's cells are invalid
  explicit SubscribedCells(const peer::AoimConfig& config)
      : cells_(peer::cells_of(config)), radius_(config.radius) {}

  /// Sets the cell of each mark. Some 50 ns each.
  void place(std::span<EntityMark> marks) {
    for (EntityMark& mark : marks)
      if (mark.position.allFinite()) mark.cell = number_of(cells_.cell(place_of(mark)));
  }
  /// The message: the occupied cells, the cells that `follow` subscribes to, and the subscribers of
  /// its own cell.
  [[nodiscard]] std::string message(std::span<const EntityMark> marks, std::uint16_t follow) {
    std::map<std::uint16_t, std::vector<std::uint16_t>> subscribers;  // slots by cell
    const auto has_room = [&](std::uint16_t cell) {
      return cell != kNoNumber && (subscribers.size() < kMostSent || subscribers.contains(cell));
    };
    const auto followed = std::ranges::find(marks, follow, &EntityMark::slot);
    if (followed != marks.end()) {
      for (const std::uint16_t cell : cells_subscribed(*followed))
        if (has_room(cell)) subscribers[cell].push_back(follow);
      for (const EntityMark& mark : marks)
        if (mark.slot != follow && has_room(followed->cell) && is_subscribed(mark, followed->cell))
          subscribers[followed->cell].push_back(mark.slot);
    }
    for (const EntityMark& mark : marks)
      if (has_room(mark.cell)) subscribers[mark.cell];
    std::string out;
    JsonObject(out)
        .text("type", "cells")
        .text("shape", shape_of(cells_.scheme()))
        .decimals("size", cells_.finest(), 4)
        .array("cells", subscribers,
               [this](std::string& text, const auto& row) {
                 const aoim::Position centre = cells_.visit(
                     [&](const auto& scheme) { return scheme.centre(by_number_[row.first]); });
                 JsonObject(text)
                     .value("cell", row.first)
                     .decimals("x", centre.x, 3)
                     .decimals("y", centre.y, 3)
                     .array("heard_by", row.second,
                            [](std::string& slots, std::uint16_t slot) {
                              slots += std::to_string(slot);
                            })
                     .end();
               })
        .end();
    return out;
  }

 private:
  static aoim::Position place_of(const EntityMark& mark) {
    return {mark.position.x(), mark.position.y(), mark.position.z()};
  }
  static std::string_view shape_of(aoim::CellScheme scheme) {
    switch (scheme) {
      case aoim::CellScheme::hexagonal:
        return "hexagon";
      case aoim::CellScheme::square:
        return "square";
      default:
        return "point";
    }
  }

  [[nodiscard]] std::uint16_t number_of(aoim::CellId cell) {
    const auto known = numbers_.find(cell);
    if (known != numbers_.end()) return known->second;
    if (by_number_.size() >= kMostCells) return kNoNumber;
    const auto number = static_cast<std::uint16_t>(by_number_.size());
    by_number_.push_back(cell);
    numbers_.emplace(cell, number);
    return number;
  }
  [[nodiscard]] std::vector<std::uint16_t> cells_subscribed(const EntityMark& mark) {
    std::vector<std::uint16_t> subscribed;
    cells_.visit([&](const auto& scheme) {
      // With cells far smaller than the radius, the count would have no meaning.
      if (scheme.cells_bound(radius_) > kMostSent) return;
      scheme.for_each_cell_within(place_of(mark), radius_, [&](aoim::CellId cell, double) {
        subscribed.push_back(number_of(cell));
      });
    });
    return subscribed;
  }
  [[nodiscard]] bool is_subscribed(const EntityMark& mark, std::uint16_t cell) const {
    if (cell >= by_number_.size() || !mark.position.allFinite()) return false;
    return cells_.visit([&](const auto& scheme) {
      return scheme.distance(by_number_[cell], place_of(mark)) <= radius_;
    });
  }

  aoim::CellPartition cells_;
  double radius_;
  std::map<aoim::CellId, std::uint16_t> numbers_;
  std::vector<aoim::CellId> by_number_;
};

}  // namespace reckon::tools
