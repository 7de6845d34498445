// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "reckon/bench/studies/frame/study.hpp"
#include "reckon/tools/command_line/command_text.hpp"
#include "reckon/tools/command_line/verb_rows.hpp"

namespace reckon::bench {

// One function for each study, defined in its folder.
std::unique_ptr<Study> accuracy_study();
std::unique_ptr<Study> delivery_study();
std::unique_ptr<Study> latency_study();
std::unique_ptr<Study> scale_study();
std::unique_ptr<Study> stability_study();

namespace {

/// The list of studies, in the order of their flags in the help.
constexpr std::array kStudies{
    StudyKind{"scale",
              "cost and awareness of many peers and entities, mechanism by mechanism, over a "
              "simulated network",
              "--report --delay",
              "reckon bench scale --peers 16,32,64 --entities 6400 --movement vehicles\n"
              "reckon bench scale scenes/truck_track.csv --peers 64 --entities 2000 --delay 20ms "
              "--loss 1%",
              scale_study},
    StudyKind{"stability",
              "energy generated and force errors of each coupling over a simulated network",
              "--csv --report",
              "reckon bench stability --report maps.html\n"
              "reckon bench stability scenes/two_hands.toml --sweep delay=0..200ms/5 --sweep "
              "hand.k1=200,800N/m\n"
              "reckon bench stability --sweep loss=0..50%/6 --sweep delay=50ms --csv loss.csv",
              stability_study},
    StudyKind{
        "accuracy", "traffic and error of a pose, for each model, threshold and convergence curve",
        "--csv --report --delay",
        "reckon bench accuracy --motion circle,hand\n"
        "reckon bench accuracy --delay 80ms --jitter 40% --loss 10% --report poses.html\n"
        "reckon bench accuracy scenes/truck_track.csv --models auto,rvw --thresholds 0.5m,1m,2m\n"
        "reckon bench accuracy --against rvw:1m scenes/truck_track.csv\n"
        "reckon bench accuracy --circle\n"
        "reckon bench accuracy --force --contact stroke-1.5,tap --delay 20ms\n"
        "reckon bench accuracy --touch --axis order,precision --report touch.html\n"
        "reckon bench accuracy --touch --axis owner --seeds 9 --plot owner.svg",
        accuracy_study},
    StudyKind{"latency",
              "latency of a touch between two peers with threads and sockets, and of a bare "
              "datagram",
              "", "reckon bench latency --for 60s", latency_study},
    StudyKind{"delivery", "assured interactions over a simulated network that loses datagrams",
              "--csv", "reckon bench delivery --losses 0,20%,30%", delivery_study},
};

/// Flags of some studies only. A study with one of them also has the flags declared after it, up to
/// the next one: --delay includes --jitter and --loss.
constexpr std::string_view kShared = "--csv --report --delay";

/// The studies, sorted by name.
std::vector<StudyKind> studies_by_name() {
  std::vector<StudyKind> kinds(kStudies.begin(), kStudies.end());
  std::ranges::sort(kinds, {}, &StudyKind::name);
  return kinds;
}

/// `of` applied to each study that has the shared flag, joined by `between`, sorted by name; to all
/// studies if no flag is given.
template <typename Of>
std::string joined(std::string_view shared, std::string_view between, Of&& of) {
  std::vector<std::string> parts;
  for (const StudyKind& kind : studies_by_name())
    if (kind.shared.find(shared) != kind.shared.npos) parts.push_back(of(kind));
  return fmt::format("{}", fmt::join(parts, between));
}

/// Declares the flags that several studies share; only_for() lists the studies of each.
void declare_shared(tools::CommandLine& line, std::string& study, SharedWords& shared) {
  std::vector<std::string> names;
  for (const StudyKind& kind : studies_by_name()) names.emplace_back(kind.name);
  line.choice("STUDY", study, names, joined("", "; ", [](const StudyKind& kind) {
                return fmt::format("{}: {}", kind.name, kind.meaning);
              }));
  const Flag flags[]{
      {"FILE", &shared.files,
       "accuracy, scale: trajectories instead of the motions; stability: a scene file with the "
       "device, impairment and hand stiffness that --sweep varies"},
      {"--json", &shared.json, "one JSON object per line"},
      {"--seed", &shared.seed, "first seed of motions and network (1)"},
      {"--for", &shared.length,
       "length of a motion, of delivery, of latency (60s), of a run of stability (12s), of scale "
       "(5s)"},
      {"--csv", &shared.csv,
       "write all figures to this file; stability: each at once, and an existing file is "
       "continued"},
      {"--report", &shared.report, "write one HTML page with pictures and tables"},
      {"--delay", &shared.delay, "delay of an update (0s)"},
      {"--jitter", &shared.jitter, "variation of the delay, as a share of it, such as 40%"},
      {"--loss", &shared.loss, "share of lost updates, such as 10%"}};
  for (const Flag& flag : flags) {
    const auto names_of = [](const StudyKind& kind) { return std::string(kind.name); };
    if (kShared.find(flag.name) != kShared.npos) line.only_for(joined(flag.name, " ", names_of));
    declare(line, {&flag, 1});
  }
}

int run_bench(tools::Arguments arguments, const tools::Console& console) {
  std::string name;
  SharedWords shared;
  const std::string examples =
      joined("", "\n", [](const StudyKind& kind) { return std::string(kind.examples); });
  tools::CommandLine line("bench",
                          "The studies: cost of accuracy, latency of a touch, cost of many peers, "
                          "and stability of couplings over a network.",
                          examples);
  declare_shared(line, name, shared);
  std::vector<std::unique_ptr<Study>> studies;
  for (const StudyKind& kind : kStudies) {
    line.only_for(kind.name);
    declare(line, studies.emplace_back(kind.make())->flags());
  }
  if (const auto status = line.parse(arguments, console)) return *status;
  if (name.empty()) {
    throw tools::UsageError("name a study: " + joined("", ", ", [](const StudyKind& kind) {
                              return fmt::format("reckon bench {}", kind.name);
                            }));
  }
  line.check_for(name);
  const auto place = std::ranges::find(kStudies, name, &StudyKind::name) - kStudies.begin();
  Study& study = *studies[static_cast<std::size_t>(place)];
  shared.plot = study.shared().plot;  // a flag of one study
  study.shared() = shared;
  return run_study(study, {line.given(), tools::command_text("bench", arguments), console});
}

}  // namespace

}  // namespace reckon::bench

namespace reckon::tools::verb {

Verb bench() { return verb_of(verb_row("bench"), reckon::bench::run_bench); }

}  // namespace reckon::tools::verb
