// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/tests/fuzz/touch/scenario.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <initializer_list>
#include <iterator>
#include <stdexcept>
#include <tuple>

#include "reckon/haptics/regions/region_types.hpp"

namespace reckon::fuzz {
namespace {

struct Row {
  const char* name;
  double low, high, plain;
  bool whole;
  double rarely_above = 1e300;
};

constexpr double kMostSurfaceEffects = std::tuple_size_v<haptics::EffectTypes> - 1;
constexpr double kMostRegionEffects = std::tuple_size_v<haptics::RegionTypes>;

constexpr Row kSharedRows[] = {
    {"hands", 2, 4, 2, true},
    {"stiffness", 50, 3000, 500, false},              // [N/m]
    {"grip", 20, 2000, 300, false},                   // [N/m]
    {"grip_damping", 0, 20, 3, false},                // [N s/m]
    {"mass", 0.02, 1, 0.1, false},                    // [kg]
    {"damping", 0.2, 3, 1, false},                    // [N s/m], of the device
    {"friction", 0, 1.5, 0, false},                   // coefficient
    {"hardening", 0, 5e6, 0, false},                  // [N/m^3]
    {"record_damping", 0, 5, 0, false},               // [N s/m]
    {"delay", 0, 0.5, 0, false},                      // [s]
    {"jitter", 0, 1, 0, false},                       // of the delay, to either side
    {"loss", 0, 0.6, 0, false},                       // probability
    {"rate", 0, 500, 0, true},                        // [Hz], below 10 by threshold
    {"threshold", 0.005, 0.2, 0.015, false},          // [N]
    {"overlap", 0, 0.03, 0, false},                   // [m], of neighbours at the start
    {"outage_at", 0, 3, 0, false},                    // [s]
    {"outage_for", 0, 2, 0, false},                   // [s]
    {"late", 0, 0.1, 0, false},                       // probability that a servo step is late
    {"late_by", 0.0005, 0.0088, 0.001, false},        // [s], at most
    {"holds", 0, 1, 0, true},                         // 1: the device releases after 10 ms, not 1.5
    {"failed", 0, 0.01, 0, false},                    // probability that readings begin to fail
    {"failed_run", 1, 5, 1, true},                    // length of such a run
    {"calm_after", 0, 10, 10, false},                 // [s], no step is late, no reading fails
    {"device_delay", 0, 16, 0, true, 4},              // [samples], of a written force
    {"servo_rate", 250, 4000, 1000, false},           // [Hz]
    {"encoder", 0, 1e-4, 0, false},                   // [m], step; 0 is exact, with velocities
    {"other_hand", 0, 4, 0, true},                    // with another device; 0: none
    {"other_delay", 0, 16, 0, true, 4},               // [samples], of that device
    {"other_rate", 250, 4000, 1000, false},           // [Hz], of that device
    {"duplicates", 0, 0.6, 0, false},                 // probability of an unfiltered duplicate
    {"unknown_hand", 0, 4, 0, true},                  // undiscovered hand; 0: none
    {"unknown_until", 0, 3, 0, false},                // [s]
    {"silent_hand", 0, 4, 0, true},                   // hand without received updates; 0: none
    {"silent_at", 0, 3, 1, false},                    // [s]
    {"silent_for", 0, 3, 0, false},                   // [s]; a model expires after 0.72 s
    {"silent_move", -0.04, 0.04, 0, false},           // [m], of its grip meanwhile; it stays there
    {"off_hand", 0, 4, 0, true},                      // hand that releases its switch; 0: none
    {"off_at", 0, 3, 1, false},                       // [s]
    {"off_for", 0, 1, 0.2, false},                    // [s]
    {"wall", 0, 5000, 0, false},                      // [N/m], static, beside each hand
    {"wall_gap", -0.005, 0.03, 0.01, false},          // [m], from a hand's place
    {"wall_tilt", 0, 6.283185307179586, 0, false},    // [rad], of its normal, from x
    {"solid", 0, 4, 0, true},                         // beside each: wall, box, pit, tetrahedron
    {"solid_stiffness", 0, 5000, 0, false},           // [N/m]
    {"solid_gap", -0.005, 0.03, 0.01, false},         // [m], from a hand's place
    {"solid_tilt", 0, 6.283185307179586, 0, false},   // [rad], of its normal, from x
    {"effect", 0, kMostSurfaceEffects, 0, true},      // row of the surface effect; 0: none
    {"effect_strength", 0, 1, 0.5, false},            // decades of its values, see solids_of()
    {"region", 0, kMostRegionEffects, 0, true},       // row of the effect of its ball; 0: none
    {"region_strength", 0, 1, 0.5, false},            // the same for the region
    {"region_off", 0, 0.06, 0, false},                // [m], along x, of its centre from that place
    {"body", 0, 2, 0, true},                          // falls on the first hand: box, ball; 0 none
    {"body_mass", 0.004, 20, 0.2, false},             // [kg]
    {"body_size", 0.01, 0.1, 0.04, false},            // [m]
    {"body_stiffness", 50, 2000, 400, false},         // [N/m]
    {"body_drop", 0, 1, 0.1, false},                  // [m], from its lowest point to the place
    {"body_beside", 0, 0.05, 0, false},               // [m], along x, of its centre
    {"body_turned", 0, 6.283185307179586, 0, false},  // [rad], about y
    {"body_floor", 0, 0.5, 0, false},                 // [m], below the place; 0: none
    {"pile", 0, 30, 0, true},                         // cubes that fall in a heap 40 m away
    {"pile_mass", 0.02, 10, 0.2, false},              // [kg], at most, of each
    {"pile_bounce", 0, 1, 0, false},                  // restitution
    {"paddle", 0, 2, 0, false},                       // [m/s], it pinches a cube 20 m away; 0: none
    {"paddle_mass", 0.01, 5, 0.1, false},             // [kg], of that cube
    {"paddle_turned", 0, 1.6, 0, false},              // [rad], about z
    {"liar", 0, 4, 0, true},                          // lying hand; 0: none
    {"lie_given", 0, 20, 0, false},                   // [W]
    {"lie_need", 0, 0.2, 0, false},                   // [J]
    {"lie_wave", 0.5, 100, 5, false},                 // [Hz], of changing lies
    {"lie_softest", 0, 1, 1, false},                  // share of the stiffness, in alternation
    {"lie_jump", 0, 0.12, 0, false},                  // [m], false displacement, in alternation
    {"lie_swing", 0, 0.08, 0, false},                 // [m], amplitude of a false swing
    {"lie_odd", 0, 0.3, 0, false},                    // probability of an absurd value
    {"lie_rename", 0, 1, 0, true},                    // another hand every 50 ms
    {"model", 0, 4, 0, true},                         // device model of the first hand
    {"model_damping", 0, 10, 2, false},               // [N s/m], of that model
    {"chain", 0.001, 0.02, 0.006, false},             // [s], stated delay of that model
    {"phase_in", 0, 0.999, 0.5, false},               // [ms] within a frame, of its report
    {"phase_out", 0, 0.999, 0, false},                // [ms] within a frame, when it takes a force
    {"lag", 0, 0.005, 0, false},                      // [s], of its line, timer or program
    {"report", 0.0005, 0.008, 0.001, false},  // [s], between reports of board and event device
    {"stated", 0, 1, 1, false},               // stated share of its damping
    {"drawn", 0, 3, 0, true},                 // drawn beside it: walls, effects, bodies
    {"drawn_seed", 1, 999, 1, true},          // of those and of the hand's path
    {"fault", 0, 10, 0, true},                // its fault
    {"fault_at", 0, 3, 1, false},             // [s]
    {"fault_for", 0, 0.5, 0.02, false},       // [s]
    {"fault_every", 0, 1, 0, false},          // [s], period of repetition; 0: none
};
static_assert(std::size(kSharedRows) == kShared);

constexpr Row kPathRows[] = {
    {"kind", 0, 2, 0, true},                    // stroke, tap, sweep
    {"begin", 0, 2, 0.2, false},                // [s]
    {"rise", 0.02, 2, 0.5, false},              // [s]
    {"press", -0.04, 0.04, 0, false},           // [m]
    {"amplitude", 0, 0.03, 0, false},           // [m]
    {"frequency", 0.2, 15, 1.5, false},         // [Hz]
    {"phase", 0, 6.283185307179586, 0, false},  // [rad]
    {"side", 0, 0.03, 0, false},                // [m], across
};
static_assert(std::size(kPathRows) == kPath);

Gene gene_of(const Row& row, const std::string& ending) {
  return {row.name + ending, row.low, row.high, row.plain, row.whole, row.rarely_above};
}

std::array<Gene, kGenes> make_genes() {
  std::array<Gene, kGenes> all;
  for (std::size_t i = 0; i < kShared; ++i) all[i] = gene_of(kSharedRows[i], "");
  for (std::size_t i = kShared; i < kGenes; ++i) {
    const std::size_t hand = (i - kShared) / kPath + 1;
    all[i] = gene_of(kPathRows[(i - kShared) % kPath], std::to_string(hand));
  }
  return all;
}

double unit(Random& random) { return std::uniform_real_distribution<double>(0, 1)(random); }

// Four digits are enough for a search, and short to read.
double fitting(const Gene& gene, double value) {
  const double inside = std::clamp(value, gene.low, gene.high);
  if (gene.whole) return std::round(inside);
  return std::clamp(std::stod(fmt::format("{:.4g}", inside)), gene.low, gene.high);
}

// Wide ranges, such as delays and grips, are drawn logarithmically as often as evenly.
double drawn(const Gene& gene, Random& random) {
  const double part = unit(random) < 0.5 ? unit(random) : std::pow(10.0, -3.0 * unit(random));
  const double high = unit(random) < 0.1 ? gene.high : std::min(gene.high, gene.rarely_above);
  return fitting(gene, gene.low + part * (high - gene.low));
}

double number_of(std::string_view word, std::string_view text) {
  double value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size()) {
    throw std::invalid_argument(fmt::format("'{}': a number is needed after '='", word));
  }
  return value;
}

const Gene* gene_of(std::string_view name) {
  const auto found = std::find_if(genes().begin(), genes().end(),
                                  [&](const Gene& gene) { return gene.name == name; });
  return found == genes().end() ? nullptr : &*found;
}

// The gene that the word names; null for the seed.
const Gene* read_word(std::string_view word, Scenario& scenario) {
  const auto equals = word.find('=');
  const std::string_view name = word.substr(0, equals);
  const Gene* gene = gene_of(name);
  if (equals == word.npos || (gene == nullptr && name != "seed")) {
    throw std::invalid_argument(
        fmt::format("'{}': wanted is NAME=NUMBER as the search prints it", word));
  }
  const double value = number_of(word, word.substr(equals + 1));
  const double low = gene != nullptr ? gene->low : 0.0;
  const double high = gene != nullptr ? gene->high : 4294967295.0;
  const bool whole = gene == nullptr || gene->whole;
  if (!(value >= low && value <= high) || (whole && value != std::round(value))) {
    throw std::invalid_argument(fmt::format("'{}': allowed is {}{} to {}", word,
                                            whole ? "a whole number, " : "", low, high));
  }
  if (gene == nullptr) {
    scenario.seed = static_cast<std::uint32_t>(value);
  } else {
    scenario.values[static_cast<std::size_t>(gene - genes().data())] = value;
  }
  return gene;
}

template <class Take>
void each_word(std::string_view line, Take&& take) {
  while (!line.empty()) {
    const auto space = std::min(line.find(' '), line.size());
    if (space > 0) take(line.substr(0, space));
    line.remove_prefix(std::min(space + 1, line.size()));
  }
}

}  // namespace

const std::array<Gene, kGenes>& genes() {
  static const std::array<Gene, kGenes> all = make_genes();
  return all;
}

Scenario::Scenario() {
  for (std::size_t i = 0; i < kGenes; ++i) values[i] = genes()[i].plain;
}

void Scenario::tidy() {
  using enum Shared;
  tidy_model();
  const auto put_out_of_play = [this](std::size_t first, std::size_t last) {
    for (std::size_t i = first; i <= last; ++i) values[i] = genes()[i].plain;
  };
  const auto unless = [&](bool used, Shared first, Shared last) {
    if (!used) put_out_of_play(static_cast<std::size_t>(first), static_cast<std::size_t>(last));
  };
  const Scenario& s = *this;
  const auto exists = [&](double hand) { return hand > 0 && hand <= s[Shared::hands]; };
  unless(s[delay] > 0, jitter, jitter);
  unless(s[rate] < 10, threshold, threshold);
  unless(s[outage_for] > 0, outage_at, outage_at);
  unless(s[late] > 0, late_by, holds);
  unless(s[failed] > 0, failed_run, failed_run);
  unless(s[late] > 0 || s[failed] > 0 || s[fault] > 0, calm_after, calm_after);
  unless(exists(s[other_hand]), other_hand, other_rate);
  unless(exists(s[unknown_hand]) && s[unknown_until] > 0, unknown_hand, unknown_until);
  unless(exists(s[silent_hand]) && s[silent_for] > 0, silent_hand, silent_move);
  unless(exists(s[off_hand]), off_hand, off_for);
  unless(s[wall] > 0, wall_gap, wall_tilt);
  unless(s[solid] > 0 && s[solid_stiffness] > 0, solid, solid_tilt);
  unless(s[effect] > 0 && (s[wall] > 0 || s[solid] > 0), effect, effect_strength);
  unless(s[region] > 0, region, region_off);
  unless(s[body] > 0, body, body_floor);
  unless(s[pile] > 0, pile, pile_bounce);
  unless(s[paddle] > 0, paddle, paddle_turned);
  unless(exists(s[liar]), liar, lie_rename);
  for (std::size_t hand = 0; hand < kMostHands; ++hand) {
    const bool moves = s.path(hand, Path::amplitude) > 0 || s.path(hand, Path::side) > 0;
    if (hand >= s.hands()) {
      put_out_of_play(index(hand, Path::kind), index(hand, Path::side));
    } else if (!moves) {
      put_out_of_play(index(hand, Path::kind), index(hand, Path::kind));
      put_out_of_play(index(hand, Path::frequency), index(hand, Path::phase));
    }
  }
}

// A model has no operator switch and no other simulated device.
void Scenario::tidy_model() {
  using enum Shared;
  Scenario& s = *this;
  const Scenario plain;
  const auto unless = [&](bool used, std::initializer_list<Shared> genes) {
    for (const Shared gene : genes)
      if (!used) s[gene] = plain[gene];
  };
  const Model what = this->model();
  const bool is_model = what != Model::simulated;
  const bool is_usb = what == Model::falcon || what == Model::polhem;
  unless(is_model, {model_damping, chain, lag, stated, drawn, fault});
  unless(is_usb, {phase_in, phase_out});
  unless(what == Model::board || what == Model::event, {report});
  // It shows only flat faces along its axes.
  unless(what != Model::event, {model_damping, stated, wall_tilt, solid_tilt, effect,
                                effect_strength, region, region_strength, region_off, drawn});
  if (what == Model::event) s[solid] = std::min(s[solid], 2.0);
  unless(!is_model, {body, pile, paddle});
  // Bodies inside a wall would be thrown out of it.
  unless(static_cast<Drawn>(s[drawn]) != Drawn::bodies && s[body] == 0, {wall, solid});
  unless(s[drawn] > 0, {drawn_seed});
  unless(s[fault] > 0, {fault_at, fault_for, fault_every});
  unless(!is_model || s[off_hand] != 1, {off_hand, off_at, off_for});
  unless(!is_model || s[other_hand] != 1, {other_hand, other_delay, other_rate});
}

std::string line_of(const Scenario& scenario) {
  std::string line = fmt::format("seed={}", scenario.seed);
  for (std::size_t i = 0; i < kGenes; ++i) {
    const Gene& gene = genes()[i];
    if (scenario.values[i] == gene.plain) continue;
    line += fmt::format(" {}={}", gene.name, scenario.values[i]);
  }
  return line;
}

Scenario scenario_of(std::string_view line) {
  Scenario scenario;
  each_word(line, [&](std::string_view word) { read_word(word, scenario); });
  return scenario;
}

std::vector<std::size_t> genes_in(std::string_view line) {
  Scenario scenario;
  std::vector<std::size_t> found;
  each_word(line, [&](std::string_view word) {
    const Gene* gene = read_word(word, scenario);
    if (gene != nullptr) found.push_back(static_cast<std::size_t>(gene - genes().data()));
  });
  return found;
}

Scenario any_scenario(Random& random) {
  Scenario out;
  out.seed = static_cast<std::uint32_t>(random() % 1'000'000);
  for (std::size_t i = 0; i < kGenes; ++i) {
    if (unit(random) < 0.5) out.values[i] = drawn(genes()[i], random);
  }
  // One hand has to approach, or none touch.
  out.path(0, Path::press) = 0.04 * unit(random);
  return out;
}

Scenario neighbour(const Scenario& scenario, Random& random) {
  Scenario out = scenario;
  const std::size_t changes = 1 + random() % 4;
  for (std::size_t i = 0; i < changes; ++i) {
    const std::size_t at = random() % kGenes;
    const Gene& gene = genes()[at];
    const double way = unit(random);
    const double step = std::normal_distribution<double>(0, 0.1)(random);
    out.values[at] = way < 0.6   ? fitting(gene, out.values[at] + step * (gene.high - gene.low))
                     : way < 0.9 ? drawn(gene, random)
                                 : gene.plain;
  }
  if (unit(random) < 0.1) out.seed = static_cast<std::uint32_t>(random() % 1'000'000);
  return out;
}

}  // namespace reckon::fuzz
