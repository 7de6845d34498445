// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/bench/studies/latency/latency_study.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <random>
#include <thread>

#include "reckon/bench/statistics/quantile.hpp"
#include "reckon/bench/studies/frame/fields.hpp"
#include "reckon/bench/studies/frame/study.hpp"
#include "reckon/bench/studies/latency/stepped_hand.hpp"
#include "reckon/bench/studies/latency/touch_matching.hpp"
#include "reckon/bench/studies/latency/udp_ping.hpp"
#include "reckon/pdu/seconds.hpp"
#include "reckon/peer/joined_peer.hpp"
#include "reckon/peer/network/interface_choice.hpp"
#include "reckon/peer/sealing/key_file.hpp"
#include "reckon/peer/threads/cpu_time.hpp"
#include "reckon/tools/command_line/duration_text.hpp"
#include "reckon/tools/terminal/report_text.hpp"

namespace reckon::bench {
namespace {

using std::chrono::microseconds;
using std::chrono::milliseconds;
using std::chrono::nanoseconds;

// Two hands that overlap by 4 or 6 mm: 1.2 or 1.8 N from the spring alone, so that the force
// determines the position of the other hand.
constexpr std::string_view kScene = R"(
[scene]
name = "two hands that touch"
origin = {{latitude = "47.05 deg", longitude = "8.31 deg", height = "430 m"}}
[network]
group = "{}"
port = {}
[hand]
radius = "10 mm"
k1 = "300 N/m"
damping = "0 N s/m"
static_friction = 0.0
kinetic_friction = 0.0
[aoim]
pool = 16
)";
constexpr double kReach = 0.02;    // [m], both radii
constexpr double kSpring = 300.0;  // [N/m]

constexpr nanoseconds kPings = milliseconds(500);     // in each round
constexpr nanoseconds kTouches = milliseconds(2000);  // in each round, after kSettle
constexpr nanoseconds kSettle = milliseconds(300);    // until servos and predictors have settled
constexpr nanoseconds kMeet = milliseconds(1500);     // before the first round
// The period of the other servo is a little longer, so that a change arrives at every phase of it.
constexpr nanoseconds kPeriod = milliseconds(1);
constexpr nanoseconds kOtherPeriod = nanoseconds(1'003'700);
constexpr std::size_t kTraceSteps = 4096;
// Octets of a touch on the wire: Entity State, Attribute PDU with a force model, trailer.
constexpr std::size_t kPingOctets = 144 + 32 + 8 + 72 + 24;

peer::SceneFile scene(bool ipv6, const LatencyOptions& options) {
  const int port = 20'000 + getpid() % 20'000;  // different from other runs
  peer::SceneFile scene = peer::parse_scene_file(
      fmt::format(fmt::runtime(kScene), ipv6 ? "ff15::c0:4f00" : "239.192.79.0", port), "latency");
  scene.network.key = options.key;
  if (options.touch_tier) scene.aoim.tiers = {{peer::Recipients::touch, {}, false}};
  scene.hash = peer::scene_hash(scene);
  return scene;
}

// One peer and its hand.
struct Side {
  Side(const peer::SceneFile& world, const LatencyOptions& options, std::uint16_t number,
       nanoseconds period, std::unique_ptr<SteppedHand> device)
      : hand(std::move(device)),
        steps(kTraceSteps),
        joined(federate_options(world, options, number, period, *hand)) {
    joined.peer().trace(&steps);
  }

  static peer::FederateOptions federate_options(const peer::SceneFile& world,
                                                const LatencyOptions& options, std::uint16_t number,
                                                nanoseconds period, SteppedHand& hand) {
    peer::FederateOptions own;
    own.name = fmt::format("HAND{}", number);
    own.scene = world;
    own.interface = options.iface;
    own.loops = peer::FederateLoops::threads;
    own.application = number;
    own.devices.push_back({.device = &hand, .marking = {}, .period = period});
    return own;
  }

  std::unique_ptr<SteppedHand> hand;
  haptics::TraceRing steps;
  peer::JoinedPeer joined;
  nanoseconds last_step{0};  // of the steps collected in this round; 0: none
};

class Measurement {
 public:
  Measurement(const LatencyOptions& options, const tools::Console& console)
      : console_(console),
        random_(options.seed),
        choice_(peer::choose_interface(options.iface, false)),
        world_(scene(false, options)),
        ping_(choice_.interface.address(false).value(), kPingOctets),
        a_(world_, options, 1, kPeriod,
           std::make_unique<SteppedHand>(Eigen::Vector3d(-0.014, 0, 0),
                                         Eigen::Vector3d(-0.016, 0, 0), options.seed)),
        b_(world_, options, 2, kOtherPeriod,
           std::make_unique<SteppedHand>(Eigen::Vector3d::Zero())) {}

  Latencies run(nanoseconds length) {
    const nanoseconds end = a_.joined.clock().now() + length;
    start();
    pass(kMeet, nullptr);
    stop();
    while (!console_.stopped() && a_.joined.clock().now() < end) round();
    for (Side* side : {&a_, &b_}) {
      side->joined.resign();
      found_.felt += side->joined.peer().counters().find("updates_felt")->value();
    }
    return std::move(found_);
  }

 private:
  struct Samples {
    std::vector<StepSample> changes, forces;
  };

  void round() {
    const nanoseconds end = a_.joined.clock().now() + kPings;
    while (a_.joined.clock().now() < end && !console_.stopped()) {
      std::this_thread::sleep_for(some(milliseconds(1)));
      const auto answer = ping_.ask();
      if (!answer) continue;
      found_.there.push_back(answer->there);
      found_.there_and_back.push_back(answer->there_and_back);
    }
    start();
    pass(kSettle, nullptr);
    Samples samples;
    const nanoseconds cpu = peer::process_cpu_time();
    const nanoseconds begun = a_.joined.clock().now();
    pass(kTouches, &samples);
    found_.cpu_seconds += pdu::to_seconds(peer::process_cpu_time() - cpu);
    found_.peer_seconds += pdu::to_seconds(a_.joined.clock().now() - begun);
    stop();
    const TouchTimes times = match_touches(samples.changes, samples.forces);
    found_.touch.insert(found_.touch.end(), times.taken.begin(), times.taken.end());
    found_.missed += times.missed;
  }

  void start() {
    a_.joined.run();
    b_.joined.run();
  }
  void stop() {
    for (Side* side : {&a_, &b_}) {
      found_.real_time = found_.real_time && side->joined.threads()->real_time();
      side->joined.stop_loops();
    }
    collect(nullptr);
  }

  void pass(nanoseconds span, Samples* samples) {
    const nanoseconds end = a_.joined.clock().now() + span;
    while (a_.joined.clock().now() < end && !console_.stopped()) {
      std::this_thread::sleep_for(milliseconds(20));
      collect(samples);
    }
  }

  // Collects the changes at A, each with the resulting force at B, and every force at B.
  void collect(Samples* samples) {
    while (const haptics::ServoSnapshot* step = a_.steps.front()) {
      note_step(a_, step->time, samples != nullptr);
      const double place = step->device.x();
      if (samples != nullptr && place != place_) {
        samples->changes.push_back({step->time, kSpring * (kReach - std::abs(place))});
      }
      place_ = place;
      a_.steps.pop();
    }
    while (const haptics::ServoSnapshot* step = b_.steps.front()) {
      note_step(b_, step->time, samples != nullptr);
      const double force = step->count > 0 ? step->contacts[0].ungated_force.norm() : 0.0;
      if (samples != nullptr) samples->forces.push_back({step->time, force});
      b_.steps.pop();
    }
  }

  void note_step(Side& side, nanoseconds time, bool counts) {
    if (counts && side.last_step > nanoseconds{0})
      found_.servo_steps.push_back(time - side.last_step);
    side.last_step = counts ? time : nanoseconds{0};
  }

  nanoseconds some(nanoseconds most) {
    return nanoseconds(std::uniform_int_distribution<std::int64_t>(0, most.count())(random_));
  }

  const tools::Console& console_;
  std::mt19937_64 random_;
  peer::InterfaceChoice choice_;
  peer::SceneFile world_;
  UdpPing ping_;
  Side a_, b_;
  double place_ = 0;
  Latencies found_;
};

struct LatencyRow {
  std::string_view what;
  const std::vector<nanoseconds>* times;
};

Fields row_fields(const LatencyRow& row) {
  const peer::Spread s = row.times == nullptr ? peer::Spread{} : spread_us(*row.times);
  const auto text = [](double value) { return fmt::format("{:.1f}", value); };
  return Fields()
      .word("WHAT", row.what)
      .cell("P50 us", text(s.p50))
      .cell("P99 us", text(s.p99))
      .cell("P99.9 us", text(s.p999))
      .cell("MAX us", text(s.max))
      .cell("NUMBER", fmt::format("{}", s.count));
}

std::string latency_text(const LatencyOptions& options, const Latencies& found) {
  const std::vector<LatencyRow> rows{{"bare datagram, one way", &found.there},
                                     {"bare datagram, round trip", &found.there_and_back},
                                     {"touch, servo to servo", &found.touch},
                                     {"one servo step to the next", &found.servo_steps}};
  return fmt::format(
      "{}On {}, two peers in one process, alternating for {:.0f} s. A servo applies updates at its "
      "next step, which adds 0 to 1 ms to a touch.\n{} touches did not arrive in time; each peer "
      "used {:.1f} % of a core{}\n",
      table_of(rows, row_fields), options.iface, pdu::to_seconds(options.length), found.missed,
      100 * found.cpu_of_peer(),
      found.real_time ? "" : "; no real-time privilege, see reckon doctor");
}

std::string latency_json(const LatencyOptions& options, const Latencies& found) {
  const auto spread = [](const std::vector<nanoseconds>& times) {
    return Value::raw(tools::spread_json(spread_us(times)));
  };
  return Fields("latency")
      .json("iface", options.iface)
      .json("seconds", pdu::to_seconds(options.length))
      .json("there_us", spread(found.there))
      .json("there_and_back_us", spread(found.there_and_back))
      .json("touch_us", spread(found.touch))
      .json("servo_step_us", spread(found.servo_steps))
      .json("pings", found.there.size())
      .json("touches", found.touch.size())
      .json("missed", found.missed)
      .json("real_time", found.real_time)
      .json("cpu_of_peer", found.cpu_of_peer())
      .json("felt", found.felt)
      .line();
}

/// Called before anything is started.
void check_key(const std::string& file) {
  if (file.empty()) return;
  try {
    static_cast<void>(peer::load_group_key(file));
  } catch (const peer::KeyFileError& error) {
    throw tools::UsageError(error.what());
  }
}

class LatencyStudy final : public Study {
 public:
  std::vector<Flag> flags() override {
    return {
        {"--iface", &options_.iface, "latency: interface (lo)", std::string(tools::kInterfaces)},
        {"--key", &options_.key, "latency: key file; seals the touch"},
        {"--contact-groups", &options_.touch_tier,
         "latency: send the touch to a separate group, as with [[aoim.tier]] to = \"touch\""}};
  }

  StudyOutput run(const StudyCall& call) override {
    options_.length = shared_.span();
    options_.seed = shared_.first_seed();
    if (!shared_.files.empty()) throw tools::UsageError("bench latency takes no FILE: remove it");
    if (options_.length < kShortestLatencyStudy)
      throw tools::UsageError("--for: write at least 4s, for one round of pings and touches");
    check_key(options_.key);
    try {
      const Latencies found = measure_latency(options_, call.console);
      return {shared_.json ? latency_json(options_, found) : latency_text(options_, found)};
    } catch (const std::runtime_error& error) {
      throw tools::EnvironmentError(error.what());
    }
  }

 private:
  LatencyOptions options_;
};

}  // namespace

peer::Spread spread_us(std::vector<nanoseconds> times) {
  const auto at = [&](double share) {
    return static_cast<double>(quantile(times, share).count()) * 1e-3;
  };
  return {at(0.5), at(0.99), at(0.999), at(1.0), times.size()};
}

Latencies measure_latency(const LatencyOptions& options, const tools::Console& console) {
  return Measurement(options, console).run(options.length);
}

std::unique_ptr<Study> latency_study() { return std::make_unique<LatencyStudy>(); }

}  // namespace reckon::bench
