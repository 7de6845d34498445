// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// One side of a crowd, by the API alone, and its cost:
//   crowd own INTERFACE COUNT SECONDS TRAFFIC: owns COUNT vehicles, updated and checked at 60 Hz
//   crowd hear INTERFACE COUNT SECONDS: shows COUNT entities of others
// One JSON object at the end. TRAFFIC: vehicles_town_sumo.csv of the reference data.
#include <sys/resource.h>

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <string>
#include <thread>
#include <vector>

#include "reckon/pdu/seconds.hpp"
#include "reckon/peer/federate.hpp"
#include "reckon/peer/joined_peer.hpp"
#include "reckon/peer/scene/scene_file.hpp"
#include "reckon/tests/support/town_traffic.hpp"

namespace {

using namespace reckon;
using namespace std::chrono_literals;
using std::chrono::nanoseconds;

constexpr nanoseconds kFrame{16'666'667};  // 60 Hz

double cpu_seconds(int whose) {
  rusage used{};
  getrusage(whose, &used);
  return static_cast<double>(used.ru_utime.tv_sec + used.ru_stime.tv_sec) +
         1e-6 * static_cast<double>(used.ru_utime.tv_usec + used.ru_stime.tv_usec);
}

// Options with which everything can be observed, including numbered datagrams.
peer::FederateOptions options(const char* interface) {
  peer::FederateOptions options;
  options.name = "CROWD";
  options.scene = peer::dis_exercise(1);
  options.scene->network.interop = false;
  options.interface = interface;
  options.loops = peer::FederateLoops::threads;
  return options;
}

unsigned long long count(peer::Federate& federate, const char* counter) {
  return federate.peer().counters().find(counter)->value();
}

int own(const char* interface, std::size_t number, double seconds, const char* traffic) {
  std::vector<peer::EntityTrack> tracks = test::town_traffic(traffic, number);
  peer::Federate federate(options(interface));
  peer::EntityDescription car;
  car.type = {pdu::EntityKind::platform, pdu::EntityDomain::land, 0, 81, 0, 0, 0};
  federate.publish(peer::EntityClass{});
  std::vector<peer::ObjectHandle> handles;
  const nanoseconds begun = federate.now();
  for (peer::EntityTrack& track : tracks) {
    handles.push_back(federate.register_object(car, peer::truth_of(track.at(0), begun)));
  }
  std::vector<peer::EntityTruth> truths;
  double truth_cpu = 0;
  const double cpu = cpu_seconds(RUSAGE_SELF);
  const nanoseconds end = begun + pdu::from_seconds(seconds);
  for (nanoseconds next = begun; next < end; next += kFrame) {
    if (const nanoseconds early = next - federate.now(); early > 0ns)
      std::this_thread::sleep_for(early);
    const double before = cpu_seconds(RUSAGE_THREAD);
    truths.clear();
    const nanoseconds now = federate.now();
    for (peer::EntityTrack& track : tracks)
      truths.push_back(peer::truth_of(track.at(pdu::to_seconds(now - begun)), now));
    truth_cpu += cpu_seconds(RUSAGE_THREAD) - before;
    for (std::size_t i = 0; i < number; ++i) federate.update_attributes(handles[i], truths[i]);
    federate.step();
  }
  const double spent = cpu_seconds(RUSAGE_SELF) - cpu - truth_cpu;
  const double wall = pdu::to_seconds(federate.now() - begun);
  std::printf(
      R"({"core":%.4f,"truth_core":%.4f,"seconds":%.2f,"send_checks":%llu,"updates_out":%llu,)"
      R"("datagrams_out":%llu,"write_overflow":%llu})"
      "\n",
      spent / wall, truth_cpu / wall, wall, count(federate, "send_checks"),
      count(federate, "updates_out"), count(federate, "datagrams_out"),
      count(federate, "write_overflow"));
  return 0;
}

int hear(const char* interface, std::size_t number, double seconds) {
  peer::Federate federate(options(interface));
  federate.subscribe(peer::EntityClass{});
  const nanoseconds begun = federate.now();
  const nanoseconds end = begun + pdu::from_seconds(seconds);
  nanoseconds first{-1}, all{-1};
  double cpu = 0, since = 0, shown = 0;
  for (nanoseconds now = begun; now < end; now = federate.now()) {
    std::this_thread::sleep_for(kFrame);
    federate.step();
    // The snapshot of a viewer: all of them, at this instant.
    federate.for_each(
        [&](const peer::RemoteObject& object) { shown += object.shown(now).position.x(); });
    if (first < 0ns && federate.size() > 0) first = now - begun;
    if (all < 0ns && federate.size() >= number) {
      all = federate.now() - begun;
      cpu = cpu_seconds(RUSAGE_SELF);
      since = pdu::to_seconds(federate.now());
    }
  }
  const double spent = cpu_seconds(RUSAGE_SELF) - cpu;
  const double wall = pdu::to_seconds(federate.now()) - since;
  std::printf(
      R"({"first_s":%.3f,"all_s":%.3f,"core":%.4f,"size":%zu,"updates_in":%llu,)"
      R"("datagrams_in":%llu,"datagrams_lost":%llu,"kernel_drops":%llu,"stale_in":%llu,"shown":%d})"
      "\n",
      pdu::to_seconds(first), pdu::to_seconds(all), spent / wall, federate.size(),
      count(federate, "updates_in"), count(federate, "datagrams_in"),
      count(federate, "datagrams_lost"),
      static_cast<unsigned long long>(federate.peer().link().statistics().kernel_drops),
      count(federate, "stale_in"), std::isfinite(shown) ? 1 : 0);
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  const std::string side = argc > 1 ? argv[1] : "";
  try {
    if (side == "own" && argc == 6)
      return own(argv[2], std::stoul(argv[3]), std::atof(argv[4]), argv[5]);
    if (side == "hear" && argc == 5) return hear(argv[2], std::stoul(argv[3]), std::atof(argv[4]));
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
  std::fprintf(stderr,
               "usage: crowd own INTERFACE COUNT SECONDS TRAFFIC | hear INTERFACE COUNT SECONDS\n");
  return 2;
}
