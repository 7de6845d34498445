// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/peer/loops/roll_call.hpp"

#include <algorithm>
#include <array>

#include "reckon/pdu/bundle.hpp"
#include "reckon/pdu/timestamp.hpp"
#include "reckon/peer/loops/aoim_setup.hpp"

namespace reckon::peer {
namespace {

using std::chrono::nanoseconds;

constexpr nanoseconds kListen = std::chrono::milliseconds(20);  // per attempt
constexpr int kGoodbyes = 3;                                    // some may be lost

pdu::Presence without_number(pdu::Presence own) {
  own.scene_peer = pdu::kScenePeerWanted;
  return own;
}

}  // namespace

RollCall::RollCall(Link& link, const Clock& clock, const GroupAddress& base,
                   const aoim::AreaOfInterestConfig& config, const pdu::Presence& own)
    : link_(link),
      clock_(clock),
      base_(base),
      presence_(config.presence, aoim::announcement(without_number(own), config)) {
  static_cast<void>(link_.join(base_));  // the peer joins it again, and reports a failure
  presence_.start(clock_.now());
}

std::uint8_t RollCall::answer() {
  const nanoseconds end = clock_.now() + kLongest;
  while (!presence_.is_settled() && clock_.now() < end) {
    speak();
    listen(kListen);
  }
  presence_.take_scene_peer();
  presence_.start(clock_.now());  // at once
  speak();
  return presence_.own().scene_peer;
}

void RollCall::leave() {
  for (int i = 0; i < kGoodbyes; ++i) {
    presence_.start(clock_.now());
    presence_.stop();
    speak();
  }
}

void RollCall::listen(nanoseconds longest) {
  static_cast<void>(link_.wait(longest));
  std::array<Datagram, 32> datagrams;
  const std::size_t count = link_.receive(datagrams);
  for (const Datagram& datagram : std::span(datagrams).first(count)) {
    if (datagram.group != base_) continue;
    for (const pdu::BundledPdu& bundled : pdu::BundleReader(datagram.bytes)) {
      if (bundled.error != pdu::DecodeError::none) continue;
      pdu::Presence heard;
      if (bundled.header.pdu_type != pdu::PduType::presence) continue;
      if (pdu::decode(bundled.bytes, heard) != pdu::DecodeError::none) continue;
      presence_.receive(heard, clock_.now(), source_of(datagram.sender, datagram.boot));
    }
  }
}

// Sends without a trailer, because the peer numbers those.
void RollCall::speak() {
  const nanoseconds utc = clock_.utc_now();
  const std::uint32_t timestamp = pdu::to_dis_timestamp(utc, true);
  for (pdu::Presence announced : presence_.step(clock_.now(), utc, timestamp)) {
    // A process that leaves now never was a peer.
    if (announced.flags & pdu::kPresenceLeaving) announced.scene_peer = pdu::kScenePeerWanted;
    std::array<std::byte, pdu::kFixedSize<pdu::Presence>> octets;
    const std::size_t size = pdu::encode(announced, octets);
    static_cast<void>(link_.send(base_, std::span(octets).first(size)));
  }
  static_cast<void>(presence_.take_events());
}

}  // namespace reckon::peer
