// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/tests/fuzz/touch/rest.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "reckon/tests/fuzz/touch/hand.hpp"
#include "reckon/tests/fuzz/touch/solids.hpp"

namespace reckon::fuzz {
namespace {

constexpr double kLongAfter = 1e9;                // [s]
constexpr double kAnyStiffness = 1e9;             // [N/m], more than any region's
constexpr double kFeltLeast = 0.2;                // [N], less is not judged
constexpr double kOff = 0.2, kOffLeast = 0.1;     // share of the right force; [N]
constexpr double kLack = 0.1, kLackLeast = 0.05;  // share of the right force; [N]

constexpr double kBack = 1, kHomed = 5;  // [s]
constexpr double kSlow = 0.5;            // [s], of a press against a soft spring
constexpr double kReach = 0.02;          // [m], of a hand that holds a model

bool is_still(const Scenario& s, std::size_t hand) {
  return s.path(hand, Path::amplitude) == 0 && s.path(hand, Path::side) == 0;
}

std::vector<double> goals_of(const Scenario& s, double time) {
  std::vector<double> goals;
  for (std::size_t i = 0; i < s.hands(); ++i)
    goals.push_back(home_of(s, i) + way_of(s, i, time).x());
  return goals;
}

// A damper takes part of the stiffness that its own device can show.
double stiffness_between(const Scenario& s, const Shows& one, const Shows& other) {
  const double damper = std::min(s[Shared::record_damping], 0.5 * s[Shared::damping]);
  const double left = 1 - damper / s[Shared::damping];
  return std::min({s[Shared::stiffness], left * one.hands, left * other.hands});
}

// A wall whose normal is along x: two springs in a row.
double wall_force(const Scenario& s, const Shows& shows, std::size_t hand, double time) {
  const double depth = -s[Shared::wall_gap] - way_of(s, hand, time).x();
  const double wall = std::min(s[Shared::wall], shows.walls), grip = s[Shared::grip];
  return std::max(0.0, depth) * wall * grip / (wall + grip);
}

// The forces of a row in which the bits of `pressed` mark the touching neighbours; false if these
// are not the ones that touch.
bool solve_row(const Scenario& s, const std::vector<double>& goals,
               const std::vector<double>& springs, std::size_t pressed,
               std::vector<double>& forces) {
  const auto size = static_cast<Eigen::Index>(goals.size());
  Eigen::MatrixXd a = s[Shared::grip] * Eigen::MatrixXd::Identity(size, size);
  Eigen::VectorXd b = s[Shared::grip] * Eigen::Map<const Eigen::VectorXd>(goals.data(), size);
  for (Eigen::Index i = 0; i + 1 < size; ++i) {
    if (((pressed >> i) & 1) == 0) continue;
    const double k = springs[static_cast<std::size_t>(i)];
    a.block<2, 2>(i, i) += k * Eigen::Matrix2d{{1, -1}, {-1, 1}};
    b(i) -= k * 2 * kRadius;
    b(i + 1) += k * 2 * kRadius;
  }
  const Eigen::VectorXd x = a.partialPivLu().solve(b);
  forces.assign(goals.size(), 0.0);
  for (Eigen::Index i = 0; i + 1 < size; ++i) {
    const double depth = 2 * kRadius - (x(i + 1) - x(i));
    if ((depth > 0) != (((pressed >> i) & 1) != 0)) return false;
    const auto at = static_cast<std::size_t>(i);
    const double force = springs[at] * std::max(0.0, depth);
    forces[at] = std::max(forces[at], force);
    forces[at + 1] = std::max(forces[at + 1], force);
  }
  return true;
}

// A wall that a device renders must be uploaded before the hand is in it, else it begins deeper.
// The same holds for hands, and for effects removed in between.
bool is_told_in_time(const Scenario& s) {
  const auto fault = static_cast<Fault>(s[Shared::fault]);
  const bool is_taken_off = fault != Fault::none && fault != Fault::damage;
  return s[Shared::wall] > 0 && s[Shared::late] == 0 && !is_taken_off &&
         s[Shared::wall_gap] >= event_way(s);
}

// When a model has surely recovered from its fault, is homed and at its goal.
double mended_at(const Scenario& s) {
  const double last = s[Shared::fault_every] > 0 ? s[Shared::calm_after] : s[Shared::fault_at];
  return last + s[Shared::fault_for] + (s.model() == Model::polhem ? kHomed : kBack);
}

// The force of the region about hand `hand`, at `place` from the region's origin [N].
Eigen::Vector3d region_pull(const haptics::DeclaredRegionEffects& effects,
                            const Eigen::Vector3d& place) {
  const double way = place.norm();
  if (!(way > 0) && effects.find<haptics::ConstantForce>() == nullptr)
    return Eigen::Vector3d::Zero();
  if (const auto* border = effects.find<haptics::BorderSpring>())
    return -border->stiffness * std::max(0.0, 1 - kRegion / way) * place;
  if (const auto* push = effects.find<haptics::ConstantForce>()) return {push->x, push->y, push->z};
  if (const auto* spring = effects.find<haptics::PointSpring>())
    return -std::min(spring->stiffness, spring->most / way) * place;
  const auto* magnet = effects.find<haptics::Attraction>();
  if (magnet == nullptr) return Eigen::Vector3d::Zero();
  const Eigen::Array3d held(1 - magnet->free_x, 1 - magnet->free_y, 1 - magnet->free_z);
  const Eigen::Vector3d counted = held * place.array();
  const double from = counted.norm();
  if (!(from > 0) || from >= magnet->range) return Eigen::Vector3d::Zero();
  const double pull = magnet->force * std::sin(std::numbers::pi * from / magnet->range) / from;
  return -pull * (held * counted.array()).matrix();
}

/// The rest state of a hand in a region of potentials, against its grip.
struct Held {
  Eigen::Vector3d place, force;  ///< from the region's origin [m]; [N]
};

// The share of a potential's force that a device shows which holds springs of `most` [N/m].
double region_share(const haptics::DeclaredRegionEffects& effects, double most) {
  constexpr double kWeightRise = 0.005, kStiffestWeight = 150;  // [m], [N/m]
  double stiffness = 0;
  if (const auto* border = effects.find<haptics::BorderSpring>()) stiffness = border->stiffness;
  if (const auto* spring = effects.find<haptics::PointSpring>()) stiffness = spring->stiffness;
  if (const auto* magnet = effects.find<haptics::Attraction>())
    stiffness = std::numbers::pi * magnet->force / magnet->range;
  if (const auto* push = effects.find<haptics::ConstantForce>())
    stiffness = std::min(std::hypot(push->x, push->y, push->z) / kWeightRise, kStiffestWeight);
  return stiffness > most ? most / stiffness : 1.0;
}

// A spring of at most 50 times the grip's stiffness is followed in small steps.
Held held_in_region(const Scenario& s, std::size_t hand, double most, double time) {
  const haptics::Scene scene = solids_of(s, Eigen::Vector3d::Zero());
  const haptics::SceneRegion& region = scene.regions.front();
  const double share = region_share(region.effects, most);
  const Eigen::Vector3d goal = way_of(s, hand, time) - region.pose.position;
  Held held{goal, share * region_pull(region.effects, goal)};
  for (int i = 0; i < 5'000; ++i) {
    held.place += 0.01 * (goal + held.force / s[Shared::grip] - held.place);
    held.force = share * region_pull(region.effects, held.place);
  }
  return held;
}

// Weight, spring, magnet, border: hands stay well inside the acting region, or outside a border,
// and apart from each other.
bool is_region_promised(const Scenario& s) {
  constexpr double kMargin = 2e-3, kApart = 2 * kRadius + 5e-3;  // [m]
  if (s[Shared::wall] > 0) return false;
  const haptics::Scene scene = solids_of(s, Eigen::Vector3d::Zero());
  const haptics::SceneRegion& region = scene.regions.front();
  const haptics::DeclaredRegionEffects& effects = region.effects;
  const auto* magnet = effects.find<haptics::Attraction>();
  const bool is_border = effects.find<haptics::BorderSpring>() != nullptr;
  const bool is_force = effects.find<haptics::ConstantForce>() != nullptr ||
                        effects.find<haptics::PointSpring>() != nullptr;
  if (magnet != nullptr) {
    if (magnet->force * std::numbers::pi / magnet->range > 0.7 * s[Shared::grip]) return false;
  } else if (!is_border && !is_force) {
    return false;
  }
  double last = -1;
  for (std::size_t i = 0; i < s.hands(); ++i) {
    const Held held = held_in_region(s, i, kAnyStiffness, kLongAfter);
    const double goal = (way_of(s, i, kLongAfter) - region.pose.position).norm();
    if (!is_border && std::max(goal, held.place.norm()) > kRegion - kMargin) return false;
    const double at = home_of(s, i) + held.place.x();
    if (at - last < kApart && i > 0) return false;
    last = at;
  }
  return true;
}

}  // namespace

double event_way(const Scenario& s) {
  constexpr double kMore = 0.012;  // [s], see event_handle.cpp
  constexpr double kSpeed = 1;     // [m/s]
  return kSpeed * (s[Shared::chain] + s[Shared::report] + s[Shared::lag] + kMore);
}

double still_since(const Scenario& s) {
  double since = 0;
  for (std::size_t i = 0; i < s.hands(); ++i) {
    if (!is_still(s, i)) return std::numeric_limits<double>::infinity();
    since = std::max(since, s.path(i, Path::begin) + s.path(i, Path::rise));
  }
  if (s[Shared::off_hand] > 0) since = std::max(since, s[Shared::off_at] + s[Shared::off_for]);
  if (s[Shared::outage_for] > 0) {
    since = std::max(since, s[Shared::outage_at] + s[Shared::outage_for]);
  }
  if (s[Shared::failed] > 0 || s[Shared::late] > 0) since = std::max(since, s[Shared::calm_after]);
  if (s[Shared::fault] > 0) since = std::max(since, mended_at(s));
  if (s[Shared::unknown_hand] > 0) since = std::max(since, s[Shared::unknown_until]);
  if (s[Shared::silent_hand] > 0) {
    since = std::max(since, s[Shared::silent_at] + std::max(kMoved, s[Shared::silent_for]));
  }
  return since;
}

bool is_interrupted(const Scenario& s) {
  return s[Shared::failed] > 0 || s[Shared::fault] > 0 || s[Shared::off_hand] > 0 ||
         s[Shared::outage_for] > 0 || s[Shared::unknown_hand] > 0 || s[Shared::silent_hand] > 0;
}

double depth_of_goals(const Scenario& s) {
  const std::vector<double> goals = goals_of(s, kLongAfter);
  return 2 * kRadius - (goals[1] - goals[0]);
}

bool is_promised(const Scenario& s) {
  using enum Shared;
  for (const Shared gene :
       {friction, hardening, overlap, loss, duplicates, liar, solid, drawn, body}) {
    if (s[gene] > 0) return false;
  }
  if (s[region] > 0 && !is_region_promised(s)) return false;
  const bool quick_line = s[delay] * (1 + s[jitter]) <= 0.05 + 1e-9 &&
                          (s[rate] >= 10 ? s[rate] >= 50 : s[threshold] <= 0.015);
  const bool has_model = s.model() != Model::simulated;
  const bool alike = s[record_damping] == 0 || (s[other_hand] == 0 && !has_model);
  const bool is_event = s.model() == Model::event;
  const bool is_in_reach = !has_model || is_event || std::abs(s.path(0, Path::press)) <= kReach;
  if (is_event && !is_told_in_time(s)) return false;
  if (has_model && std::min(s.path(0, Path::rise), s.path(1, Path::rise)) < kSlow) return false;
  const double into = depth_of_goals(s);
  const bool wall_only = s[wall_tilt] == 0 && s[wall_gap] >= 0 && into <= 0;
  return s.hands() == 2 && quick_line && alike && is_in_reach && (s[wall] == 0 || wall_only) &&
         s[grip] <= 600 && s[grip_damping] >= 1 && into <= kDeepestGoals;
}

std::vector<double> forces_in_a_row(const Scenario& s, const std::vector<Shows>& shows,
                                    double time) {
  const std::vector<double> goals = goals_of(s, time);
  std::vector<double> springs, best(goals.size(), 0.0), forces;
  for (std::size_t i = 0; i + 1 < shows.size(); ++i) {
    springs.push_back(stiffness_between(s, shows[i], shows[i + 1]));
  }
  for (std::size_t pressed = 0; pressed < (std::size_t{1} << springs.size()); ++pressed) {
    if (solve_row(s, goals, springs, pressed, forces)) best = forces;
  }
  return best;
}

std::vector<double> right_forces(const Scenario& s, const std::vector<Shows>& shows, double time) {
  std::vector<double> forces = forces_in_a_row(s, shows, time);
  if (s[Shared::region] > 0) {
    for (std::size_t i = 0; i < forces.size(); ++i)
      forces[i] = held_in_region(s, i, shows[i].regions, time).force.norm();
    return forces;
  }
  if (s[Shared::wall] == 0) return forces;
  for (std::size_t i = 0; i < forces.size(); ++i) forces[i] = wall_force(s, shows[i], i, time);
  return forces;
}

double Rest::lacks() const { return right < kFeltLeast ? 0.0 : std::max(0.0, 1 - shown / right); }

double Rest::off() const { return std::abs(shown - right) / std::max(right, kFeltLeast); }

bool Rest::is_wrong() const {
  const double missing = right - shown;
  if (interrupted && lacks() > kLack && missing > kLackLeast) return true;
  return std::abs(missing) > kOffLeast && std::abs(missing) > kOff * right;
}

}  // namespace reckon::fuzz
