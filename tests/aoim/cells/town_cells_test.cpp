// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Deliveries of the cell schemes to the vehicles of a town. Each vehicle is a host with one entity
// and sends once a second; R = 200 m.
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
#include "reckon/tests/support/soak.hpp"

namespace reckon::aoim {
namespace {

constexpr double kRadius = 200.0;
constexpr double kNearer = 1.05;    // groups are left at this multiple of R
constexpr std::size_t kJudged = 6;  // [s] interval between two comparisons of the received entities
constexpr const char* kTraffic = "trajectories/vehicles_town_sumo.csv";

struct Vehicle {
  std::size_t host = 0;  ///< from 0
  Position position;
  double speed = 0.0;
};
using Second = std::vector<Vehicle>;

/// A demand of one second: receiver and sender, as indices into it.
struct Wanted {
  std::size_t who, whom;
};

/// Recorded traffic: the part that divides the tree, then the part that is judged.
struct Town {
  std::vector<Second> begin, rest;
  std::size_t hosts = 0;
  std::vector<std::vector<Wanted>> wanted;  ///< by second of `rest`, only for judged seconds
};

std::vector<Second> read_traffic(std::size_t& hosts) {
  std::ifstream file(reckon::test::reference_data() / kTraffic);
  std::string line;
  std::getline(file, line);
  std::vector<Second> traffic;
  std::map<int, std::size_t> numbers;
  while (std::getline(file, line)) {
    double t = 0, x = 0, y = 0, heading = 0, speed = 0;
    int id = 0;
    if (std::sscanf(line.c_str(), "%lf,%d,%lf,%lf,%lf,%lf", &t, &id, &x, &y, &heading, &speed) != 6)
      continue;
    const auto second = static_cast<std::size_t>(t);
    if (traffic.size() <= second) traffic.resize(second + 1);
    const std::size_t host = numbers.emplace(id, numbers.size()).first->second;
    traffic[second].push_back({host, {x, y, 0.0}, speed});
  }
  hosts = numbers.size();
  return traffic;
}

std::vector<Wanted> wanted_in(const Second& second) {
  std::vector<Wanted> all;
  for (std::size_t who = 0; who < second.size(); ++who) {
    for (std::size_t whom = 0; whom < second.size(); ++whom) {
      const double away = distance(second[who].position, second[whom].position);
      if (who != whom && away <= kRadius) all.push_back({who, whom});
    }
  }
  return all;
}

// Read once for all tests; the wanted pairs are the same for all cell schemes.
const Town& town() {
  static const Town town = [] {
    Town made;
    std::vector<Second> all = read_traffic(made.hosts);
    const auto tenth =
        all.begin() + static_cast<std::ptrdiff_t>(std::min<std::size_t>(10, all.size()));
    made.begin.assign(all.begin(), tenth);
    made.rest.assign(tenth, all.end());
    for (std::size_t t = 0; t < made.rest.size(); ++t)
      made.wanted.push_back(t % kJudged == 0 ? wanted_in(made.rest[t]) : std::vector<Wanted>());
    return made;
  }();
  return town;
}

struct Delivery {
  double received_per_wanted = 0.0, groups_per_host = 0.0, joins_per_host_second = 0.0;
  double early_leaves = 0.0;  ///< share of memberships shorter than 3 s
  std::size_t missed = 0;     ///< wanted entities whose group is not joined
};

// A host with a subscription only.
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

// A host with the complete manager of a peer.
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
    return manager_.listen(kCellTier, {&focus, 1}, now);
  }
  [[nodiscard]] GroupIndex route(const Position& place) const { return manager_.route(place); }
  [[nodiscard]] bool hears(GroupIndex group) const { return manager_.subscriptions().hears(group); }
  [[nodiscard]] std::span<const GroupIndex> joined() const {
    return manager_.subscriptions().cells().joined();
  }

 private:
  AreaOfInterestManager manager_;
};

/// Deliveries with one cell scheme, second by second.
template <typename Host>
class Deliveries {
 public:
  Deliveries(const CellPartition& cells, double leave_factor)
      : cells_(cells),
        leave_factor_(leave_factor),
        router_(cells, leave_factor),
        hosts_(town().hosts),
        joined_at_(town().hosts, std::vector<std::size_t>(cells.groups() + 1u)) {}

  void look(std::size_t t) {
    for (const Vehicle& vehicle : town().rest[t]) look(vehicle, t);
    if (t % kJudged == 0) judge(t);
  }
  [[nodiscard]] Delivery result() const {
    return {received_ / wanted_, joined_ / host_seconds_, later_joins_ / later_seconds_,
            early_ / std::max(joins_, 1.0), missed_};
  }

 private:
  void look(const Vehicle& vehicle, std::size_t t) {
    std::unique_ptr<Host>& host = hosts_[vehicle.host];
    const bool is_new = !host;
    if (is_new) host = std::make_unique<Host>(cells_, leave_factor_);
    const Focus focus{vehicle.position, vehicle.speed, kRadius};
    const auto change = host->look(focus, std::chrono::seconds(t));
    later_seconds_ += is_new ? 0.0 : 1.0;
    if (!is_new) later_joins_ += static_cast<double>(change.join.size());
    joins_ += static_cast<double>(change.join.size());
    std::vector<std::size_t>& joined_at = joined_at_[vehicle.host];
    for (const GroupIndex group : change.join) joined_at[group.value] = t;
    for (const GroupIndex group : change.leave) early_ += t - joined_at[group.value] < 3 ? 1 : 0;
  }
  void judge(std::size_t t) {
    const Second& second = town().rest[t];
    std::vector<double> said(cells_.groups() + 1u);
    std::vector<GroupIndex> groups;
    for (const Vehicle& vehicle : second) {
      groups.push_back(router_.route(vehicle.position));
      said[groups.back().value] += 1.0;
    }
    for (std::size_t who = 0; who < second.size(); ++who) {
      const Host& host = *hosts_[second[who].host];
      joined_ += static_cast<double>(host.joined().size());
      host_seconds_ += 1.0;
      received_ -= host.hears(groups[who]) ? 1.0 : 0.0;  // its own update
      for (const GroupIndex group : host.joined()) received_ += said[group.value];
    }
    for (const Wanted& pair : town().wanted[t]) {
      wanted_ += 1.0;
      missed_ += hosts_[second[pair.who].host]->hears(groups[pair.whom]) ? 0 : 1;
    }
  }

  const CellPartition& cells_;
  double leave_factor_;
  Host router_;
  std::vector<std::unique_ptr<Host>> hosts_;
  std::vector<std::vector<std::size_t>> joined_at_;  // by host and group
  double received_ = 0, wanted_ = 0, joined_ = 0, joins_ = 0, later_joins_ = 0, early_ = 0,
         host_seconds_ = 0, later_seconds_ = 0;
  std::size_t missed_ = 0;
};

template <typename Host = Listener>
Delivery deliver(const CellPartition& cells,
                 double leave_factor = SubscriptionConfig().leave_factor) {
  Deliveries<Host> deliveries(cells, leave_factor);
  for (std::size_t t = 0; t < town().rest.size(); ++t) deliveries.look(t);
  return deliveries.result();
}

QuadTree divided(std::size_t pool) {
  QuadTreeConfig config;
  config.centre = {2048.0, 2048.0, 0.0};
  config.side = 4096.0;
  config.pool = pool;
  std::vector<Demand> demands;
  for (std::uint32_t t = 0; t < town().begin.size(); ++t) {
    for (const Vehicle& vehicle : town().begin[t])
      demands.push_back({vehicle.position, kNearer * kRadius, t});
  }
  return QuadTree::divided_by(config, demands);
}

void print(const char* name, const Delivery& d) {
  std::printf("%-28s groups/host %5.1f  received/wanted %5.2f  joins/host/s %.3f  early %.2f %%\n",
              name, d.groups_per_host, d.received_per_wanted, d.joins_per_host_second,
              100.0 * d.early_leaves);
}

// The tree is divided by the first ten seconds and judged by all that follow.
TEST(TownCells, QuadTreeDeliversFewUnwantedUpdates) {
  RECKON_NEED_DATA(kTraffic);
  ASSERT_GT(town().rest.size(), 50U);
  const QuadTree few = divided(64), more = divided(256);
  if (reckon::test::soaks()) {
    print("quad-tree, 64, left at 1.1 R", deliver(few));
    print("quad-tree, 256, left at 1.1 R", deliver(more));
  }
  const Delivery with_64 = deliver(few, kNearer), with_256 = deliver(more, kNearer);
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

TEST(TownCells, ManagerDeliversAsLittleAsTheSubscription) {
  RECKON_NEED_DATA(kTraffic);
  const QuadTree few = divided(64), more = divided(256);
  const Delivery with_64 = deliver<ManagedHost>(few, kNearer),
                 with_256 = deliver<ManagedHost>(more, kNearer);
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

TEST(TownCells, UniformCellsMissNothing) {
  RECKON_NEED_DATA(kTraffic);
  for (const CellScheme scheme : {CellScheme::square, CellScheme::hexagonal}) {
    for (const std::size_t pool : {64U, 256U}) {
      GridConfig config;
      config.scheme = scheme;
      config.pool = pool;
      config.cell_size = scheme == CellScheme::square ? 200.0 : 125.0;
      if (pool == 64) config.cell_size *= 2.0;
      const Delivery d = deliver(CellPartition(CellGrid(config)));
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
