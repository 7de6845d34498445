// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <chrono>
#include <cstdint>
#include <optional>
#include <ranges>
#include <string>
#include <string_view>
#include <vector>

#include "reckon/bench/studies/accuracy/modes.hpp"
#include "reckon/bench/studies/accuracy/options.hpp"
#include "reckon/bench/studies/accuracy/run.hpp"
#include "reckon/bench/studies/latency/latency_study.hpp"
#include "reckon/bench/studies/scale/run.hpp"
#include "reckon/bench/studies/stability/parameters.hpp"
#include "reckon/bench/studies/stability/run.hpp"
#include "reckon/bench/studies/touch/touch_run.hpp"
#include "reckon/bench/studies/touch/touch_study.hpp"
#include "reckon/peer/sealing/key_file.hpp"
#include "reckon/tools/command_line/command_line.hpp"
#include "reckon/tools/command_line/command_text.hpp"
#include "reckon/tools/command_line/verb_rows.hpp"

namespace reckon::bench {
namespace {

template <typename Rows>
std::string names_of(const Rows& rows) {
  std::string names;
  for (const auto& row : rows) names += fmt::format("{}{}", names.empty() ? "" : ", ", row.name);
  return names;
}

/// Flags of several studies whose defaults differ.
struct SharedFlags {
  std::optional<std::uint64_t> seed;
  std::optional<std::chrono::nanoseconds> length;
};

void declare_accuracy_flags(tools::CommandLine& line, BenchOptions& options) {
  line.flag("--pose", options.pose, "the study of poses (the default)");
  line.flag("--force", options.force,
            "hands in contact, what they send and feel: whole peers in simulated time; with --pose "
            "beside them");
  line.option("--contact", options.contacts,
              fmt::format("with --force: ways of touching, or all (the default): {}",
                          names_of(contact_scenes())));
  line.option("--send-at", options.sendings,
              "with --force: forces and fixed rates at which hands send (10mN,15mN,20mN,30mN,50mN,"
              "100mN,200mN,50Hz)");
  line.flag("--touch", options.touch,
            "error of a force against nanoseconds per servo step, axis by axis");
  line.option("--axis", options.axes,
              fmt::format("with --touch: axes; all without it: {}", names_of(touch_axes())));
  line.offer("--axis", names_of(touch_axes()));
  line.option("--plot", options.plot, "with --touch: write the picture to this SVG file");
  line.option("--motion", options.motions,
              fmt::format("motions, or all (the default): {}", names_of(motions())));
  line.offer("--motion", names_of(motions()));
  line.option("--models", options.models,
              fmt::format("models; all without it: {}", names_of(kPoseModels)));
  line.offer("--models", names_of(kPoseModels));
  line.option(
      "--thresholds", options.thresholds,
      "lengths at which the owner sends, as in 50mm,1m; without it six that suit the motion");
  line.option("--curves", options.curves,
              fmt::format("convergence curves; without it all, for files snap: {}",
                          names_of(deadreckon::kConvergenceCurves)));
  line.offer("--curves", names_of(deadreckon::kConvergenceCurves));
  line.option(
      "--angle", options.angle,
      "angle at which the owner sends, or none (3deg; none for files without orientations)");
  line.option("--heartbeat", options.heartbeat,
              "time after which the owner sends anyway (5s; for files never)");
  line.option("--first-heartbeat", options.first_heartbeat,
              "silence after a change until it is said again, each repetition waiting twice as "
              "long, against loss (none)");
  line.option("--converge", options.converge, "time that an error takes to go to zero (100ms)");
  line.option("--converge-longest", options.converge_longest,
              "the same for a large one; as --converge: one time for all (1s)");
  line.option("--seeds", options.seeds,
              "runs with seeds from there on, of which medians are told "
              "(1; with --circle 20)");
  line.option("--against", options.against,
              "MODEL:LENGTH; how many updates --models (auto) needs for the same p99 error");
  line.flag("--circle", options.circle,
            "the fixed case of a steady turn over a poor link, with a "
            "bar; status 1 where the default misses it");
  line.flag("--all", options.all, "dominated settings in the table too");
  line.flag("--front", options.front, "no dominated settings in CSV and JSON");
  line.option(
      "--trace", options.trace,
      "write each sample of one run to this file: one motion or FILE, one model, one curve, "
      "and one threshold or --period");
  line.option("--period", options.period,
              "with --trace: send at this period and not by a threshold");
}

// What is wrong with the key is told before anything is begun.
void check_key(const std::string& file) {
  if (file.empty()) return;
  try {
    static_cast<void>(peer::load_group_key(file));
  } catch (const peer::KeyFileError& error) {
    throw tools::UsageError(error.what());
  }
}

void declare_stability_flags(tools::CommandLine& line, StabilityWords& words) {
  std::vector<std::string_view> names;
  for (const StabilityParameter& parameter : stability_parameters())
    names.push_back(parameter.name);
  line.option("--sweep", words.sweeps,
              fmt::format("stability: NAME=A..B/N or NAME=A,B,C, once an axis; all else stays as "
                          "FILE has it; names: {}",
                          fmt::join(names, ", ")));
  line.option(
      "--coupling", words.modes,
      fmt::format(
          "stability: modes between commas, or all (the default): {}",
          fmt::join(kCouplingModes | std::views::transform([](auto mode) { return name_of(mode); }),
                    ", ")));
  line.flag("--no-gate", words.no_gate,
            "stability: the mode reckon without its energy port, told wherever it shows");
  line.option("--hand", words.hand, "stability: recorded trace that the hand follows");
  line.option("--peak", words.peak, "stability: force above which peaks are counted (10 N)");
}

void declare_scale_flags(tools::CommandLine& line, ScaleWords& words) {
  std::string movements;
  for (const Gait& gait : kGaits) movements += fmt::format("{}, ", gait.name);
  line.option("--peers", words.peers, "scale: numbers of peers, as in 16,64,256 (8,16,32,64)");
  line.option("--entities", words.entities,
              "scale: numbers of entities, all together (100 for each peer)");
  line.option("--movement", words.movement,
              fmt::format("scale: how they move: {}{} (mixed)", movements, kMixedGait));
  line.offer("--movement", movements + std::string(kMixedGait));
  line.option("--density", words.density, "scale: entities a square kilometre (400)");
  line.option("--scheme", words.scheme,
              "scale: cells: square, hexagonal, or a quadtree divided by where the crowd begins "
              "(hexagonal)");
  line.offer("--scheme", "square, hexagonal, quadtree");
  line.option("--cell", words.cell,
              "scale: corner radius of a hexagon, side of a square or of the smallest cell of a "
              "quadtree (125 m)");
  line.option("--pool", words.pool, "scale: multicast groups that cells share (256)");
  line.option("--radius", words.radius, "scale: how far an entity senses (200 m)");
  line.option("--rate", words.rate, "scale: ticks a second (30)");
  line.option("--threshold", words.threshold, "scale: error at which an owner sends (1 m)");
  line.flag("--measure", words.measure,
            "scale: one whole peer among the others too, its CPU, and costs fitted to it");
  line.option("--whole", words.whole,
              "scale: all peers whole too, beside the model: simulated, or as processes on lo, on "
              "a lan of network namespaces (root), or on several hosts");
  line.option("--drawn", words.drawn,
              "scale: so many exercises drawn by --seed instead: whole simulated peers beside the "
              "model, and status 1 where they differ by more than their bars");
  line.option("--hosts", words.hosts,
              "scale: where --whole hosts starts them over ssh, as in a,b=eth1: HOST or "
              "HOST=INTERFACE");
  line.option("--ssh", words.ssh,
              fmt::format("scale: what takes HOST and COMMAND ({})", HostsPlan().ssh));
  line.option(
      "--share", words.share,
      "scale: FIRST-LAST or FIRST-LAST=INTERFACE, the peers of this host; --whole hosts says "
      "so by itself");
  line.option("--port", words.port, "scale: UDP port of --share");
  line.flag("--hands", words.hands,
            "scale: hands in contact too: what they send, against a stream of each servo step");
  line.flag(
      "--many-hands", words.many_hands,
      "scale: as many peers as --peers (64 at most) with a hand each, 4 of them touching: what "
      "all send over a whole run with and without dead reckoning of the force");
  line.flag("--wide", words.wide, "scale: tables with all columns, one for each exercise");
  line.option("--compare", words.compare,
              "scale: what has changed against this file, which --json wrote");
}

void declare_flags(tools::CommandLine& line, BenchOptions& options, LatencyOptions& latency,
                   SharedFlags& shared, StabilityWords& stability, ScaleWords& scale) {
  line.choice("STUDY", options.study, {"accuracy", "latency", "scale", "stability"},
              "accuracy: what a pose costs on the wire and how far off it is, for each model, "
              "threshold and convergence curve; latency: how long a touch is under way between two "
              "peers with threads and sockets, beside a bare datagram; scale: what many peers and "
              "entities cost "
              "and see, mechanism by mechanism, over a modelled network; stability: what each "
              "coupling does over a network, energy made and forces that are off, simulated");
  line.words(
      "FILE", options.files, false,
      "accuracy, scale: trajectories instead of the motions; stability: a scene file whose device, "
      "impairment and hand stiffness are what --sweep varies");
  line.flag("--json", options.json, "one JSON object per line");
  line.option("--seed", shared.seed, "first seed of motions and network (1)");
  line.option(
      "--for", shared.length,
      "length of a motion, or of the study of latency (60s); of a run of stability (12s), of "
      "scale (5s)");
  line.only_for("accuracy stability");
  line.option(
      "--csv", options.csv,
      "write all figures to this file; stability: as they come, and where it is there go on "
      "from it");
  line.only_for("accuracy scale stability");
  line.option("--report", options.report, "write one HTML page with pictures and tables");
  line.only_for("accuracy scale");
  line.option("--delay", options.delay, "time that an update is under way (0s)");
  line.option("--jitter", options.jitter, "share of the delay by which it varies, as in 40%");
  line.option("--loss", options.loss, "share of the updates that is lost, as in 10%");
  line.only_for("scale");
  declare_scale_flags(line, scale);
  line.only_for("stability");
  declare_stability_flags(line, stability);
  line.only_for("accuracy");
  declare_accuracy_flags(line, options);
  line.only_for("latency");
  line.option("--iface", latency.iface, "latency: interface that is used (lo)");
  line.offer("--iface", tools::kInterfaces);
  line.option("--key", latency.key, "latency: key file, of a touch that is sealed");
  line.flag(
      "--contact-groups", latency.touch_tier,
      "latency: the touch goes by a group of its own, as [[aoim.tier]] to = \"touch\" has it");
}

/// What the flags of all studies say of this one.
void take_shared(const BenchOptions& options, const SharedFlags& shared,
                 StabilityWords& stability) {
  if (options.files.size() > 1)
    throw tools::UsageError("bench stability reads one FILE, the scene; leave the others out");
  if (!options.files.empty()) stability.scene = options.files.front();
  stability.csv = options.csv;
  stability.report = options.report;
  stability.json = options.json;
  stability.seed = shared.seed;
  stability.length = shared.length;
}

/// What the flags of all studies say of this one.
void take_shared(const BenchOptions& options, const SharedFlags& shared, ScaleWords& scale) {
  if (options.files.size() > 1)
    throw tools::UsageError("bench scale reads one FILE of tracks; leave the others out");
  if (!options.files.empty()) scale.file = options.files.front();
  scale.delay = options.delay;
  scale.jitter = options.jitter;
  scale.loss = options.loss;
  scale.json = options.json;
  scale.report = options.report;
  scale.seed = shared.seed;
  scale.length = shared.length;
}

int run_latency(LatencyOptions latency, const BenchOptions& options,
                const tools::Console& console) {
  if (!options.files.empty()) throw tools::UsageError("bench latency reads no FILE: leave it out");
  if (options.length < kShortestLatencyStudy) {
    throw tools::UsageError(
        "--for: bench latency takes 4s at least, for one round of pings and touches");
  }
  check_key(latency.key);
  latency.length = options.length;
  latency.seed = options.seed;
  latency.json = options.json;
  return bench_latency(latency, console);
}

int run_bench(tools::Arguments arguments, const tools::Console& console) {
  BenchOptions options;
  LatencyOptions latency;
  SharedFlags shared;
  StabilityWords stability;
  ScaleWords scale;
  tools::CommandLine line(
      "bench",
      "The studies: what accuracy costs, how long a touch is under way, what many peers cost, and "
      "which coupling stays calm over a network.",
      "reckon bench accuracy --motion circle,hand\n"
      "reckon bench accuracy --delay 80ms --jitter 40% --loss 10% --report poses.html\n"
      "reckon bench accuracy cars.csv --models auto,rvw --thresholds 0.5m,1m,2m\n"
      "reckon bench accuracy --against rvw:1m cars.csv\n"
      "reckon bench accuracy --circle\n"
      "reckon bench accuracy --force --contact stroke-1.5,tap --delay 20ms\n"
      "reckon bench accuracy --touch --axis order,precision --report touch.html\n"
      "reckon bench latency --for 60s\n"
      "reckon bench scale --peers 16,64,256 --entities 25600 --movement vehicles\n"
      "reckon bench scale town.csv --peers 64 --entities 2000 --delay 20ms --loss 1%\n"
      "reckon bench stability --report maps.html\n"
      "reckon bench stability two_hands.toml --sweep delay=0..200ms/5 --sweep hand.k1=200,800N/m\n"
      "reckon bench stability --sweep loss=0..50%/6 --sweep delay=50ms --csv loss.csv");
  declare_flags(line, options, latency, shared, stability, scale);
  if (const auto status = line.parse(arguments, console)) return *status;

  if (options.study.empty()) {
    throw tools::UsageError(
        "say which study: reckon bench accuracy, reckon bench latency, reckon bench scale, or "
        "reckon bench stability");
  }
  line.check_for(options.study);
  if (options.study == "stability") {
    take_shared(options, shared, stability);
    return bench_stability(stability, tools::command_text("bench", arguments), console);
  }
  if (options.study == "scale") {
    take_shared(options, shared, scale);
    return bench_scale(scale, tools::command_text("bench", arguments), console);
  }
  options.seed = shared.seed.value_or(options.seed);
  options.length = shared.length.value_or(options.length);
  if (options.study == "latency") return run_latency(latency, options, console);
  const AccuracyMode mode = mode_of(options);
  check_flags(mode, line.given(), options);
  if (mode == AccuracyMode::touch)
    return bench_touch(
        {options.axes, options.seed, options.json, options.csv, options.report, options.plot},
        tools::command_text("bench", arguments), console);
  return bench_accuracy(options, tools::command_text("bench", arguments), console);
}

}  // namespace

namespace verb {

tools::Verb bench() { return tools::verb_of(tools::verb_row("bench"), run_bench); }

}  // namespace verb

}  // namespace reckon::bench
