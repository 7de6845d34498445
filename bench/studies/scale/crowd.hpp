// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// True positions of the entities of a large exercise: movement generated from a seed, or copies of
// recorded tracks side by side until there are enough.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <random>
#include <span>
#include <string_view>
#include <vector>

#include "reckon/aoim/cells/position.hpp"
#include "reckon/bench/studies/tracks/track.hpp"
#include "reckon/deadreckon/motion/motion_history.hpp"
#include "reckon/peer/tracks/entity_track.hpp"

namespace reckon::bench {

/// How an entity moves. In each leg its turn rate and along-track acceleration are constant. All
/// entities stay in a square whose edges reflect them.
struct Gait {
  std::string_view name;
  std::string_view meaning;
  double top_speed;       ///< [m/s]; 0: at rest
  double acceleration;    ///< [m/s^2] towards the next leg's speed; 0: at once
  double turn_rate;       ///< [rad/s] in a bend
  double bend_share;      ///< of the legs
  double leg;             ///< mean length of a leg [s], exponential
  double heading_change;  ///< [rad] at most, instantly at the begin of a leg
};

/// THE list of movements. Also "mixed": half at rest, three tenths vehicles, a fifth walkers.
inline constexpr std::array kGaits{
    Gait{"rest", "nothing moves", 0, 0, 0, 0, 1e9, 0},
    Gait{"walkers", "1.5 m/s, sharp turns every few seconds", 1.5, 0, 0, 0, 4, 2.0},
    Gait{"vehicles", "up to 14 m/s, bends, stops", 14, 2.5, 0.3, 0.3, 5, 0},
    Gait{"flyers", "200 m/s, wide turns", 200, 0, 0.1, 0.6, 10, 0},
};
inline constexpr std::string_view kMixedGait = "mixed";

/// Parameters of a crowd.
struct CrowdPlan {
  std::string_view movement = kMixedGait;  ///< of kGaits, or kMixedGait; unused with tracks
  std::size_t entities = 1000;             ///< >= 1
  double density = 400;                    ///< entities a square kilometre
  std::uint64_t seed = 1;
  std::span<const Track> tracks = {};  ///< recorded, each longer than the study
};

/// All entities at one instant. Neighbours in the plane have close numbers. Equal plans
/// give equal crowds. One thread; some 100 octets an entity, 400 on tracks.
class Crowd {
 public:
  /// @throws UsageError for an unknown movement; lists the known ones
  explicit Crowd(const CrowdPlan& plan);

  /// Moves all to `time` [s] since the start, not before the previous one; some 30 ns an entity.
  void advance(double time);

  [[nodiscard]] std::size_t size() const noexcept { return places_.size(); }
  /// Present position [m, S], z = 0 for movement from a seed.
  [[nodiscard]] const aoim::Position& position(std::size_t entity) const noexcept {
    return places_[entity];
  }
  /// Present motion, at the time of the last advance().
  [[nodiscard]] deadreckon::MotionSample motion(std::size_t entity) noexcept;
  [[nodiscard]] double speed(std::size_t entity) const noexcept;
  /// False for an entity that never moves.
  [[nodiscard]] bool moves(std::size_t entity) const noexcept;
  /// Side of the square around the origin that holds all entities at the start [m].
  [[nodiscard]] double side() const noexcept { return side_; }

 private:
  struct Walker {
    double heading = 0, speed = 0, turn = 0, acceleration = 0;
    double leg_end = 0;  ///< [s]
    std::uint32_t draws = 0;
    std::uint8_t gait = 0;
  };
  void place_walkers(const CrowdPlan& plan);
  void place_tracks(const CrowdPlan& plan);
  void advance_walker(std::size_t entity, double time);
  void begin_leg(std::size_t entity, double time);
  void reflect(std::size_t entity);
  [[nodiscard]] double draw(std::size_t entity) noexcept;  // 0 <= x < 1

  std::vector<aoim::Position> places_;
  std::vector<Walker> walkers_;                       // one an entity, or none
  std::vector<peer::EntityTrack> tracks_;             // one an entity, or none
  std::vector<deadreckon::KinematicState> recorded_;  // present states of tracks_
  std::uint64_t seed_ = 1;
  double side_ = 0, time_ = 0;
};

}  // namespace reckon::bench
