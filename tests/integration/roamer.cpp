// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// One of many whole peers that come, cross cell borders and go, and that know the positions of all
// others:
//   roamer INTERFACE NUMBER COUNT BEGIN SECONDS
// NUMBER from 0 of COUNT; BEGIN: steady time at which the exercise begins [ns]. One JSON object at
// the end: missed entities, and unrequested ones.
#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <exception>
#include <string>
#include <vector>

#include "reckon/bench/studies/scale/whole_runs.hpp"
#include "reckon/peer/network/udp_multicast.hpp"

namespace {

using namespace reckon;

constexpr std::size_t kEntities = 2;        // of each peer
constexpr double kRate = 20;                // steps a second
constexpr double kStagger = 0.03;           // [s] from one peer's arrival or departure to the next
constexpr double kCome = 2.5, kGone = 1.5;  // [s] until all know of it
// [s] permitted lateness of a step (TOO_LATE of namespaces_many.py): a peer that departs then has
// already gone
constexpr double kLate = 0.6;

bench::ScaleSetting setting_of(std::size_t count, double seconds) {
  bench::ScaleSetting setting;
  setting.peers = count;
  setting.crowd = {"vehicles", kEntities * count, 100, 7};
  setting.radius = 150;
  setting.rate = kRate;
  setting.seconds = seconds;
  setting.grid.cell_size = 75;
  return setting;
}

/// Half of all stay; a quarter comes late, an eighth departs early, an eighth departs and returns.
std::vector<bench::LiveStay> stays_of(std::size_t number, double seconds) {
  const double shift = kStagger * static_cast<double>(number);
  const auto at = [&](double share) { return share * seconds + shift; };
  const double end = seconds - 0.5 + 0.1 * shift;
  switch (number % 8) {
    case 1:
    case 5:
      return {{at(0.25), end}};
    case 3:
      return {{shift, at(0.5)}};
    case 7:
      return {{shift, at(0.3)}, {at(0.55), end}};
    default:
      return {{shift, end}};
  }
}

bench::Attendance attendance(std::size_t peer, double time, double seconds) {
  auto nearest = bench::Attendance::absent;
  for (const bench::LiveStay& stay : stays_of(peer, seconds)) {
    // A newcomer takes its first step at the nearest multiple of the period.
    if (time < stay.from - 1 / kRate || time > stay.until + kGone) continue;
    const bool is_known = time > stay.from + kCome && time < stay.until - kLate;
    nearest = is_known ? bench::Attendance::present : bench::Attendance::settling;
  }
  return nearest;
}

int run(char** words) {
  const std::size_t number = std::stoul(words[2]);
  const std::chrono::nanoseconds begin(std::stoll(words[4]));
  const double seconds = std::stod(words[5]);
  const bench::ScaleSetting setting = setting_of(std::stoul(words[3]), seconds);
  const auto law = [&](std::size_t peer, double time) { return attendance(peer, time, seconds); };
  bench::WholeCounts counts;
  bench::WholeSamples samples;
  double latest = 0;
  const peer::SteadyClock clock;
  for (const bench::LiveStay& stay : stays_of(number, seconds)) {
    peer::UdpMulticastOptions options;
    options.interface = words[1];
    peer::UdpMulticast link(options, clock);
    const bench::LiveOutcome outcome = bench::live_for(setting, number, link, begin, stay, law);
    counts.add(outcome.counts);
    samples.add(outcome.samples);
    latest = std::max(latest, outcome.latest);
  }
  const auto worst = [](std::vector<float>& values) {
    return values.empty() ? 0.0F : *std::ranges::max_element(values);
  };
  fmt::print(
      "{{\"looks\":{},\"unseen\":{},\"overdue\":{},\"ghosts\":{},\"lost\":{},\"dropped\":{},"
      "\"foreign\":{},\"heard\":{},\"sent\":{},\"joins\":{},\"groups\":{},\"cpu_s\":{:.4f},"
      "\"seconds\":{:.2f},\"worst_pose_m\":{:.3f},\"worst_shown_s\":{:.3f},\"latest_s\":{:.3f}}}\n",
      counts.looks, counts.unseen, counts.overdue, counts.ghosts, counts.lost, counts.dropped,
      counts.foreign, counts.heard_datagrams, counts.datagrams, counts.joins, counts.groups,
      counts.cpu, counts.seconds, worst(samples.pose), worst(samples.discovery), latest);
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 6) {
    std::fprintf(stderr, "usage: roamer INTERFACE NUMBER COUNT BEGIN SECONDS\n");
    return 2;
  }
  try {
    return run(argv);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
}
