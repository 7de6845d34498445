// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/aoim/area_of_interest_config.hpp"

#include <algorithm>
#include <stdexcept>
#include <string>

#include "reckon/aoim/interest/focus_cover.hpp"

namespace reckon::aoim {
namespace {

bool runs_ahead(const TierKind* kind) { return kind->runs_ahead; }

void check_tiers(const AreaOfInterestConfig& config) {
  const auto refuse = [](const char* what) { throw std::invalid_argument(what); };
  if (config.tiers.empty()) return;
  if (config.interop) refuse("tiers need several groups, but plain DIS has one: remove the tiers");
  if (config.leader.on && config.leader.hand_out)
    refuse("tiers use the groups of the fixed tile: switch off the hand-out of groups");
  if (config.grid.pool < 2 || all_groups(config) > kMaximumPool)
    refuse("tiers need a pool of 4 or more groups, and at most 1000 groups in all");
  const auto ahead = std::ranges::count_if(config.tiers, runs_ahead);
  if (ahead == 0) return;
  const ChannelTable table(config.channels);
  if (static_cast<std::size_t>(ahead) != table.inner_rows())
    refuse("a tier that runs ahead has a row of channels that is neither kept nor the last");
  if (config.leader.on) refuse("leaders relay the updates of the cell: no tier may run ahead");
  if (table.channel(table.kept_rows()).coarser > 1.0)
    refuse("tiers with groups: the nearest row must have the thresholds of the scene");
}

}  // namespace

CellPartition cells_of(const AreaOfInterestConfig& config) {
  GridConfig grid = config.grid;
  if (config.leader.on && config.leader.hand_out) grid.pool = kMaximumPool;
  if (!config.cells) return CellGrid(grid);
  if (config.interop && config.cells->as<LocaleMap>() != nullptr)
    throw std::invalid_argument("locales need several groups, but plain DIS has one");
  if (config.cells->groups() > grid.pool)
    throw std::invalid_argument("cells of " + std::to_string(config.cells->groups()) +
                                " groups, and a pool of " + std::to_string(grid.pool));
  return *config.cells;
}

TierTable tiers_of(const AreaOfInterestConfig& config) { return {config.tiers, config.grid.pool}; }

std::size_t all_groups(const AreaOfInterestConfig& config) {
  return config.grid.pool * tiers_of(config).count();
}

pdu::Presence announcement(pdu::Presence own, const AreaOfInterestConfig& config) {
  own.cell_scheme = config.cells ? config.cells->scheme() : config.grid.scheme;
  own.cell_size = static_cast<float>(config.cells ? config.cells->finest() : config.grid.cell_size);
  own.pool_size = static_cast<std::uint16_t>(config.grid.pool);
  if (config.interop) own.flags |= pdu::kPresenceInterop;
  return own;
}

TierReach tier_reach_of(const AreaOfInterestConfig& config) {
  TierReach reach{config.radius, config.farthest_nimbus, {}, 1.0};
  if (std::ranges::any_of(config.tiers, runs_ahead)) reach.rows.emplace(config.channels);
  return reach;
}

AggregatorConfig aggregator_of(const AreaOfInterestConfig& config, const pdu::Presence& own) {
  check_tiers(config);
  AggregatorConfig aggregator = config.aggregator;
  aggregator.pool = all_groups(config);
  aggregator.sender = own.simulation;
  aggregator.epoch = own.epoch;
  aggregator.exercise_id = own.header.exercise_id;
  return aggregator;
}

InterestConfig interest_of(const AreaOfInterestConfig& config, const CellPartition& cells) {
  InterestConfig interest = config.interest;
  interest.maximum_foci = std::max(interest.maximum_foci, FocusCover::most(cells.as<LocaleMap>()));
  return interest;
}

IntroductionConfig introduction_of(const AreaOfInterestConfig& config, const CellPartition& cells) {
  IntroductionConfig introduction = config.introduction;
  introduction.pool = std::max<std::size_t>(cells.groups(), all_groups(config));
  return introduction;
}

}  // namespace reckon::aoim
