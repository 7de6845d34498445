// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/aoim/area_of_interest_config.hpp"

#include <algorithm>
#include <stdexcept>
#include <string>

#include "reckon/aoim/interest/focus_cover.hpp"

namespace reckon::aoim {
namespace {

std::size_t near_rows_of(const AreaOfInterestConfig& config) {
  if (!config.near_groups || config.channels.empty()) return 0;
  return ChannelTable(config.channels).near_rows();
}

void check_more_groups(const AreaOfInterestConfig& config) {
  const auto refuse = [](const char* what) { throw std::invalid_argument(what); };
  if (!config.contact_groups && !config.near_groups) return;
  if (config.interop) refuse("contact and near groups: plain DIS has one group");
  if (config.leader.on && config.leader.hand_out)
    refuse("contact and near groups are those of the fixed tile: none is handed out");
  if (config.grid.pool < 2 || all_groups(config) > kMaximumPool)
    refuse("contact and near groups: take a pool of 4 or more, and 1000 groups in all at most");
  if (!config.near_groups) return;
  if (config.channels.empty() || ChannelTable(config.channels).near_rows() == 0)
    refuse("near groups: the channels have no row that is near, not kept, and not the last");
  if (config.leader.on) refuse("near groups: leaders would tell what was said in all of them");
  if (config.channels[ChannelTable(config.channels).kept_rows()].coarser > 1.0)
    refuse("near groups: the nearest row has the thresholds of the scene");
}

}  // namespace

CellPartition cells_of(const AreaOfInterestConfig& config) {
  GridConfig grid = config.grid;
  if (config.leader.on && config.leader.hand_out) grid.pool = kMaximumPool;
  if (!config.cells) return CellGrid(grid);
  if (config.interop && config.cells->as<LocaleMap>() != nullptr)
    throw std::invalid_argument("locales are distinguished by groups: plain DIS has one");
  if (config.cells->groups() > grid.pool)
    throw std::invalid_argument("cells of " + std::to_string(config.cells->groups()) +
                                " groups, and a pool of " + std::to_string(grid.pool));
  return *config.cells;
}

TierTable tiers_of(const AreaOfInterestConfig& config) {
  return {config.contact_groups, near_rows_of(config), config.grid.pool};
}

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

AggregatorConfig aggregator_of(const AreaOfInterestConfig& config, const pdu::Presence& own) {
  check_more_groups(config);
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
