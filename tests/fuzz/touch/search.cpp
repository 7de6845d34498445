// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The touch adversary: climbs from random scenarios to scenarios that break a promise, or come
// nearest to it. `./run fuzz touch`; docs/robustness.md lists the promises.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <chrono>
#include <map>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "reckon/tests/fuzz/search/leave_out.hpp"
#include "reckon/tests/fuzz/search/search_program.hpp"
#include "reckon/tests/fuzz/touch/objectives.hpp"

namespace reckon::fuzz {
namespace {

constexpr int kPatience = 30;  // neighbours without improvement before it starts elsewhere

struct Worst {
  double badness = -1e300;
  Outcome outcome;
  Scenario scenario;
};

class Search {
 public:
  /// @param fixed genes with a fixed value @param strict see judged()
  Search(std::uint64_t seed, double seconds, std::map<std::size_t, double> fixed, bool strict)
      : random_(seed),
        fixed_(std::move(fixed)),
        strict_(strict),
        turn_(std::chrono::duration_cast<Clock::duration>(
            std::chrono::duration<double>(seconds / static_cast<double>(objectives().size())))),
        end_(Clock::now() +
             std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(seconds))) {}

  /// The first scenario that breaks a promise. @param only one objective, or all if empty: in the
  /// first round each has its turn, however short the search is
  std::optional<Worst> climb_all(const std::string& only) {
    for (bool is_first = only.empty(); !over(end_); is_first = false) {
      for (std::size_t i = 0; i < objectives().size() && !over(end_); ++i) {
        if (!only.empty() && objectives()[i].name != only) continue;
        if (const auto broken = climb(i, is_first ? Clock::now() + turn_ : end_)) return broken;
      }
    }
    return std::nullopt;
  }

  /// Removes genes that a violation does not need.
  [[nodiscard]] Worst simplest(Worst broken, const Objective& objective) {
    const auto without = [](Scenario fewer, std::size_t part) -> std::optional<Scenario> {
      const std::size_t gene = kGenes - 1 - part;  // the first gene first
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
  using Clock = std::chrono::steady_clock;

  [[nodiscard]] static bool over(Clock::time_point end) { return Clock::now() >= end; }
  Outcome run(const Scenario& scenario, const Objective& objective) {
    statistics_.add();
    return judged(objective, scenario, strict_);
  }

  std::optional<Worst> climb(std::size_t at, Clock::time_point end) {
    const Objective& objective = objectives()[at];
    Worst here;
    for (int vain = 0; vain < kPatience && !over(end); ++vain) {
      Scenario next =
          here.badness > -1e300 ? neighbour(here.scenario, random_) : any_scenario(random_);
      objective.rules(next);
      for (const auto& [gene, value] : fixed_) next.values[gene] = value;
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
  std::map<std::size_t, double> fixed_;
  bool strict_;
  Clock::duration turn_;
  Clock::time_point end_;
  std::vector<Worst> worst_ = std::vector<Worst>(objectives().size());
  RunStatistics statistics_;
};

// Runs all objectives, for as long as the longest takes.
int replay(const std::string& line, bool strict) {
  const Scenario scenario = scenario_of(line);
  int status = 0;
  for (const Objective& objective : objectives()) {
    const Outcome outcome = judged(objective, scenario, strict);
    fmt::print("{:<12} {}\n", objective.name, objective.text(outcome));
    if (outcome.violation.empty()) continue;
    fmt::print("reckon fuzz: {}\n", outcome.violation);
    status = 1;
  }
  return status;
}

// Fixes all genes whose names begin so at their neutral value: "press" is that of each hand. @param
// with a line
std::map<std::size_t, double> fixed_by(const std::vector<std::string>& without,
                                       const std::string& with) {
  std::map<std::size_t, double> fixed;
  for (const std::string& name : without) {
    bool is_there = false;
    for (std::size_t i = 0; i < kGenes; ++i) {
      if (!genes()[i].name.starts_with(name)) continue;
      fixed[i] = genes()[i].plain;
      is_there = true;
    }
    if (!is_there) {
      throw std::invalid_argument(fmt::format("no number of a scenario is called '{}'", name));
    }
  }
  const Scenario wanted = scenario_of(with);
  for (const std::size_t gene : genes_in(with)) fixed[gene] = wanted.values[gene];
  return fixed;
}

int search(std::uint64_t seed, double seconds, const std::string& only,
           std::map<std::size_t, double> fixed, bool strict) {
  Search search(seed, seconds, std::move(fixed), strict);
  const std::optional<Worst> broken = search.climb_all(only);
  for (std::size_t i = 0; i < objectives().size(); ++i) {
    const Worst& worst = search.worst(i);
    if (worst.badness == -1e300) continue;
    fmt::print("worst {:<12} {}\n      {}\n", objectives()[i].name,
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
  std::string line, only, with;
  std::vector<std::string> names, without;
  bool strict = false;
  for (const Objective& objective : objectives()) names.push_back(objective.name);
  app.add_option("--for", seconds, "[s]");
  app.add_option("--of", only, "makes one thing worse only")->check(CLI::IsMember(names));
  app.add_option("--without", without, "numbers that stay out of play, as a line names them");
  app.add_option("--with", with, "numbers that stay as they are given, as a line has them");
  app.add_flag("--strict", strict, "a wrong force is a finding even where the servo tells it");
  app.add_option("--seed", seed, "another one searches elsewhere");
  app.add_option("--replay", line, "a scenario as the search prints it");
  CLI11_PARSE(app, argc, argv);
  if (!line.empty()) return replay(line, strict);
  return search(seed, seconds, only, fixed_by(without, with), strict);
}

}  // namespace
}  // namespace reckon::fuzz

int main(int argc, char** argv) {
  return reckon::fuzz::guarded([&] { return reckon::fuzz::run(argc, argv); });
}
