// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/bench/studies/scale/setting.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <set>
#include <vector>

#include "reckon/peer/scene/scene_cells.hpp"
#include "reckon/peer/tracks/density_file.hpp"
#include "reckon/tools/command_line/console.hpp"

namespace reckon::bench {
namespace {

constexpr std::size_t kMostNumbers = 65'534;  // of applications and of entities in DIS

}  // namespace

void check_scale_setting(const ScaleSetting& setting) {
  const std::size_t peers = setting.peers, entities = setting.crowd.entities;
  if (peers < 1 || peers > kMostNumbers)
    throw tools::UsageError(
        fmt::format("--peers: {} is not between 1 and {}", peers, kMostNumbers));
  if (entities < peers)
    throw tools::UsageError(
        fmt::format("--entities: {} leave some of {} peers without one; write {} or more", entities,
                    peers, peers));
  if (entities > peers * kMostNumbers)
    throw tools::UsageError(
        fmt::format("--entities: {} are more than {} peers can have, {} each; add peers", entities,
                    peers, kMostNumbers));
}

peer::AoimConfig scale_cells(const ScaleSetting& setting) {
  peer::AoimConfig cells;
  cells.scheme = setting.grid.scheme;
  cells.cell = setting.grid.cell_size;
  cells.radius = setting.radius;
  cells.pool = static_cast<std::uint32_t>(setting.grid.pool);
  cells.quad_tree = setting.tree;
  cells.quad_tree.smallest = setting.grid.cell_size;
  return cells;
}

void divide_by_crowd(ScaleSetting& setting) {
  const Crowd crowd(setting.crowd);
  const std::size_t every = 1 + crowd.size() / peer::kMostAtOnce;
  std::vector<aoim::Demand> places;
  Eigen::AlignedBox2d box;
  for (std::size_t e = 0; e < crowd.size(); ++e) {
    const aoim::Position& place = crowd.position(e);
    box.extend(Eigen::Vector2d(place.x, place.y));
    if (e % every == 0) places.push_back({place, setting.radius, 0});
  }
  setting.tree.centre.head<2>() = box.center();
  setting.tree.side = std::max(box.sizes().maxCoeff(), setting.grid.cell_size);
  setting.tree.cells = peer::divided_by(scale_cells(setting), places);
}

bool shares_one_group(const ScaleSetting& setting) noexcept { return setting.grid.pool == 1; }

bool groups_suffice(const ScaleSetting& setting) {
  const aoim::CellPartition partition = peer::cells_of(scale_cells(setting));
  const Crowd crowd(setting.crowd);
  std::set<aoim::CellId> cells;
  std::set<aoim::GroupIndex> groups;
  for (std::size_t e = 0; e < crowd.size(); ++e) {
    cells.insert(partition.cell(crowd.position(e)));
    groups.insert(partition.group(crowd.position(e)));
  }
  return groups.size() == cells.size();
}

double entities_a_peer(const ScaleSetting& setting) noexcept {
  return static_cast<double>(setting.crowd.entities) / static_cast<double>(setting.peers);
}

bool are_alike(const ScaleSetting& a, const ScaleSetting& b) noexcept {
  constexpr double kAlike = 0.05;
  return std::abs(entities_a_peer(a) / entities_a_peer(b) - 1) <= kAlike;
}

ScaleChannels scale_channels(const ScaleSetting& setting) {
  const auto usual = aoim::default_channels();
  ScaleChannels cut;
  for (const aoim::Channel& row : usual) {
    cut.rows.push_back(row);
    if (row.kept || row.farthest < setting.radius) continue;
    cut.rows.back().farthest = std::numeric_limits<double>::infinity();
    break;
  }
  cut.near_rows = aoim::ChannelTable(cut.rows).inner_rows();
  const bool has_room = setting.grid.pool * (cut.near_rows + 1) <= aoim::kMaximumPool;
  if (has_room && cut.near_rows > 0 && !shares_one_group(setting)) return cut;
  return {{usual.begin(), usual.end()}, 0};
}

pdu::CompressedForm scale_compression(const ScaleSetting& setting) {
  return scale_channels(setting).near_rows == 0 ? pdu::CompressedForm::residual
                                                : pdu::CompressedForm::compact;
}

OwnedRange owned_by(const ScaleSetting& setting, std::size_t peer) noexcept {
  const std::size_t entities = setting.crowd.entities;
  return {static_cast<std::uint32_t>(peer * entities / setting.peers),
          static_cast<std::uint32_t>((peer + 1) * entities / setting.peers)};
}

}  // namespace reckon::bench
