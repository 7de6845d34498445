// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The adversary of touch: climbs from random scenarios to those that break a promise, or come
// nearest to it. `./run fuzz touch`; docs/robustness.md says what is promised.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <array>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <functional>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "reckon/haptics/contact/energy_exchange.hpp"
#include "reckon/haptics/passivity/energy_port.hpp"
#include "reckon/tests/fuzz/search/leave_out.hpp"
#include "reckon/tests/fuzz/search/search_program.hpp"
#include "reckon/tests/fuzz/touch/trial.hpp"

namespace reckon::fuzz {
namespace {

constexpr std::size_t kObjectives = 5;
constexpr int kPatience = 30;  // neighbours in vain, then begins anew

/// One thing to make worse.
struct Objective {
  std::string name;
  double seconds;                                 // of simulated time
  std::function<double(const Outcome&)> badness;  // higher is worse
  std::function<std::string(const Outcome&)> text;
  void (*rules)(Scenario&);  // what it is not allowed to choose
  double most = 1e300;       // of badness; more breaks a promise
};

struct Worst {
  double badness = -1e300;
  Outcome outcome;
  Scenario scenario;
};

void put_out_of_play(Scenario& s, std::initializer_list<Shared> shared) {
  for (const Shared gene : shared) s[gene] = genes()[static_cast<std::size_t>(gene)].plain;
}

void anything(Scenario&) {}

// Honest hands that press and hold still, on a line without loss.
void stillness(Scenario& s) {
  using enum Shared;
  put_out_of_play(s, {friction, hardening, record_damping, loss, overlap, outage_at, outage_for,
                      late, failed, off_hand, wall, liar, mass});
  s[stiffness] = std::min(s[stiffness], 500.0);
  s[grip] = std::clamp(s[grip], 200.0, 500.0);
  s[grip_damping] = std::max(s[grip_damping], 2.0);
  s[damping] = std::max(s[damping], 0.75);
  s[delay] = std::min(s[delay], 0.05);
  s[jitter] = std::min(s[jitter], 0.3);
  s[threshold] = std::min(s[threshold], 0.015);
  if (s[rate] > 0) s[rate] = std::max(s[rate], 50.0);
  for (std::size_t hand = 0; hand < kMostHands; ++hand) {
    s.path(hand, Path::amplitude) = s.path(hand, Path::side) = 0;
    s.path(hand, Path::rise) = std::max(s.path(hand, Path::rise), 1.0);
  }
}

// The second hand lies to the first, which holds still.
void resting(Scenario& s) {
  using enum Shared;
  put_out_of_play(s, {hands, friction, hardening, record_damping, overlap, late, failed, off_hand,
                      wall, lie_odd, lie_rename});
  s[liar] = 2;
  s.path(0, Path::press) = s.path(0, Path::amplitude) = s.path(0, Path::side) = 0;
  s.path(1, Path::side) = 0;
}

std::string joules(double value) { return fmt::format("{:.3g} mJ", 1e3 * value); }

const std::array<Objective, kObjectives>& objectives() {
  static const std::array<Objective, kObjectives> all = {
      Objective{"energy", 3, [](const Outcome& o) { return -o.least_held - o.least_sum; },
                [](const Outcome& o) {
                  return fmt::format(
                      "least port {}, under a force {}, least sum {}, late samples took {}",
                      joules(o.least_port), joules(o.least_held), joules(o.least_sum),
                      joules(o.late_cost));
                },
                anything},
      Objective{"meter", 3, [](const Outcome& o) { return o.meter; },
                [](const Outcome& o) { return joules(o.meter) + " above the device's books"; },
                anything},
      Objective{"rate", 3, [](const Outcome& o) { return o.excess; },
                [](const Outcome& o) { return fmt::format("{:.3g} N beyond the limit", o.excess); },
                anything},
      Objective{
          "wrong", 7, [](const Outcome& o) { return o.wrong; },
          [](const Outcome& o) { return fmt::format("{:.1f} % of the force", 100 * o.wrong); },
          stillness},
      Objective{"liar", 4, [](const Outcome& o) { return o.liar; },
                [](const Outcome& o) {
                  return fmt::format("{} and 50 mW beyond what surfaces did", joules(o.liar));
                },
                resting, haptics::EnergyPort::kUnseen + haptics::kGreatestLoan},
  };
  return all;
}

Outcome judged(const Objective& objective, const Scenario& scenario) {
  Outcome outcome = try_out(scenario, objective.seconds);
  Scenario allowed = scenario;
  objective.rules(allowed);
  allowed.tidy();
  const bool too_bad = allowed == scenario && objective.badness(outcome) > objective.most;
  if (too_bad && outcome.violation.empty()) {
    outcome.violation = objective.name + ": " + objective.text(outcome);
  }
  return outcome;
}

class Search {
 public:
  Search(std::uint64_t seed, double seconds)
      : random_(seed),
        end_(std::chrono::steady_clock::now() +
             std::chrono::duration_cast<std::chrono::steady_clock::duration>(
                 std::chrono::duration<double>(seconds))) {}

  /// The first scenario that breaks a promise. @param only one objective, all where it is empty
  std::optional<Worst> climb_all(const std::string& only) {
    while (!over()) {
      for (std::size_t i = 0; i < objectives().size() && !over(); ++i) {
        if (!only.empty() && objectives()[i].name != only) continue;
        if (const auto broken = climb(i)) return broken;
      }
    }
    return std::nullopt;
  }

  /// Leaves out what a violation does not need.
  [[nodiscard]] Worst simplest(Worst broken, const Objective& objective) {
    const auto without = [](Scenario fewer, std::size_t part) -> std::optional<Scenario> {
      const std::size_t gene = kGenes - 1 - part;  // the first one first
      if (fewer.values[gene] == genes()[gene].plain) return {};
      fewer.values[gene] = genes()[gene].plain;
      return fewer;
    };
    const auto fails = [&](const Scenario& fewer) {
      const Outcome outcome = run(fewer, objective);
      if (outcome.violation.empty()) return false;
      broken = {0, outcome, fewer};
      return true;
    };
    static_cast<void>(leave_out(broken.scenario, kGenes, without, fails));
    return broken;
  }

  [[nodiscard]] const Worst& worst(std::size_t objective) const { return worst_[objective]; }
  [[nodiscard]] const RunStatistics& statistics() const { return statistics_; }

 private:
  [[nodiscard]] bool over() const { return std::chrono::steady_clock::now() >= end_; }
  Outcome run(const Scenario& scenario, const Objective& objective) {
    statistics_.add();
    return judged(objective, scenario);
  }

  std::optional<Worst> climb(std::size_t at) {
    const Objective& objective = objectives()[at];
    Worst here;
    for (int vain = 0; vain < kPatience && !over(); ++vain) {
      Scenario next =
          here.badness > -1e300 ? neighbour(here.scenario, random_) : any_scenario(random_);
      objective.rules(next);
      next.tidy();
      const Outcome outcome = run(next, objective);
      if (!outcome.violation.empty()) {
        return simplest({0, outcome, next}, objective);
      }
      const double badness = objective.badness(outcome);
      if (badness > here.badness) vain = 0;
      if (badness >= here.badness) here = {badness, outcome, next};
    }
    if (here.badness > worst_[at].badness) worst_[at] = here;
    return std::nullopt;
  }

  Random random_;
  std::chrono::steady_clock::time_point end_;
  std::array<Worst, kObjectives> worst_;
  RunStatistics statistics_;
};

// All objectives, for as long as the longest takes.
int replay(const std::string& line) {
  const Scenario scenario = scenario_of(line);
  int status = 0;
  for (const Objective& objective : objectives()) {
    const Outcome outcome = judged(objective, scenario);
    fmt::print("{:<8} {}\n", objective.name, objective.text(outcome));
    if (outcome.violation.empty()) continue;
    fmt::print("reckon fuzz: {}\n", outcome.violation);
    status = 1;
  }
  return status;
}

int search(std::uint64_t seed, double seconds, const std::string& only) {
  Search search(seed, seconds);
  const std::optional<Worst> broken = search.climb_all(only);
  for (std::size_t i = 0; i < objectives().size(); ++i) {
    const Worst& worst = search.worst(i);
    if (worst.badness == -1e300) continue;
    fmt::print("worst {:<8} {}\n      {}\n", objectives()[i].name,
               objectives()[i].text(worst.outcome), line_of(worst.scenario));
  }
  search.statistics().print();
  if (!broken) return 0;
  print_finding(broken->outcome.violation, "touch", '\'' + line_of(broken->scenario) + '\'');
  return 1;
}

int run(int argc, char** argv) {
  CLI::App app{"Searches for scenarios of touching hands that break what is promised."};
  double seconds = 60;
  std::uint64_t seed = 1;
  std::string line, only;
  std::vector<std::string> names;
  for (const Objective& objective : objectives()) names.push_back(objective.name);
  app.add_option("--for", seconds, "[s]");
  app.add_option("--of", only, "makes one thing worse only")->check(CLI::IsMember(names));
  app.add_option("--seed", seed, "another one searches elsewhere");
  app.add_option("--replay", line, "a scenario as the search prints it");
  CLI11_PARSE(app, argc, argv);
  return line.empty() ? search(seed, seconds, only) : replay(line);
}

}  // namespace
}  // namespace reckon::fuzz

int main(int argc, char** argv) { return reckon::fuzz::guarded(reckon::fuzz::run, argc, argv); }
