// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Runs seeds of the simulation of leaders until one breaks an invariant, and tells how to see it
// again. `./run fuzz leaders`; docs/robustness.md says what is promised.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cstdint>
#include <map>
#include <string>

#include "reckon/pdu/seconds.hpp"
#include "reckon/tests/fuzz/leaders/trial.hpp"
#include "reckon/tests/fuzz/search/search_program.hpp"

namespace reckon::fuzz::leaders {
namespace {

constexpr std::uint64_t kRunTwice = 16;  // every so many seeds, for the hash

void tell(const Plan& plan, const Finding& finding) {
  print_finding(fmt::format("seed {} breaks L{} at {:.4f} s: {}", plan.seed, finding.invariant,
                            pdu::to_seconds(finding.at), finding.sentence),
                "leaders", std::to_string(plan.seed));
}

Outcome run_seed(const Plan& plan) {
  Outcome outcome = try_out(plan);
  if (outcome.finding || plan.seed % kRunTwice != 0) return outcome;
  if (try_out(plan).hash != outcome.hash) {
    outcome.finding = Finding{9, {}, "the same seed ran another way"};
  }
  return outcome;
}

int replay(std::uint64_t seed) {
  const Plan plan = plan_of(seed);
  fmt::print("seed {}: {}\n", seed, text_of(plan));
  const Outcome first = try_out(plan);
  const Plan least = first.finding ? simplest(plan, first.finding->invariant) : plan;
  const Outcome outcome = try_out(least, true);
  for (const std::string& line : outcome.log) fmt::print("{}\n", line);
  fmt::print("faults{}:\n", first.finding ? " that it needs" : "");
  for (const Fault& fault : least.faults) fmt::print("  {}\n", text_of(fault));
  if (least.line.delay == nanoseconds() && first.finding) fmt::print("  and no loss or delay\n");
  if (!first.finding) {
    fmt::print("every invariant holds; hash {:016x}\n", outcome.hash);
    return 0;
  }
  tell(plan, *outcome.finding);
  return 1;
}

int search(std::uint64_t first, std::uint64_t seeds, std::uint64_t every, bool all) {
  RunStatistics statistics;
  std::uint64_t received = 0;
  std::map<int, std::uint64_t> broken;
  for (std::uint64_t seed = first; seed < first + seeds; seed += every) {
    const Plan plan = plan_of(seed);
    const Outcome outcome = run_seed(plan);
    statistics.add();
    received += outcome.received;
    if (!outcome.finding) continue;
    if (broken[outcome.finding->invariant]++ < 5) tell(plan, *outcome.finding);
    if (!all) break;
  }
  statistics.print();
  fmt::print("{} datagrams received\n", received);
  for (const auto& [invariant, count] : broken)
    fmt::print("L{} broken by {} seeds\n", invariant, count);
  return broken.empty() ? 0 : 1;
}

int run(int argc, char** argv) {
  CLI::App app{"Runs seeded simulations of leaders that are elected, cut off and killed."};
  std::uint64_t first = 1, seeds = 10'000, every = 1, again = 0;
  bool all = false;
  app.add_option("--first", first, "seed to begin with");
  app.add_option("--seeds", seeds, "so many numbers from there on");
  app.add_option("--every", every, "only each so-manieth of them")->check(CLI::PositiveNumber);
  app.add_flag("--all", all, "goes on after a finding");
  auto* replayed = app.add_option("--replay", again, "one seed, told at length");
  CLI11_PARSE(app, argc, argv);
  return replayed->count() > 0 ? replay(again) : search(first, seeds, every, all);
}

}  // namespace
}  // namespace reckon::fuzz::leaders

int main(int argc, char** argv) {
  return reckon::fuzz::guarded(reckon::fuzz::leaders::run, argc, argv);
}
