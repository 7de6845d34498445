// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The choices of the touch adversary: two to four hands, their devices, line, faults and lies, as a
// vector of numbers in ranges that is read and written as one line.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <random>
#include <string>
#include <string_view>
#include <vector>

namespace reckon::fuzz {

/// Genes of the whole scenario. Units and ranges: genes().
enum class Shared : std::size_t {
  hands,
  stiffness,
  grip,
  grip_damping,
  mass,
  damping,
  friction,
  hardening,
  record_damping,
  delay,
  jitter,
  loss,
  rate,
  threshold,
  overlap,
  outage_at,
  outage_for,
  late,
  late_by,
  holds,
  failed,
  failed_run,
  calm_after,
  device_delay,
  servo_rate,
  encoder,
  other_hand,
  other_delay,
  other_rate,
  duplicates,
  unknown_hand,
  unknown_until,
  silent_hand,
  silent_at,
  silent_for,
  silent_move,
  off_hand,
  off_at,
  off_for,
  wall,
  wall_gap,
  wall_tilt,
  solid,
  solid_stiffness,
  solid_gap,
  solid_tilt,
  effect,
  effect_strength,
  region,
  region_strength,
  region_off,
  body,
  body_mass,
  body_size,
  body_stiffness,
  body_drop,
  body_beside,
  body_turned,
  body_floor,
  pile,
  pile_mass,
  pile_bounce,
  paddle,
  paddle_mass,
  paddle_turned,
  liar,
  lie_given,
  lie_need,
  lie_wave,
  lie_softest,
  lie_jump,
  lie_swing,
  lie_odd,
  lie_rename,
  model,
  model_damping,
  chain,
  phase_in,
  phase_out,
  lag,
  report,
  stated,
  drawn,
  drawn_seed,
  fault,
  fault_at,
  fault_for,
  fault_every,
  count
};

/// The device of the first hand.
enum class Model { simulated, falcon, polhem, board, event };
/// What is drawn beside the first hand, see test::DrawnTouch.
enum class Drawn { nothing, walls, effects, bodies };
/// What falls through the place of the first hand.
enum class Falling { nothing, box, ball };
/// The fault of the first hand's device; a fault that its kind does not have is none.
enum class Fault {
  none,
  hang,      ///< transfers on its line do not end
  mute,      ///< no reports
  cut,       ///< a transfer is refused, or ends early
  damage,    ///< of reports
  disorder,  ///< reports in pieces, twice, swapped
  errors,    ///< of the line
  reset,     ///< of its port
  unplug,
  power,   ///< unplugged, with loss of power
  silence  ///< the servo does not step
};

/// Genes of the path of one hand's grip.
enum class Path : std::size_t {
  kind,
  begin,
  rise,
  press,
  amplitude,
  frequency,
  phase,
  side,
  count
};

inline constexpr std::size_t kMostHands = 4;
inline constexpr std::size_t kShared = static_cast<std::size_t>(Shared::count);
inline constexpr std::size_t kPath = static_cast<std::size_t>(Path::count);
inline constexpr std::size_t kGenes = kShared + kMostHands * kPath;

/// One number that may be chosen.
struct Gene {
  std::string name;
  double low, high;
  double plain;                 ///< its neutral value
  bool whole;                   ///< takes whole numbers only
  double rarely_above = 1e300;  ///< a search draws higher values one time in ten
};

/// All genes; those of paths as press1 .. press4.
[[nodiscard]] const std::array<Gene, kGenes>& genes();

/// Equal scenarios give equal runs: the line and the faults draw from `seed`.
struct Scenario {
  std::uint32_t seed = 1;
  std::array<double, kGenes> values{};

  /// Two hands that hold still on a line without fault.
  Scenario();
  [[nodiscard]] double& operator[](Shared gene) { return values[static_cast<std::size_t>(gene)]; }
  [[nodiscard]] double operator[](Shared gene) const {
    return values[static_cast<std::size_t>(gene)];
  }
  [[nodiscard]] static std::size_t index(std::size_t hand, Path gene) {
    return kShared + hand * kPath + static_cast<std::size_t>(gene);
  }
  [[nodiscard]] double& path(std::size_t hand, Path gene) { return values[index(hand, gene)]; }
  [[nodiscard]] double path(std::size_t hand, Path gene) const { return values[index(hand, gene)]; }
  /// Removes genes without effect, such as lies without a liar.
  void tidy();
  /// The value of device `hand`: `other` for the one that differs, else `all`.
  [[nodiscard]] double of_device(std::size_t hand, Shared all, Shared other) const {
    return (*this)[(*this)[Shared::other_hand] == static_cast<double>(hand + 1) ? other : all];
  }
  [[nodiscard]] Model model() const { return static_cast<Model>((*this)[Shared::model]); }
  [[nodiscard]] std::size_t hands() const {
    return static_cast<std::size_t>((*this)[Shared::hands]);
  }
  friend bool operator==(const Scenario&, const Scenario&) = default;

 private:
  void tidy_model();
};

/// "seed=7 stiffness=812.5 press1=0.02": all values that are not neutral, exact to the last bit.
[[nodiscard]] std::string line_of(const Scenario& scenario);
/// @throws std::invalid_argument with the word, its fault and the permitted values
[[nodiscard]] Scenario scenario_of(std::string_view line);
/// The genes that a line names. The same errors.
[[nodiscard]] std::vector<std::size_t> genes_in(std::string_view line);

using Random = std::mt19937_64;
/// A random scenario: about half of the faults and lies are neutral.
[[nodiscard]] Scenario any_scenario(Random& random);
/// A neighbour: one to four numbers moved, drawn again or made neutral.
[[nodiscard]] Scenario neighbour(const Scenario& scenario, Random& random);

}  // namespace reckon::fuzz
