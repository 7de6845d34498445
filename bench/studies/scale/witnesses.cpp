// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/bench/studies/scale/witnesses.hpp"

#include <algorithm>
#include <limits>
#include <optional>

#include "reckon/bench/studies/scale/whole_peer.hpp"
#include "reckon/deadreckon/motion/acceleration_trust.hpp"
#include "reckon/deadreckon/motion/convergence.hpp"
#include "reckon/pdu/seconds.hpp"
#include "reckon/peer/loops/aoim_setup.hpp"

namespace reckon::bench {
namespace {

constexpr double kNever = std::numeric_limits<double>::infinity();
constexpr double kTold = -1;  // since when it is within the radius, once it was shown there

double squared_distance(const aoim::Position& a, const aoim::Position& b) {
  const double x = a.x - b.x, y = a.y - b.y, z = a.z - b.z;
  return x * x + y * y + z * z;
}

}  // namespace

/// What one of them knows.
struct Witnesses::Witness {
  /// What came of an entity by some of the groups.
  struct Told {
    deadreckon::KinematicState state;
    double time = -kNever;  ///< of the state; none was heard
    aoim::GroupIndex group;
  };
  /// An entity that is near or may come.
  struct Known : Told {
    deadreckon::ConvergingError error;  ///< what is shown less what is predicted
    std::vector<Told> behind;           ///< by near row, the newest by a row behind it
    double inside = kNever;             ///< since when it is within the radius
    bool near = false;                  ///< of the last gather()
    bool shown = false;

    [[nodiscard]] bool is_heard() const { return time > -kNever; }
  };
  struct Arrival {
    double at = 0, time = 0;
    std::uint32_t entity = 0;
    std::size_t row = 0;  ///< near ones first
    Told told;
  };

  std::uint32_t peer = 0;
  OwnedRange owned;
  peer::Impairment network;
  aoim::Interest interest{aoim::InterestConfig{}};
  std::vector<double> heard_from;  ///< by group
  std::unordered_map<std::uint32_t, Known> known;
  std::vector<Arrival> under_way;
  deadreckon::ConvergenceSettings convergence{};
  double now = 0;  ///< of the last take()

  [[nodiscard]] bool is_inside(const aoim::Position& place, const Crowd& crowd,
                               double radius) const {
    for (std::uint32_t i = owned.first; i < owned.end; ++i)
      if (squared_distance(crowd.position(i), place) <= radius * radius) return true;
    return false;
  }
  [[nodiscard]] deadreckon::Pose predicted(const Known& row, double time) const {
    return deadreckon::extrapolate_trusted(row.state, time - row.time);
  }
  /// Another state is believed from `time` on; what is shown converges to it, as peers' does.
  void believe(Known& row, const Told& told, double time) {
    const bool goes_on = row.is_heard() && row.shown && told.time > -kNever;
    const deadreckon::Pose shown =
        goes_on ? row.error.shown(predicted(row, time), time) : deadreckon::Pose();
    static_cast<Told&>(row) = told;
    row.error.snap();
    if (goes_on) row.error.restart(convergence, shown, predicted(row, time), time);
  }
  /// Newest wins.
  void take(double time) {
    now = time;
    std::erase_if(under_way, [&](const Arrival& arrival) {
      if (arrival.at > time) return false;
      const auto found = known.find(arrival.entity);
      if (found == known.end()) return true;
      Known& row = found->second;
      for (std::size_t near = 0; near < std::min(arrival.row, row.behind.size()); ++near)
        if (arrival.time >= row.behind[near].time) row.behind[near] = arrival.told;
      if (arrival.time >= row.time) believe(row, arrival.told, time);
      return true;
    });
  }
  void leave(aoim::GroupIndex group, std::size_t near_row) {
    for (auto& [entity, row] : known)
      if (row.is_heard() && row.group == group) believe(row, Told(row.behind[near_row]), now);
  }
  [[nodiscard]] bool is_taken(const Eigen::Vector3d& at, bool is_shown) {
    return aoim::is_accepted(interest.judge({at.x(), at.y(), at.z()}, 0, 0, is_shown));
  }
  /// Shown as a peer does: where its prediction is within the radius of a focus.
  [[nodiscard]] std::optional<Eigen::Vector3d> show(Known& row, double time) {
    if (!row.is_heard()) return std::nullopt;
    const deadreckon::Pose at = predicted(row, time);
    row.shown = is_taken(at.position, row.shown);
    return row.shown ? std::optional(row.error.shown(at, time).position) : std::nullopt;
  }
};

// The witnesses, and what they have observed since counting began.
struct Witnesses::Observations {
  std::vector<Witness> witnesses;
  std::vector<std::uint32_t> of_peer;
  /// By entity, bits of the witnesses that may care, number modulo 64.
  std::vector<std::uint64_t> near;
  double radius = 0;
  std::size_t near_rows = 0;  ///< that have groups
  std::uint64_t wanted = 0, missed = 0, lost = 0, looks = 0, unseen = 0;
  std::unique_ptr<peer::ErrorHistogram> pose;
  std::unique_ptr<peer::DurationHistogram> discovery;
};

Witnesses::Witnesses(const ScaleSetting& setting, std::span<const OwnedRange> owned,
                     std::span<const aoim::Channel> near)
    : observations_(std::make_unique<Observations>()) {
  const deadreckon::ConvergenceSettings convergence =
      setting.converges ? peer::remote_settings(scale_scene(setting)).convergence.settings
                        : deadreckon::ConvergenceSettings{deadreckon::ConvergenceCurve::snap};
  observations_->near_rows = near.size();
  observations_->radius = setting.radius;
  observations_->of_peer.assign(owned.size(), std::numeric_limits<std::uint32_t>::max());
  const std::size_t count = std::min(setting.witnesses, owned.size());
  for (std::size_t i = 0; i < count; ++i) {
    const auto peer = static_cast<std::uint32_t>(i * owned.size() / count);
    observations_->of_peer[peer] = static_cast<std::uint32_t>(i);
    observations_->witnesses.push_back(
        {peer,
         owned[peer],
         peer::Impairment(setting.network, peer::direction_seed(setting.seed, peer)),
         aoim::Interest(aoim::InterestConfig{}),
         std::vector<double>(setting.grid.pool * (1 + near.size()) + 1, kNever),
         {},
         {},
         convergence,
         0});
    observations_->witnesses.back().heard_from[0] = 0;
  }
  observations_->near.assign(setting.crowd.entities, 0);
  begin_counting();
}

Witnesses::~Witnesses() = default;

std::size_t Witnesses::size() const noexcept { return observations_->witnesses.size(); }

void Witnesses::begin_counting() {
  observations_->wanted = observations_->missed = observations_->lost = observations_->looks =
      observations_->unseen = 0;
  observations_->pose = std::make_unique<peer::ErrorHistogram>();
  observations_->discovery = std::make_unique<peer::DurationHistogram>();
}

std::size_t Witnesses::witness_of(std::uint32_t peer) const noexcept {
  return std::min<std::size_t>(observations_->of_peer[peer], size());
}

void Witnesses::join(std::size_t witness, aoim::GroupIndex group, double from) {
  observations_->witnesses[witness].heard_from[group.value] = from;
}

void Witnesses::leave(std::size_t witness, aoim::GroupIndex group, std::size_t pool) {
  observations_->witnesses[witness].heard_from[group.value] = kNever;
  if (pool > 0) observations_->witnesses[witness].leave(group, pool - 1);
}

void Witnesses::set_foci(std::size_t witness, std::span<const aoim::Focus> foci) {
  observations_->witnesses[witness].interest.set_foci(foci);
}

void Witnesses::gather(double time, const Crowd& crowd, double reach,
                       const std::function<HeardBefore(std::uint32_t)>& heard) {
  std::ranges::fill(observations_->near, 0);
  for (std::size_t w = 0; w < size(); ++w) {
    Witness& witness = observations_->witnesses[w];
    for (auto& [entity, known] : witness.known) known.near = false;
    aoim::Position least{kNever, kNever, 0}, most{-kNever, -kNever, 0};
    for (std::uint32_t i = witness.owned.first; i < witness.owned.end; ++i) {
      const aoim::Position& place = crowd.position(i);
      least = {std::min(least.x, place.x), std::min(least.y, place.y), 0};
      most = {std::max(most.x, place.x), std::max(most.y, place.y), 0};
    }
    const double wide = observations_->radius + reach;
    for (std::uint32_t i = 0; i < crowd.size(); ++i) {
      const aoim::Position& place = crowd.position(i);
      if (place.x < least.x - wide || place.x > most.x + wide || place.y < least.y - wide ||
          place.y > most.y + wide || (i >= witness.owned.first && i < witness.owned.end) ||
          !witness.is_inside(place, crowd, wide))
        continue;
      const auto [row, is_new] = witness.known.try_emplace(i);
      row->second.near = true;
      observations_->near[i] |= std::uint64_t{1} << (w % 64);
      if (!is_new) continue;
      const HeardBefore before = heard(i);
      row->second.behind.resize(observations_->near_rows);
      if (witness.heard_from[before.group.value] > time) continue;
      static_cast<Witness::Told&>(row->second) = {before.state, time, before.group};
      std::ranges::fill(row->second.behind, static_cast<const Witness::Told&>(row->second));
    }
    // Whoever is far is forgotten, as a state table drops what has left.
    std::erase_if(witness.known, [](const auto& row) { return !row.second.near; });
  }
}

bool Witnesses::is_near(std::uint32_t entity) const noexcept {
  return observations_->near[entity] != 0;
}

void Witnesses::send(const SentUpdate& update, const deadreckon::KinematicState& state) {
  for (std::size_t w = 0; w < size(); ++w) {
    if ((observations_->near[update.entity] >> (w % 64) & 1) == 0) continue;
    Witness& witness = observations_->witnesses[w];
    if (witness.peer == update.sender) continue;
    const auto known = witness.known.find(update.entity);
    if (known == witness.known.end()) continue;
    // Who is not near has not joined what is for those alone who are.
    if (update.pool > 0 && witness.heard_from[update.group.value] == kNever) continue;
    const bool wanted = witness.is_taken(state.position, known->second.shown);
    observations_->wanted += wanted;
    // Lost or late as its datagram is.
    const peer::Fate fate =
        witness.network.decide(update.sender, update.datagram, pdu::from_seconds(update.left));
    const double arrives = update.left + pdu::to_seconds(fate.delay[0]);
    if (arrives < witness.heard_from[update.group.value]) {
      observations_->missed += wanted;
      continue;
    }
    if (fate.copies == 0) {
      observations_->lost += wanted;
      continue;
    }
    const std::size_t row = update.pool > 0 ? update.pool - 1 : observations_->near_rows;
    witness.under_way.push_back(
        {arrives, update.time, update.entity, row, {state, update.time, update.group}});
  }
}

void Witnesses::look(double time, Crowd& crowd) {
  for (Witness& witness : observations_->witnesses) {
    witness.take(time);
    for (auto& [entity, known] : witness.known) {
      const auto shown = witness.show(known, time);
      if (!witness.is_inside(crowd.position(entity), crowd, observations_->radius)) {
        known.inside = kNever;
        continue;
      }
      if (known.inside == kNever) known.inside = time;
      ++observations_->looks;
      if (!shown) {
        ++observations_->unseen;
        continue;
      }
      if (known.inside != kTold) {
        observations_->discovery->add(pdu::from_seconds(time - known.inside));
        known.inside = kTold;
      }
      observations_->pose->add((*shown - crowd.motion(entity).position).norm());
    }
  }
}

void Witnesses::report(ScaleCounts& counts) const {
  counts.witnesses = size();
  counts.wanted = observations_->wanted;
  counts.missed = observations_->missed;
  counts.lost = observations_->lost;
  counts.looks = observations_->looks;
  counts.unseen = observations_->unseen;
  counts.pose = observations_->pose->spread();
  counts.discovery = peer::percentiles(*observations_->discovery);
}

}  // namespace reckon::bench
