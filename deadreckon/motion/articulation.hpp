// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Dead reckoning of articulated parts: turrets, guns, flaps, gear. An Entity State carries for each
// part a few numbers and their rates; peers go on from them, the owner compares, and what is shown
// converges, as with the pose.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "reckon/deadreckon/motion/convergence.hpp"

namespace reckon::deadreckon {

/// What of a part moves: SISO UID 58. The metric of its rate is one more.
enum class PartMetric : std::uint8_t {
  position = 1,    ///< Share of the part's way, 0 to 1.
  extension = 3,   ///< [m]
  x = 5,           ///< [m]
  y = 7,           ///< [m]
  z = 9,           ///< [m]
  azimuth = 11,    ///< [rad]
  elevation = 13,  ///< [rad]
  rotation = 15    ///< [rad]
};

/// Angles are kept in (-pi, pi] and compared the shorter way round.
[[nodiscard]] constexpr bool is_angle(PartMetric metric) noexcept {
  return metric >= PartMetric::azimuth;
}

/// One number of one part, with its rate, as an update stated it.
struct PartParameter {
  std::uint32_t part = 0;         ///< Class of the part, SISO UID 59, without the metric.
  std::uint16_t attached_to = 0;  ///< 0 = the entity itself, else a part.
  PartMetric metric = PartMetric::azimuth;
  std::uint8_t change = 0;  ///< Change indicator of the wire: counts changes, 1 again after 255.
  double value = 0;         ///< Unit as the metric says.
  double rate = 0;          ///< The unit a second.
};

/// The same part and metric; each occurs once.
[[nodiscard]] constexpr bool same_place(const PartParameter& a, const PartParameter& b) noexcept {
  return a.part == b.part && a.metric == b.metric;
}

/// All that one update says of an entity's parts. Fixed capacity, no allocation.
class PartState {
 public:
  static constexpr std::size_t kCapacity = 32;

  /// Adds a parameter or replaces the one of its part and metric; angles are wrapped, and `change`
  /// is counted on where the value, rate or attachment is another than before. False, and nothing
  /// changes, for numbers that are not finite and where there is no room.
  bool set(const PartParameter& parameter) noexcept;
  /// Takes one out; nothing happens where it is not there.
  void remove(std::uint32_t part, PartMetric metric) noexcept;
  void clear() noexcept { size_ = 0; }

  [[nodiscard]] std::span<const PartParameter> parameters() const noexcept {
    return {parameters_.data(), size_};
  }
  /// Null where there is none.
  [[nodiscard]] const PartParameter* find(std::uint32_t part, PartMetric metric) const noexcept;

 private:
  friend struct PartReader;
  [[nodiscard]] PartParameter* slot(const PartParameter& like) noexcept;

  std::array<PartParameter, kCapacity> parameters_;
  std::size_t size_ = 0;
};

/// What became of the records of one update.
struct PartReading {
  std::size_t taken = 0;       ///< Values and rates that count.
  std::size_t not_finite = 0;  ///< NaN or infinity.
  std::size_t unknown = 0;     ///< A metric that is not in the list.
  std::size_t no_value = 0;    ///< A rate of something that has no value.
  std::size_t no_room = 0;     ///< Past PartState::kCapacity.
};

/// The parts that the variable parameter records of an Entity State tell: `out` is what they say
/// and nothing else. Records that are no articulated part are passed over, bad ones left out and
/// counted; of two that say the same the last one wins, and a value without a rate stands still.
/// `records`: 16 octets each, what is left over is ignored. Any octets; no allocation.
PartReading from_wire(std::span<const std::byte> records, PartState& out) noexcept;

/// Octets that to_wire writes: a record for each value and one for each rate.
[[nodiscard]] std::size_t wire_size(const PartState& state) noexcept;

/// Writes the records, values rounded to float32: read them back to have what peers have. The rate
/// is written where it is zero too, for receivers that would keep an old one. Returns the octets, 0
/// when `out` is too small.
[[nodiscard]] std::size_t to_wire(const PartState& state, std::span<std::byte> out) noexcept;

/// A parameter at one instant.
struct PartMotion {
  double value = 0;
  double rate = 0;
};

/// The rates of an update are believed for this long [s] where nothing else is said: the time-out
/// of an entity with a heartbeat of 5 s.
inline constexpr double kLongestPartMotion = 12.0;

/// The parameter `tau` seconds after its update: value + rate tau, for `longest` seconds at most;
/// then it stands. Angles wrapped. NaN tau counts as 0. About 10 ns.
[[nodiscard]] PartMotion predict(const PartParameter& parameter, double tau,
                                 double longest = kLongestPartMotion) noexcept;

/// a - b: for angles the shorter way round, in (-pi, pi].
[[nodiscard]] double difference(PartMetric metric, double a, double b) noexcept;

/// By how much parts may be off before an update is sent.
struct PartThresholds {
  /// [rad], default 3 degrees, that of the orientation of an entity.
  double angle = 0.05235987755982989;
  /// [m], default 0.1: 3 degrees at the end of a part of 2 m.
  double length = 0.1;
  /// Of metric `position`, a share of the part's way; default 0.05.
  double share = 0.05;
};

/// Whether peers that have `sent`, `since` seconds old, are wrong about `truth`: a part is off by
/// more than its threshold, has come, gone or been attached elsewhere. `sent` is what peers
/// decoded, `longest` what they hold rates for.
[[nodiscard]] bool should_send(const PartState& truth, const PartState& sent, double since,
                               const PartThresholds& thresholds = {},
                               double longest = kLongestPartMotion) noexcept;

/// The parts of one remote entity as shown: predicted, plus an error that goes to zero by the curve
/// of the convergence. Value and rate are continuous at an update with the cubic. Large errors get
/// more time as those of a pose do: lengths by gentle_speed, angles by gentle_turn. Nothing is
/// carried over of the acceleration of an error under way, so the quintic is for updates that come
/// more slowly than its duration. Times are seconds of one steady clock of the caller's. Not
/// synchronised, no allocation.
class PartConvergence {
 public:
  explicit PartConvergence(const ConvergenceSettings& settings = {},
                           double longest = kLongestPartMotion) noexcept
      : settings_(settings), longest_(longest) {}

  /// An update of the instant `time` takes over at `now`. Parts that are new or attached elsewhere
  /// are shown as received at once, so are lengths off by more than the teleport distance; parts
  /// that are not in it are gone.
  void update(const PartState& state, double time, double now) noexcept {
    update(state, time, now, longest_);
  }
  /// The same; rates are believed for `longest` seconds from this update on.
  void update(const PartState& state, double time, double now, double longest) noexcept;

  /// The newest update.
  [[nodiscard]] const PartState& state() const noexcept { return state_; }
  /// Parameter `i` of state().parameters() as shown at `now`; `i` < its size.
  [[nodiscard]] PartMotion shown(std::size_t i, double now) const noexcept;

 private:
  struct Error {
    PartMotion off;       // shown minus predicted when the update took over
    double duration = 0;  // [s]
  };
  [[nodiscard]] Error error_for(const PartParameter& next, double time, double now,
                                double longest) const noexcept;
  [[nodiscard]] double gentle_duration(PartMetric metric, double off) const noexcept;

  ConvergenceSettings settings_;
  double longest_;
  PartState state_;
  double time_ = 0;   // of the newest update
  double start_ = 0;  // when it took over
  std::array<Error, PartState::kCapacity> errors_{};
};

}  // namespace reckon::deadreckon
