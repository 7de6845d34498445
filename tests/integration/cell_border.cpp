// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Datagrams that a listener misses of an entity just behind each cell border that it approaches:
//   cell_border send INTERFACE BEGIN
//   cell_border hear INTERFACE BEGIN LOOKAHEAD_MS
// BEGIN: steady time of the start [ns]. The entities are sent at 200 Hz, each to the group of its
// cell. The listener prints a JSON object: datagrams missed from the moment the entity was within
// its radius, over all cells.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cstdio>
#include <cstring>
#include <exception>
#include <string>
#include <thread>

#include "reckon/aoim/cells/cell_grid.hpp"
#include "reckon/aoim/interest/subscription.hpp"
#include "reckon/pdu/seconds.hpp"
#include "reckon/peer/network/udp_multicast.hpp"

namespace {

using namespace reckon;
using namespace std::chrono_literals;
using std::chrono::nanoseconds;

constexpr int kCells = 14;
constexpr double kSide = 50, kSpeed = 40, kRadius = 100;  // [m], [m/s], [m]
constexpr double kBehind = 0.01;                          // [m], of the entity behind the border
constexpr nanoseconds kPeriod = 5ms, kFoci = 50ms;        // kFoci: update period
constexpr double kBefore = 0.3, kAfter = 1.0;             // [s] of sending around an entity's entry

struct Mark {
  int cell = 0;
  int since = 0;  // datagrams sent since it entered the radius; below 0: before
};

aoim::CellGrid grid() { return aoim::CellGrid({aoim::CellScheme::square, kSide, 256}); }
aoim::Position entity(int cell) { return {kSide * (cell + 4) + kBehind, kSide / 2, 0}; }
/// When it enters the radius of the listener [s].
double coming(int cell) { return (entity(cell).x - kRadius) / kSpeed; }

peer::UdpMulticastOptions on(const char* interface) {
  peer::UdpMulticastOptions options;
  options.interface = interface;
  return options;
}

void send(const char* interface, nanoseconds begin) {
  const peer::SteadyClock clock;
  const peer::GroupPool pool = peer::GroupPool::ipv4_default();
  const aoim::CellGrid cells = grid();
  peer::UdpMulticast link(on(interface), clock);
  std::array<int, kCells> since{};
  since.fill(-1);
  const nanoseconds end = begin + pdu::from_seconds(coming(kCells - 1) + kAfter);
  for (nanoseconds next = begin; next < end; next += kPeriod) {
    std::this_thread::sleep_for(next - clock.now());
    for (int cell = 0; cell < kCells; ++cell) {
      const double after = pdu::to_seconds(clock.now() - begin) - coming(cell);
      if (after < -kBefore || after > kAfter) continue;
      const Mark mark{cell, after < 0 ? -1 : ++since[static_cast<std::size_t>(cell)]};
      link.send(pool.address(cells.group(entity(cell)).value - 1U),
                std::as_bytes(std::span(&mark, 1)));
    }
  }
}

void hear(const char* interface, nanoseconds begin, nanoseconds lookahead) {
  const peer::SteadyClock clock;
  const peer::GroupPool pool = peer::GroupPool::ipv4_default();
  const aoim::CellGrid cells = grid();
  peer::UdpMulticast link(on(interface), clock);
  aoim::SubscriptionConfig config;
  config.lookahead = lookahead;
  aoim::Subscription subscription(cells, config);
  std::array<int, kCells> first{};
  first.fill(-1);
  std::array<peer::Datagram, 64> batch;
  const nanoseconds end = begin + pdu::from_seconds(coming(kCells - 1) + kAfter);
  nanoseconds next = begin;
  while (clock.now() < end) {
    if (clock.now() >= next) {
      const double time = pdu::to_seconds(clock.now() - begin);
      const aoim::Focus focus{{kSpeed * time, kSide / 2, 0}, kSpeed, kRadius};
      const auto change = subscription.update(std::span(&focus, 1), clock.now());
      for (const auto group : change.join) link.join(pool.address(group.value - 1U));
      for (const auto group : change.leave) link.leave(pool.address(group.value - 1U));
      next = std::max(next, begin) + kFoci;
    }
    link.wait(std::clamp<nanoseconds>(next - clock.now(), 0ns, kFoci));
    for (const peer::Datagram& datagram : std::span(batch).first(link.receive(batch))) {
      Mark mark;
      if (datagram.bytes.size() != sizeof mark) continue;
      std::memcpy(&mark, datagram.bytes.data(), sizeof mark);
      int& heard = first.at(static_cast<std::size_t>(mark.cell));
      if (heard < 0 && mark.since >= 0) heard = mark.since;
    }
  }
  int never = 0, most = 0, all = 0;
  for (const int missed : first) {
    never += missed < 0;
    most = std::max(most, missed);
    all += std::max(missed, 0);
  }
  const double period_ms = 1e3 * pdu::to_seconds(kPeriod);
  fmt::print(
      "{{\"lookahead_ms\":{:g},\"cells\":{},\"never\":{},\"missed\":{},\"mean_gap_ms\":{:.1f},"
      "\"longest_gap_ms\":{:.1f}}}\n",
      1e3 * pdu::to_seconds(lookahead), kCells, never, all, period_ms * all / kCells,
      period_ms * most);
}

}  // namespace

int main(int argc, char** argv) {
  const std::string side = argc > 1 ? argv[1] : "";
  try {
    if (side == "send" && argc == 4) {
      send(argv[2], nanoseconds(std::stoll(argv[3])));
      return 0;
    }
    if (side == "hear" && argc == 5) {
      hear(argv[2], nanoseconds(std::stoll(argv[3])),
           std::chrono::milliseconds(std::stoi(argv[4])));
      return 0;
    }
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
  std::fprintf(stderr,
               "usage: cell_border send INTERFACE BEGIN | hear INTERFACE BEGIN LOOKAHEAD_MS\n");
  return 2;
}
