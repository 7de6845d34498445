// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The program of a seeded simulation: runs seeds until one breaks an invariant, and prints how to
// replay it. `./run fuzz peers`, `./run fuzz leaders`, `./run fuzz unplugs`.
#pragma once

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <utility>

#include "reckon/pdu/seconds.hpp"
#include "reckon/tests/fuzz/search/leave_out.hpp"
#include "reckon/tests/fuzz/search/search_program.hpp"
#include "reckon/tests/fuzz/search/seeded_simulation.hpp"

namespace reckon::fuzz {

template <typename Plan, typename Outcome>
class SeededSearch {
 public:
  explicit SeededSearch(const SeededSimulation<Plan, Outcome>& simulation)
      : simulation_(simulation) {}

  /// @return 0 if every invariant held, 1 if one did not, or the code of CLI11
  int run(int argc, char** argv) const {
    CLI::App app{std::string(simulation_.about)};
    std::uint64_t first = 1, seeds = 10'000, every = 1, again = 0;
    bool all = false;
    app.add_option("--first", first, "seed to begin with");
    app.add_option("--seeds", seeds, "so many numbers from there on");
    app.add_option("--every", every, "one of every so many of them")->check(CLI::PositiveNumber);
    app.add_flag("--all", all, "goes on after a finding");
    auto* replayed = app.add_option("--replay", again, "one seed, step by step");
    CLI11_PARSE(app, argc, argv);
    return replayed->count() > 0 ? replay(again) : search(first, seeds, every, all);
  }

 private:
  static constexpr std::uint64_t kRunTwice = 16;  // every nth seed runs twice, to compare the hash
  static constexpr std::uint64_t kTold = 5;       // printed findings of an invariant

  template <typename Finding>
  void tell(const Plan& plan, const Finding& finding) const {
    print_finding(fmt::format("seed {} breaks {}{} at {:.4f} s: {}", plan.seed, simulation_.letter,
                              finding.invariant, pdu::to_seconds(finding.at), finding.sentence),
                  simulation_.target, std::to_string(plan.seed));
  }

  [[nodiscard]] Outcome run_seed(const Plan& plan) const {
    Outcome outcome = simulation_.try_out(plan, false);
    if (outcome.finding || plan.seed % kRunTwice != 0) return outcome;
    if (simulation_.try_out(plan, false).hash != outcome.hash) {
      outcome.finding.emplace();
      outcome.finding->invariant = simulation_.same_again;
      outcome.finding->sentence = "the same seed ran another way";
    }
    return outcome;
  }

  [[nodiscard]] bool is_calm(const Plan& plan) const {
    return plan.line == simulation_.calmed(plan).line;
  }

  // The plan with as few faults as still break the same invariant, and a calm line if that still
  // does.
  [[nodiscard]] Plan simplest(const Plan& plan, int invariant) const {
    const auto fails = [&](const Plan& fewer) {
      const Outcome outcome = simulation_.try_out(fewer, false);
      return outcome.finding && outcome.finding->invariant == invariant;
    };
    const auto without = [](Plan fewer, std::size_t fault) -> std::optional<Plan> {
      fewer.faults.erase(fewer.faults.begin() + static_cast<std::ptrdiff_t>(fault));
      return fewer;
    };
    const Plan least = leave_out(plan, plan.faults.size(), without, fails);
    const auto calm = [&](const Plan& whole, std::size_t) -> std::optional<Plan> {
      if (is_calm(whole)) return {};
      return simulation_.calmed(whole);
    };
    return leave_out(least, 1, calm, fails);
  }

  [[nodiscard]] int replay(std::uint64_t seed) const {
    const Plan plan = simulation_.plan_of(seed);
    fmt::print("seed {}: {}\n", seed, text_of(plan));
    const Outcome first = simulation_.try_out(plan, false);
    const Plan least = first.finding ? simplest(plan, first.finding->invariant) : plan;
    const Outcome outcome = simulation_.try_out(least, true);
    for (const std::string& line : outcome.log) fmt::print("{}\n", line);
    fmt::print("faults{}:\n", first.finding ? " that it needs" : "");
    for (const auto& fault : least.faults) fmt::print("  {}\n", text_of(fault));
    if (!first.finding) {
      fmt::print("every invariant holds; hash {:016x}\n", outcome.hash);
      return 0;
    }
    if (is_calm(least)) fmt::print("  and a line that does no harm\n");
    tell(plan, *outcome.finding);
    return 1;
  }

  [[nodiscard]] int search(std::uint64_t first, std::uint64_t seeds, std::uint64_t every,
                           bool all) const {
    RunStatistics statistics;
    std::uint64_t received = 0;
    std::map<int, std::uint64_t> broken;
    for (std::uint64_t seed = first; seed < first + seeds; seed += every) {
      const Plan plan = simulation_.plan_of(seed);
      const Outcome outcome = run_seed(plan);
      statistics.add();
      received += outcome.received;
      if (!outcome.finding) continue;
      if (broken[outcome.finding->invariant]++ < kTold) tell(plan, *outcome.finding);
      if (!all) break;
    }
    statistics.print();
    fmt::print("{} {}\n", received, simulation_.counted);
    for (const auto& [invariant, count] : broken)
      fmt::print("{}{} broken by {} seeds\n", simulation_.letter, invariant, count);
    return broken.empty() ? 0 : 1;
  }

  const SeededSimulation<Plan, Outcome>& simulation_;
};

/// The main() of a seeded simulation.
template <typename Plan, typename Outcome>
int search_seeds(const SeededSimulation<Plan, Outcome>& simulation, int argc, char** argv) {
  return guarded([&] { return SeededSearch(simulation).run(argc, argv); });
}

}  // namespace reckon::fuzz
