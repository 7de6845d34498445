// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// What the cell schemes deliver to the vehicles of a town: each is a host with one entity that it
// tells once a second, R = 200 m.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>
#include <fstream>
#include <map>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "reckon/aoim/area_of_interest_manager.hpp"
#include "reckon/aoim/cells/cell_grid.hpp"
#include "reckon/aoim/cells/quad_tree.hpp"
#include "reckon/aoim/interest/subscription.hpp"
#include "reckon/tests/support/reference_data.hpp"

namespace reckon::aoim {
namespace {

constexpr double kRadius = 200.0;
constexpr double kNearer = 1.05;    // a group is left here: so many early leaves are few enough
constexpr std::size_t kJudged = 6;  // every so many seconds what is received is compared
constexpr const char* kTraffic = "trajectories/vehicles_town_sumo.csv";

struct Vehicle {
  Position position;
  double speed = 0.0;
};
using Second = std::map<int, Vehicle>;

std::vector<Second> read_traffic() {
  std::ifstream file(test::reference_data() / kTraffic);
  std::string line;
  std::getline(file, line);
  std::vector<Second> seconds;
  while (std::getline(file, line)) {
    double t = 0, x = 0, y = 0, heading = 0, speed = 0;
    int id = 0;
    if (std::sscanf(line.c_str(), "%lf,%d,%lf,%lf,%lf,%lf", &t, &id, &x, &y, &heading, &speed) != 6)
      continue;
    const auto second = static_cast<std::size_t>(t);
    if (seconds.size() <= second) seconds.resize(second + 1);
    seconds[second][id] = {{x, y, 0.0}, speed};
  }
  return seconds;
}

struct Delivery {
  double received_per_wanted = 0.0, groups_per_host = 0.0, joins_per_host_second = 0.0;
  double early_leaves = 0.0;  ///< share of the memberships that ended within 3 s
  std::size_t missed = 0;     ///< wanted, in a group that is not joined
};

// A host that is the subscription alone.
class Listener {
 public:
  Listener(const CellPartition& cells, double leave_factor)
      : cells_(cells), subscription_(cells, left_at(leave_factor)) {}
  static SubscriptionConfig left_at(double leave_factor) {
    SubscriptionConfig config;
    config.leave_factor = leave_factor;
    return config;
  }
  SubscriptionChange look(const Focus& focus, std::chrono::nanoseconds now) {
    return subscription_.update({&focus, 1}, now);
  }
  [[nodiscard]] GroupIndex route(const Position& place) const { return cells_.group(place); }
  [[nodiscard]] bool hears(GroupIndex group) const { return subscription_.is_joined(group); }
  [[nodiscard]] std::span<const GroupIndex> joined() const { return subscription_.joined(); }

 private:
  const CellPartition& cells_;
  Subscription subscription_;
};

// A host with all that a peer has.
class ManagedHost {
 public:
  ManagedHost(const CellPartition& cells, double leave_factor)
      : manager_(config(cells, leave_factor), own()) {}
  static AreaOfInterestConfig config(const CellPartition& cells, double leave_factor) {
    AreaOfInterestConfig config;
    config.grid.pool = cells.groups();
    config.cells = cells;
    config.subscription.leave_factor = leave_factor;
    config.tracked = 1;
    config.presence.capacity = 1;
    return config;
  }
  static pdu::Presence own() {
    pdu::Presence own;
    own.simulation = {7, 1};
    own.epoch = 1;
    return own;
  }
  SubscriptionChange look(const Focus& focus, std::chrono::nanoseconds now) {
    return manager_.set_foci({&focus, 1}, now);
  }
  [[nodiscard]] GroupIndex route(const Position& place) const { return manager_.route(place); }
  [[nodiscard]] bool hears(GroupIndex group) const { return manager_.hears(group); }
  [[nodiscard]] std::span<const GroupIndex> joined() const {
    return manager_.subscription().joined();
  }

 private:
  AreaOfInterestManager manager_;
};

template <typename Host = Listener>
Delivery deliver(const std::vector<Second>& traffic, const CellPartition& cells,
                 double leave_factor = SubscriptionConfig().leave_factor) {
  const Host router(cells, leave_factor);
  std::map<int, std::unique_ptr<Host>> hosts;
  std::map<std::pair<int, std::uint16_t>, std::size_t> joined_at;
  double received = 0, wanted = 0, joined = 0, joins = 0, later_joins = 0, ended = 0, early = 0,
         host_seconds = 0, later_seconds = 0;
  Delivery result;
  for (std::size_t t = 0; t < traffic.size(); ++t) {
    std::vector<double> said(cells.groups() + 1);
    for (const auto& [id, vehicle] : traffic[t]) said[router.route(vehicle.position).value] += 1.0;
    for (const auto& [id, vehicle] : traffic[t]) {
      const bool is_new = hosts.count(id) == 0;
      if (is_new) hosts.emplace(id, std::make_unique<Host>(cells, leave_factor));
      Host& host = *hosts[id];
      const Focus focus{vehicle.position, vehicle.speed, kRadius};
      const auto change = host.look(focus, std::chrono::seconds(t));
      later_seconds += is_new ? 0.0 : 1.0;
      if (!is_new) later_joins += static_cast<double>(change.join.size());
      joins += static_cast<double>(change.join.size());
      for (const GroupIndex group : change.join) joined_at[{id, group.value}] = t;
      for (const GroupIndex group : change.leave) {
        ended += 1.0;
        early += t - joined_at[{id, group.value}] < 3 ? 1.0 : 0.0;
      }
      if (t % kJudged != 0) continue;
      joined += static_cast<double>(host.joined().size());
      host_seconds += 1.0;
      received -= host.hears(router.route(vehicle.position)) ? 1.0 : 0.0;  // its own
      for (const GroupIndex group : host.joined()) received += said[group.value];
      for (const auto& [other, sender] : traffic[t]) {
        if (other == id || distance(sender.position, vehicle.position) > kRadius) continue;
        wanted += 1.0;
        result.missed += host.hears(router.route(sender.position)) ? 0 : 1;
      }
    }
  }
  result.received_per_wanted = received / wanted;
  result.groups_per_host = joined / host_seconds;
  result.joins_per_host_second = later_joins / later_seconds;
  result.early_leaves = early / std::max(joins, 1.0);
  return result;
}

QuadTree divided(const std::vector<Second>& traffic, std::size_t pool) {
  QuadTreeConfig config;
  config.centre = {2048.0, 2048.0, 0.0};
  config.side = 4096.0;
  config.pool = pool;
  std::vector<Demand> demands;
  for (std::uint32_t t = 0; t < 10; ++t) {
    for (const auto& [id, vehicle] : traffic[t])
      demands.push_back({vehicle.position, kNearer * kRadius, t});
  }
  return QuadTree::divided_by(config, demands);
}

void print(const char* name, const Delivery& d) {
  std::printf("%-28s groups/host %5.1f  received/wanted %5.2f  joins/host/s %.3f  early %.2f %%\n",
              name, d.groups_per_host, d.received_per_wanted, d.joins_per_host_second,
              100.0 * d.early_leaves);
}

// Divided by the first ten seconds, judged by all that follow.
TEST(TownCells, DeliverNearlyWhatIsWantedFromAQuadTreeOfFewGroups) {
  RECKON_NEED_DATA(kTraffic);
  std::vector<Second> traffic = read_traffic();
  ASSERT_GT(traffic.size(), 60U);
  const QuadTree few = divided(traffic, 64), more = divided(traffic, 256);
  traffic.erase(traffic.begin(), traffic.begin() + 10);
  print("quad-tree, 64, left at 1.1 R", deliver(traffic, few));
  print("quad-tree, 256, left at 1.1 R", deliver(traffic, more));
  const Delivery with_64 = deliver(traffic, few, kNearer),
                 with_256 = deliver(traffic, more, kNearer);
  print("quad-tree, 64, at 1.05 R", with_64);
  print("quad-tree, 256, at 1.05 R", with_256);
  EXPECT_LE(with_64.received_per_wanted, 3.2);
  EXPECT_LE(with_256.received_per_wanted, 1.9);
  for (const Delivery& d : {with_64, with_256}) {
    EXPECT_EQ(d.missed, 0U);
    EXPECT_LE(d.joins_per_host_second, 0.25);
    EXPECT_LE(d.early_leaves, 0.005);
  }
}

TEST(TownCells, DeliverAsLittleThroughThePeersManager) {
  RECKON_NEED_DATA(kTraffic);
  std::vector<Second> traffic = read_traffic();
  const QuadTree few = divided(traffic, 64), more = divided(traffic, 256);
  traffic.erase(traffic.begin(), traffic.begin() + 10);
  const Delivery with_64 = deliver<ManagedHost>(traffic, few, kNearer),
                 with_256 = deliver<ManagedHost>(traffic, more, kNearer);
  print("managers, 64, at 1.05 R", with_64);
  print("managers, 256, at 1.05 R", with_256);
  EXPECT_LE(with_64.received_per_wanted, 3.2);
  EXPECT_LE(with_256.received_per_wanted, 1.9);
  for (const Delivery& d : {with_64, with_256}) {
    EXPECT_EQ(d.missed, 0U);
    EXPECT_LE(d.joins_per_host_second, 0.25);
    EXPECT_LE(d.early_leaves, 0.005);
  }
}

TEST(TownCells, OfOneSizeDeliverMoreFromAsManyGroups) {
  RECKON_NEED_DATA(kTraffic);
  const std::vector<Second> all = read_traffic();
  const std::vector<Second> traffic(all.begin() + 10, all.end());
  for (const CellScheme scheme : {CellScheme::square, CellScheme::hexagonal}) {
    for (const std::size_t pool : {64U, 256U}) {
      GridConfig config;
      config.scheme = scheme;
      config.pool = pool;
      config.cell_size = scheme == CellScheme::square ? 200.0 : 125.0;
      if (pool == 64) config.cell_size *= 2.0;
      const Delivery d = deliver(traffic, CellGrid(config));
      const std::string name =
          std::string(scheme == CellScheme::square ? "squares of " : "hexagons of ") +
          std::to_string(static_cast<int>(config.cell_size)) + " m, " + std::to_string(pool);
      print(name.c_str(), d);
      EXPECT_EQ(d.missed, 0U);
      EXPECT_LE(d.early_leaves, 0.005);
    }
  }
}

}  // namespace
}  // namespace reckon::aoim
