// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The flags and the run of `bench scale`, as a study.
#include <fmt/format.h>

#include <memory>
#include <string>
#include <vector>

#include "reckon/bench/studies/frame/study.hpp"
#include "reckon/bench/studies/scale/run.hpp"

namespace reckon::bench {
namespace {

class ScaleStudy final : public Study {
 public:
  std::vector<Flag> flags() override {
    std::string movements;
    for (const Gait& gait : kGaits) movements += fmt::format("{}, ", gait.name);
    return {
        {"--peers", &words_.peers,
         "scale: numbers of peers, such as 16,64,256 (8,16,32,64); more than 256 are extrapolated "
         "from three or more smaller exercises"},
        {"--entities", &words_.entities, "scale: total numbers of entities (100 for each peer)"},
        {"--movement", &words_.movement,
         fmt::format("scale: motion of entities: {}{} (mixed)", movements, kMixedGait),
         movements + std::string(kMixedGait)},
        {"--density", &words_.density, "scale: entities a square kilometre (400)"},
        {"--scheme", &words_.scheme,
         "scale: cells: square, hexagonal, or a quadtree divided by the initial positions of the "
         "crowd (hexagonal)",
         "square, hexagonal, quadtree"},
        {"--cell", &words_.cell,
         "scale: corner radius of a hexagon, side of a square or of the smallest cell of a "
         "quadtree (125 m)"},
        {"--pool", &words_.pool, "scale: multicast groups that cells share (256)"},
        {"--radius", &words_.radius, "scale: how far an entity senses (200 m)"},
        {"--rate", &words_.rate, "scale: ticks a second (30)"},
        {"--threshold", &words_.threshold, "scale: error at which an owner sends (1 m)"},
        {"--whole", &words_.whole,
         "scale: compares simulated peers with processes: on lo, on a lan of network namespaces "
         "(root), or on several hosts"},
        {"--drawn", &words_.drawn,
         "scale: so many exercises that --seed draws, predicted and as processes (on lo, or on a "
         "--whole lan), and nothing else"},
        {"--pick", &words_.pick,
         "scale: the cheapest threshold, cells and pool with this p99 pose error, such as 2m, by "
         "prediction; then it and its neighbours as processes"},
        {"--hosts", &words_.hosts,
         "scale: hosts on which --whole hosts starts them over ssh, such as a,b=eth1: HOST or "
         "HOST=INTERFACE"},
        {"--ssh", &words_.ssh,
         fmt::format("scale: program to which HOST and COMMAND are appended ({})",
                     HostsPlan().ssh)},
        {"--share", &words_.share,
         "scale: FIRST-LAST or FIRST-LAST=INTERFACE, the peers of this host; --whole hosts passes "
         "it by itself"},
        {"--port", &words_.port, "scale: UDP port of --share"},
        {"--hands", &words_.hands,
         "scale: also hands in contact: their traffic, against a stream of each servo step"},
        {"--many-hands", &words_.many_hands,
         "scale: as many peers as --peers (at most 64) with a hand each, 4 of them touching: total "
         "traffic of a run with and without dead reckoning of the force"},
        {"--wide", &words_.wide, "scale: tables with all columns, one for each exercise"},
        {"--compare", &words_.compare, "scale: show changes against this file, which --json wrote"},
    };
  }

  StudyOutput run(const StudyCall& call) override {
    if (shared_.files.size() > 1)
      throw tools::UsageError("bench scale reads one FILE of tracks: remove the others");
    if (!shared_.files.empty()) words_.file = shared_.files.front();
    words_.delay = shared_.delay;
    words_.jitter = shared_.jitter;
    words_.loss = shared_.loss;
    words_.json = shared_.json;
    words_.report = shared_.report;
    words_.seed = shared_.seed;
    words_.length = shared_.length;
    StudyOutput output;
    output.code = static_cast<tools::ExitCode>(bench_scale(words_, call.command, call.console));
    return output;
  }

 private:
  ScaleWords words_;
};

}  // namespace

std::unique_ptr<Study> scale_study() { return std::make_unique<ScaleStudy>(); }

}  // namespace reckon::bench
