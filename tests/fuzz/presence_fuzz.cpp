// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Announcements of few ids, epochs and sources, so that they conflict, between steps of any length.
// The table stays within its bounds and allocates no heap, contains no epoch and no id twice, and
// the next step is due in time.
#include <algorithm>
#include <chrono>

#include "reckon/aoim/presence/presence.hpp"
#include "reckon/tests/fuzz/fuzz_target.hpp"

namespace reckon::fuzz {
namespace {

using std::chrono::milliseconds;
using std::chrono::nanoseconds;

constexpr std::size_t kCapacity = 8, kStep = 5;
constexpr std::uint32_t kOwn = 1;

pdu::Presence announced(std::uint16_t application, std::uint32_t epoch) {
  pdu::Presence presence;
  presence.simulation = {7, application};
  presence.epoch = epoch;
  presence.started = 100;
  return presence;
}

void check_table(const aoim::Presence& presence) {
  const auto peers = presence.peers();
  require(peers.size() <= kCapacity, "more peers are listed than the table has rows");
  for (std::size_t i = 0; i < peers.size(); ++i) {
    require(peers[i].announced.epoch != kOwn, "we are among the others");
    for (std::size_t k = 0; k < i; ++k) {
      require(peers[k].announced.epoch != peers[i].announced.epoch, "a life is listed twice");
      require(peers[k].id() != peers[i].id(), "an id is listed twice");
    }
  }
}

void check_time(aoim::Presence& presence, nanoseconds now) {
  const std::size_t announcements = presence.step(now).size();
  static_cast<void>(presence.take_list(now));
  require(announcements <= 2 + kCapacity, "a step announces us more often than there are peers");
  require(presence.next_step() > now, "the next step is due before this one");
}

// One operation of five octets: kind, id, life, source and started, time.
void operate(aoim::Presence& presence, std::span<const std::byte> octets, nanoseconds& now) {
  const auto at = [&](std::size_t i) { return std::to_integer<unsigned>(octets[i]); };
  const std::uint32_t epoch = kOwn + at(2) % 24;
  pdu::Presence heard = announced(static_cast<std::uint16_t>(1 + at(1) % 12), epoch);
  heard.started = at(3) / 16 * 10;
  if (at(0) % 8 == 1) heard.flags |= pdu::kPresenceLeaving;
  if (at(0) % 8 == 2) heard.scene_hash = 1;
  aoim::SourceAddress from;
  from.port = static_cast<std::uint16_t>(at(3) % 16);
  if (at(0) % 8 == 3) {
    presence.note_alive(epoch, now);
  } else {
    presence.receive(heard, now, from);
  }
  check_table(presence);
  for (const aoim::PresenceEvent& event : presence.take_events()) {
    require(event.announced.epoch != 0, "an event concerns nobody");
  }
  now += milliseconds(at(4) < 200 ? at(4) : (at(4) - 199) * 100);
  if (at(0) >= 128) check_time(presence, now);
  static_cast<void>(presence.standing(epoch));
  check_table(presence);
}

}  // namespace

void check(std::span<const std::byte> input) {
  aoim::PresenceConfig config;
  config.capacity = kCapacity;
  aoim::Presence presence(config, announced(1, kOwn));
  nanoseconds now = std::chrono::seconds(10);
  const HeapMeter heap;
  presence.start(now);
  for (; input.size() >= kStep; input = input.subspan(kStep)) operate(presence, input, now);
  presence.stop();
  static_cast<void>(presence.step(now));
  require(heap.allocations() == 0, "presence took heap");
}

}  // namespace reckon::fuzz
