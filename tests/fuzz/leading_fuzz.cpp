// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// PDUs of any octets in the names of two known peers, as input of the area of interest manager
// where cells have leaders: claims, maps of groups, snapshots, states. Its tables stay within
// bounds, sent and accepted PDUs read back, and its next step is due in time.
#include <algorithm>
#include <array>
#include <chrono>
#include <vector>

#include "reckon/aoim/area_of_interest_manager.hpp"
#include "reckon/tests/fuzz/fuzz_target.hpp"
#include "reckon/tests/fuzz/sound_step.hpp"

namespace reckon::fuzz {
namespace {

using std::chrono::milliseconds;
using std::chrono::nanoseconds;

constexpr std::size_t kPool = 6;
constexpr std::size_t kHead = 5;  // octets before each PDU: action, group, time, length
// Memory that one record of the input may make the manager hold: maps and snapshots are 64 KiB at
// most.
constexpr std::size_t kMostHeld = std::size_t{8} << 20;

pdu::Presence presence_of(std::uint16_t application) {
  pdu::Presence own;
  own.simulation = {7, application};
  own.epoch = application;
  own.started = 100u + application;
  return own;
}

aoim::AreaOfInterestConfig config(bool hand_out) {
  aoim::AreaOfInterestConfig config;
  config.grid.cell_size = 50.0;
  config.grid.pool = kPool;
  config.presence.capacity = 8;
  config.tracked = 32;
  config.leader.on = true;
  config.leader.hand_out = hand_out;
  return config;
}

aoim::SourceAddress source_of(std::uint16_t application) {
  aoim::SourceAddress from;
  from.port = application;
  return from;
}

class Session {
 public:
  explicit Session(bool hand_out) : aoim_(config(hand_out), presence_of(1)) {
    look(0.0);
    aoim_.start(now_);
    for (const std::uint16_t peer : std::array<std::uint16_t, 2>{2, 3}) {
      const pdu::Presence heard = aoim::announcement(presence_of(peer), config(hand_out));
      std::vector<std::byte> octets(pdu::wire_size(heard));
      static_cast<void>(pdu::encode(heard, octets));
      say(peer, aoim::kBaseGroup, octets);
    }
    step();
  }

  void operate(std::span<const std::byte> head, std::span<const std::byte> octets) {
    const auto at = [&](std::size_t i) { return std::to_integer<unsigned>(head[i]); };
    now_ += milliseconds(at(2) < 200 ? at(2) : (at(2) - 199) * 100);
    const aoim::GroupIndex group{static_cast<std::uint16_t>(at(1) % (kPool + 1))};
    say(static_cast<std::uint16_t>(2 + at(0) % 2), group, octets);
    if (at(0) % 8 == 4) look(10.0 * at(1));
    if (at(0) % 16 != 8) step();
    require(aoim_.leading()->role().directory().entries().size() <= kPool,
            "a map of more than the pool");
    require(aoim_.subscriptions().joined_groups() <= kPool, "more groups joined than there are");
  }

 private:
  void look(double x) {
    const aoim::Focus focus{{x, 0.0, 0.0}, 0.0, 60.0};
    const aoim::SubscriptionChange change =
        aoim_.listen(aoim::kCellTier, std::span(&focus, 1), now_);
    for (const auto& groups : {change.join, change.leave}) {
      for (const aoim::GroupIndex group : groups)
        require(group.value >= 1 && group.value <= kPool, "a group that does not exist");
    }
  }
  void say(std::uint16_t peer, aoim::GroupIndex group, std::span<const std::byte> octets) {
    std::vector<std::byte> datagram(octets.begin(), octets.end());
    pdu::DatagramTrailer trailer;
    trailer.epoch = peer;
    trailer.sequence = ++sequences_[peer % 2][group.value];
    datagram.resize(octets.size() + pdu::kDatagramTrailerSize);
    static_cast<void>(pdu::encode(trailer, std::span(datagram).subspan(octets.size())));
    static_cast<void>(aoim_.receive(group, datagram, now_, source_of(peer)));
    static_cast<void>(aoim_.take_events());
  }
  void step() {
    step_soundly(aoim_, kPool, now_);
    for (const aoim::RelayedState& told : aoim_.leading()->take_relayed(now_)) {
      pdu::EntityState state;
      require(pdu::decode(told.octets, state) == pdu::DecodeError::none, "a told state is none");
      require(told.heard <= now_, "a state was told before it was heard");
      require(told.epoch != 1, "our own state was told to us");
    }
    require(aoim_.route({}).value <= kPool, "a state would go to a group that does not exist");
  }

  nanoseconds now_ = std::chrono::seconds(10);
  aoim::AreaOfInterestManager aoim_;
  std::array<std::array<std::uint32_t, kPool + 1>, 2> sequences_{};
};

}  // namespace

void check(std::span<const std::byte> input) {
  if (input.empty()) return;
  Session session((std::to_integer<unsigned>(input[0]) & 1) != 0);
  input = input.subspan(1);
  const HeapMeter heap;
  while (input.size() >= kHead) {
    const auto head = input.first(kHead);
    const std::size_t length = pdu::load_big_endian<std::uint16_t>(head.data() + 3);
    input = input.subspan(kHead);
    const auto octets = input.first(std::min(length, input.size()));
    session.operate(head, octets);
    input = input.subspan(octets.size());
  }
  require(heap.peak() <= kMostHeld, "the manager holds too much");
}

}  // namespace reckon::fuzz
