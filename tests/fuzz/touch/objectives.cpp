// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/tests/fuzz/touch/objectives.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <initializer_list>

#include "reckon/haptics/contact/energy_exchange.hpp"
#include "reckon/haptics/passivity/energy_port.hpp"
#include "reckon/tests/fuzz/touch/rest.hpp"

namespace reckon::fuzz {
namespace {

constexpr double kLiarPower = 0.3;  // [W], of any second
constexpr double kSource = 0.05;    // share of a potential's force at rest
constexpr double kPassed = 0.05;    // [s]
constexpr double kPinched = 1.2;    // times the speed of the paddle

void put_out_of_play(Scenario& s, std::initializer_list<Shared> shared) {
  for (const Shared gene : shared) s[gene] = genes()[static_cast<std::size_t>(gene)].plain;
}

// Without device models, which have objectives of their own.
void anything(Scenario& s) { s[Shared::model] = 0; }

void anything_through_a_model(Scenario& s) { s[Shared::model] = std::max(1.0, s[Shared::model]); }

// Hands that come to rest, with springs as the only effect, on a line that delivers everything
// soon.
void honest_rest(Scenario& s) {
  using enum Shared;
  s[model] = 0;
  put_out_of_play(
      s, {friction, hardening, loss, overlap, duplicates, late, solid, effect, region, liar});
  s[grip] = std::clamp(s[grip], 100.0, 600.0);
  s[grip_damping] = std::max(s[grip_damping], 2.0);
  s[delay] = std::min(s[delay], 0.038);
  s[jitter] = std::min(s[jitter], 0.3);
  s[threshold] = std::min(s[threshold], 0.015);
  if (s[rate] > 0) s[rate] = std::max(s[rate], 50.0);
  if (s[other_hand] > 0) s[record_damping] = 0;
  for (std::size_t hand = 0; hand < kMostHands; ++hand) {
    s.path(hand, Path::amplitude) = s.path(hand, Path::side) = 0;
  }
}

void keep_sides(Scenario& s) {
  double& press = s.path(0, Path::press);
  press = std::min(press, s.path(1, Path::press) + kDeepestGoals - 1e-4);
  if (s[Shared::silent_hand] > 0)
    s[Shared::silent_move] = std::clamp(s[Shared::silent_move], -0.01, 0.01);
}

void press_slowly(Scenario& s) {
  for (std::size_t hand = 0; hand < kMostHands; ++hand) {
    s.path(hand, Path::begin) = std::min(s.path(hand, Path::begin), 0.5);
    s.path(hand, Path::rise) = std::max(s.path(hand, Path::rise), 1.0);
  }
}

void uninterrupted(Scenario& s) {
  using enum Shared;
  put_out_of_play(s, {wall, outage_at, outage_for, failed, off_hand, unknown_hand, silent_hand});
}

void two_at_rest(Scenario& s) {
  honest_rest(s);
  press_slowly(s);
  uninterrupted(s);
  s[Shared::hands] = 2;
  keep_sides(s);
}

void row_at_rest(Scenario& s) {
  two_at_rest(s);
  s[Shared::hands] = std::max(s[Shared::hands], 3.0);
}

// All faults are over after 3.5 s. Hands that keep apart press a wall.
void interrupted_rest(Scenario& s) {
  using enum Shared;
  constexpr double kLast = 3.5;
  honest_rest(s);
  s[hands] = 2;
  s[calm_after] = std::min(s[calm_after], kLast);
  s[off_for] = std::min(s[off_for], kLast - s[off_at]);
  s[outage_for] = std::min(s[outage_for], kLast - s[outage_at]);
  s[silent_for] = std::min(s[silent_for], kLast - s[silent_at]);
  for (std::size_t hand = 0; hand < kMostHands; ++hand) {
    s.path(hand, Path::begin) = std::min(s.path(hand, Path::begin), 1.5);
  }
  keep_sides(s);
  if (s[wall] == 0) return;
  s[wall_tilt] = 0;
  s[wall_gap] = std::abs(s[wall_gap]);
  s.path(0, Path::press) = -std::abs(s.path(0, Path::press));
  s.path(1, Path::press) = std::abs(s.path(1, Path::press));
  s[silent_hand] = 0;
}

// The wall is uploaded before the hand is in it.
void press_a_rendered_wall(Scenario& s) {
  using enum Shared;
  put_out_of_play(s, {late, lag, report});
  s[wall] = std::max(s[wall], 100.0);
  s[chain] = std::min(s[chain], 0.004);
  s[wall_gap] = std::max(s[wall_gap], event_way(s));
  s.path(0, Path::press) = -std::max(std::abs(s.path(0, Path::press)), 0.03);
}

// The same through a device model, where all faults are over after 1.5 s: it may need homing again.
void model_at_rest(Scenario& s) {
  using enum Shared;
  constexpr double kLast = 1.5, kReach = 0.02;
  const double model_before = s[model];
  interrupted_rest(s);
  s[model] = std::max(1.0, model_before);
  put_out_of_play(s, {record_damping, failed, drawn, silent_hand});
  press_slowly(s);
  s[calm_after] = std::min(s[calm_after], kLast);
  s[fault_at] = std::min(s[fault_at], kLast);
  if (s.model() == Model::event) return press_a_rendered_wall(s);
  s.path(0, Path::press) = std::clamp(s.path(0, Path::press), -kReach, kReach);
  keep_sides(s);
}

// The second hand lies to the first, which rests.
void resting(Scenario& s) {
  using enum Shared;
  put_out_of_play(
      s, {hands, friction, hardening, record_damping, overlap, late, failed, off_hand, wall, solid,
          effect, region, body, lie_odd, lie_rename, silent_hand, unknown_hand});
  s[liar] = 2;
  s[model] = 0;
  s.path(0, Path::press) = s.path(0, Path::amplitude) = s.path(0, Path::side) = 0;
  s.path(1, Path::side) = 0;
}

// The same over a fast line that treats liar and twin alike, with grips that do not ring. The path
// does not lead through the other's centre: there the twin's run would differ without any lie.
void resting_on_a_fair_line(Scenario& s) {
  using enum Shared;
  resting(s);
  put_out_of_play(s, {jitter, loss, duplicates, outage_for});
  s[delay] = std::min(s[delay], 0.02);
  s[grip_damping] = std::max(s[grip_damping], 2.0);
  s[mass] = std::min(s[mass], 0.3);
  double& amplitude = s.path(1, Path::amplitude);
  amplitude = std::min(amplitude, 0.015);
  s.path(1, Path::press) = std::max(s.path(1, Path::press), amplitude - kDeepestGoals);
}

// Hands that keep apart, each in a region of its own: weight, spring, magnet or border, or outside
// of the border.
void resting_in_a_region(Scenario& s) {
  using enum Shared;
  constexpr std::array kPotentials{3.0, 4.0, 5.0, 7.0};  // rows of haptics::RegionTypes
  constexpr double kBorder = 7, kOutside = 0.032, kInside = 0.018;
  const double kind = *std::lower_bound(kPotentials.begin(), kPotentials.end() - 1, s[region]);
  const double strength = s[region_strength], off = s[region_off];
  two_at_rest(s);
  put_out_of_play(s, {body});
  s[region] = kind;
  s[region_strength] = strength;
  s[region_off] = kind == kBorder ? std::max(kOutside, off) : std::min(kInside, off);
  s.path(0, Path::press) = -std::min(std::abs(s.path(0, Path::press)), 0.008);
  s.path(1, Path::press) = std::clamp(std::abs(s.path(1, Path::press)), 0.006, 0.008);
}

void a_body_falls(Scenario& s) {
  using enum Shared;
  put_out_of_play(s, {model, wall, solid, region});
  s[body] = std::max(1.0, s[body]);
  s[body_mass] = std::max(0.3, s[body_mass]);
}

void a_heap_is_far(Scenario& s) {
  s[Shared::model] = 0;
  s[Shared::pile] = std::max(2.0, s[Shared::pile]);
}

void a_cube_is_pinched(Scenario& s) {
  s[Shared::model] = 0;
  s[Shared::paddle] = std::max(0.2, s[Shared::paddle]);
}

std::string joules(double value) { return fmt::format("{:.3g} mJ", 1e3 * value); }

std::string energy_text(const Outcome& o) {
  return fmt::format("least port {}, under a force {}, least sum {}, late samples took {}",
                     joules(o.least_port), joules(o.least_held), joules(o.least_sum),
                     joules(o.late_cost));
}

double energy(const Outcome& o) { return -o.least_held - o.least_sum; }
double meter(const Outcome& o) { return o.meter; }
double rate(const Outcome& o) { return o.excess; }
// A reported reduction is no violation and counts half: unreported errors are worse.
double wrong(const Outcome& o) { return o.told ? 0.5 * o.wrong : o.wrong; }
double hiccup(const Outcome& o) { return o.told ? 0.5 * o.lacks : o.lacks; }
double made(const Outcome& o) { return -o.model.left; }
double claimed(const Outcome& o) { return o.model.claimed; }
double rows(const Outcome& o) { return o.rows; }
double unseen(const Outcome& o) { return o.unseen; }
// A contact of any length is worse than none.
double haunted(const Outcome& o) { return o.haunted + 1e-4 * o.pushed; }
double pinched(const Outcome& o) { return o.pinched; }
// Scales: 1 mN and 1 um.
double heap(const Outcome& o) { return std::max(1e3 * o.heap_force, 1e6 * o.heap_place); }
// Energy that a slowly loaded spring gives back within 50 ms is printed beside it.
double liar(const Outcome& o) { return o.liar.power / kLiarPower; }

std::string meter_text(const Outcome& o) { return joules(o.meter) + " above the device's books"; }
std::string made_text(const Outcome& o) {
  if (o.model.made == ModelBooks().made) return "no force of a model's";
  const std::string made = joules(o.model.made) + " made beyond what is stated";
  if (o.model.left == ModelBooks().left) return made;
  return made + fmt::format(", {:.3g} % left of what was put in", 100 * o.model.left);
}
std::string claimed_text(const Outcome& o) {
  if (o.model.claimed == ModelBooks().claimed) return "no force of a model's";
  return joules(o.model.claimed) + " above the model's books and what is stated";
}
std::string rate_text(const Outcome& o) {
  return fmt::format("{:.3g} N beyond the limit", o.excess);
}
std::string wrong_text(const Outcome& o) {
  return fmt::format("{:.1f} % off{}", 100 * o.wrong, o.told ? ", told" : "");
}
std::string hiccup_text(const Outcome& o) {
  return fmt::format("{:.1f} % missing{}", 100 * o.lacks, o.told ? ", told" : "");
}
std::string rows_text(const Outcome& o) { return fmt::format("{:.1f} % off", 100 * o.rows); }
std::string unseen_text(const Outcome& o) {
  return joules(o.unseen) + " and 50 mW beyond what surfaces did";
}
std::string haunted_text(const Outcome& o) {
  return fmt::format("for {:.3g} s of a body that has passed", o.haunted);
}
std::string pinched_text(const Outcome& o) {
  return fmt::format("{:.3g} times as fast as the paddle", o.pinched);
}
std::string heap_text(const Outcome& o) {
  return fmt::format("{:.3g} mN and {:.3g} um beside the same without the heap", 1e3 * o.heap_force,
                     1e6 * o.heap_place);
}
std::string liar_text(const Outcome& o) {
  return fmt::format("{:.3g} W in a second and {} in 50 ms beyond an honest twin", o.liar.power,
                     joules(o.liar.burst));
}

}  // namespace

const std::vector<Objective>& objectives() {
  constexpr double kUnseen = haptics::EnergyPort::kUnseen + haptics::kGreatestLoan;
  static const std::vector<Objective> all = {
      {"energy", 3, energy, energy_text, anything},
      {"meter", 3, meter, meter_text, anything},
      {"rate", 3, rate, rate_text, anything},
      {"wrong", 6.6, wrong, wrong_text, two_at_rest},
      {"hiccup", 7.6, hiccup, hiccup_text, interrupted_rest},
      {"rows", 7, rows, rows_text, row_at_rest},
      {"unseen", 4, unseen, unseen_text, resting, kUnseen},
      {"model_energy", 3, made, made_text, anything_through_a_model},
      {"model_meter", 3, claimed, claimed_text, anything_through_a_model},
      {"dead", 11, wrong, wrong_text, model_at_rest},
      {"source", 6.6, wrong, wrong_text, resting_in_a_region, kSource},
      {"passed", 3, haunted, haunted_text, a_body_falls, kPassed},
      {"heap", 2, heap, heap_text, a_heap_is_far, 1.0, try_beside_heap},
      {"pinched", 3, pinched, pinched_text, a_cube_is_pinched, kPinched},
      {"liar", 4, liar, liar_text, resting_on_a_fair_line, 1.0, try_beside_twin},
  };
  return all;
}

Outcome judged(const Objective& objective, const Scenario& scenario, bool strict) {
  Outcome outcome = objective.run(scenario, objective.seconds);
  if (outcome.violation.empty() && (strict || !outcome.told)) {
    outcome.violation = outcome.wrong_force;
  }
  Scenario allowed = scenario;
  objective.rules(allowed);
  allowed.tidy();
  const bool too_bad = allowed == scenario && objective.badness(outcome) > objective.most;
  if (too_bad && outcome.violation.empty()) {
    outcome.violation = objective.name + ": " + objective.text(outcome);
  }
  return outcome;
}

}  // namespace reckon::fuzz
