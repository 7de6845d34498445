// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Finds the present peers and a free peer number, before a peer joins a scene made for several
// peers. Two peers that start at the same instant get different numbers.
#pragma once

#include <algorithm>
#include <array>
#include <chrono>
#include <cstdint>

#include "reckon/aoim/area_of_interest_manager.hpp"
#include "reckon/pdu/bundle.hpp"
#include "reckon/pdu/timestamp.hpp"
#include "reckon/peer/clocks/clock.hpp"
#include "reckon/peer/loops/aoim_setup.hpp"
#include "reckon/peer/network/link.hpp"

namespace reckon::peer {

/// Announces a peer without a number on the base group until its ID is settled, and then takes a
/// number. One thread; exclusive use of the link until leave().
class RollCall {
 public:
  /// Longest time that answer() takes.
  static constexpr std::chrono::seconds kLongest{4};

  /// @param own an announcement (see presence()) with a separate epoch.
  /// @param link,clock exclusive and real time; outlive this.
  RollCall(Link& link, const Clock& clock, const GroupAddress& base,
           const aoim::AreaOfInterestConfig& config, const pdu::Presence& own)
      : link_(link),
        clock_(clock),
        base_(base),
        presence_(config.presence, aoim::announcement(without_number(own), config)) {
    static_cast<void>(link_.join(base_));  // the peer joins it again, and reports a failure
    presence_.start(clock_.now());
  }

  /// Determines the number of this peer in the scene, from 1: the smallest that no peer has. Peers
  /// without a number take one in the order of their IDs. Takes about a second; announces the
  /// number to the others.
  [[nodiscard]] std::uint8_t answer() {
    const std::chrono::nanoseconds end = clock_.now() + kLongest;
    while (!presence_.is_settled() && clock_.now() < end) {
      speak();
      listen(kListen);
    }
    presence_.take_scene_peer();
    is_first_ = std::ranges::none_of(presence_.peers(), [](const aoim::Peer& peer) {
      return peer.joined && peer.announced.scene_peer != pdu::kScenePeerWanted;
    });
    presence_.start(clock_.now());  // at once
    speak();
    return presence_.own().scene_peer;
  }
  /// The ID, settled by answer().
  [[nodiscard]] aoim::PeerId id() const noexcept { return presence_.id(); }
  /// Whether answer() has received no peer of this scene that had joined before.
  [[nodiscard]] bool is_first() const noexcept { return is_first_; }
  /// Sends the leaving announcement of this epoch; call it after the peer itself has announced its
  /// number.
  void leave() {
    for (int i = 0; i < kGoodbyes; ++i) {
      presence_.start(clock_.now());
      presence_.stop();
      speak();
    }
  }

 private:
  static constexpr std::chrono::nanoseconds kListen = std::chrono::milliseconds(20);  // per attempt
  static constexpr int kGoodbyes = 3;  // some may be lost

  static pdu::Presence without_number(pdu::Presence own) {
    own.scene_peer = pdu::kScenePeerWanted;
    return own;
  }

  void listen(std::chrono::nanoseconds longest) {
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
  void speak() {
    // Sends without a trailer, because the peer numbers those.
    const std::chrono::nanoseconds utc = clock_.utc_now();
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

  Link& link_;
  const Clock& clock_;
  GroupAddress base_;
  aoim::Presence presence_;
  bool is_first_ = false;
};

}  // namespace reckon::peer
