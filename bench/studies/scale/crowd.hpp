// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Where the entities of a large exercise truly are: movement made by a seed, or recorded tracks
// that are laid side by side until there are enough.
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

/// How an entity moves from one decision to the next: at constant turn rate and along-track
/// acceleration, then another leg. All entities stay in a square, whose edges throw them back.
struct Gait {
  std::string_view name;
  std::string_view meaning;
  double top_speed;       ///< [m/s]; 0 stands
  double acceleration;    ///< [m/s^2] towards the next leg's speed; 0: at once
  double turn_rate;       ///< [rad/s] in a bend
  double bend_share;      ///< of the legs
  double leg;             ///< mean length of a leg [s], exponential
  double heading_change;  ///< [rad] at most, at once, where a leg begins
};

/// THE list of movements; "mixed" beside it: half at rest, three tenths vehicles, a fifth walkers.
inline constexpr std::array kGaits{
    Gait{"rest", "nothing moves", 0, 0, 0, 0, 1e9, 0},
    Gait{"walkers", "1.5 m/s, sharp turns every few seconds", 1.5, 0, 0, 0, 4, 2.0},
    Gait{"vehicles", "up to 14 m/s, bends, stops", 14, 2.5, 0.3, 0.3, 5, 0},
    Gait{"flyers", "200 m/s, wide turns", 200, 0, 0.1, 0.6, 10, 0},
};
inline constexpr std::string_view kMixedGait = "mixed";

/// What a crowd is made from.
struct CrowdPlan {
  std::string_view movement = kMixedGait;  ///< of kGaits, or kMixedGait; no part where tracks are
  std::size_t entities = 1000;             ///< >= 1
  double density = 400;                    ///< entities a square kilometre
  std::uint64_t seed = 1;
  std::span<const Track> tracks = {};  ///< recorded ones, each longer than the study
};

/// All entities at one instant, neighbours in the plane next to each other in number. Equal plans
/// give equal crowds. One thread; some 100 octets an entity, 400 on tracks.
class Crowd {
 public:
  /// @throws UsageError where the movement is not known, naming those that are
  explicit Crowd(const CrowdPlan& plan);

  /// Moves all to `time` [s] since the start, not before the last one; some 30 ns an entity.
  void advance(double time);

  [[nodiscard]] std::size_t size() const noexcept { return places_.size(); }
  /// Present position [m, S], z = 0 where movement is made by a seed.
  [[nodiscard]] const aoim::Position& position(std::size_t entity) const noexcept {
    return places_[entity];
  }
  /// Present motion; its time is that of the last advance().
  [[nodiscard]] deadreckon::MotionSample motion(std::size_t entity) noexcept;
  [[nodiscard]] double speed(std::size_t entity) const noexcept;
  /// False for what never moves.
  [[nodiscard]] bool moves(std::size_t entity) const noexcept;
  /// [m] of the square around the origin that holds them at the start.
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
  std::vector<Walker> walkers_;                       // as many, or none
  std::vector<peer::EntityTrack> tracks_;             // as many, or none
  std::vector<deadreckon::KinematicState> recorded_;  // of tracks_, now
  std::uint64_t seed_ = 1;
  double side_ = 0, time_ = 0;
};

}  // namespace reckon::bench
