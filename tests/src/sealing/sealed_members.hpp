// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Members of a sealed group on a simulated network.
#pragma once

#include <gtest/gtest.h>

#include <array>
#include <vector>

#include "reckon/peer/network/simulated_network.hpp"
#include "reckon/peer/sealing/sealed_link.hpp"
#include "reckon/tests/src/sealing/sealing_samples.hpp"

namespace reckon::peer::members {

using namespace samples;

inline const GroupAddress kBase = sealed_group(GroupPool::ipv4_default().base());

inline SealedLinkOptions options_of(const GroupKey& key, std::uint16_t application,
                                    DatagramTap* tap = nullptr) {
  SealedLinkOptions options;
  options.key = key;
  options.base = kBase;
  options.site = 1;
  options.application = application;
  options.tap = tap;
  return options;
}

/// Stores all datagrams of the base group in `tape`.
struct Network {
  explicit Network(std::size_t links, nanoseconds delay = 1ms)
      : hub({.links = links + 1, .datagrams_in_flight = 4096}, clock), recorder(hub.link(links)) {
    ImpairmentLaw law;
    law.delay = delay;
    hub.impair(law);
    EXPECT_FALSE(recorder.join(kBase));
  }
  void record() {
    std::array<Datagram, 32> batch;
    while (const std::size_t count = recorder.receive(batch))
      for (std::size_t i = 0; i < count; ++i)
        tape.emplace_back(batch[i].bytes.begin(), batch[i].bytes.end());
  }

  ManualClock clock{1s};
  SimulatedNetwork hub;
  Link& recorder;
  std::vector<Octets> tape;
};

/// A member and the contents that its link returned.
struct Member {
  Member(Network& network, std::size_t index, const GroupKey& key, DatagramTap* tap = nullptr,
         const Clock* clock = nullptr)
      : sealed(network.hub.link(index), options_of(key, static_cast<std::uint16_t>(index), tap),
               clock != nullptr ? *clock : network.clock) {
    sealed.count_in(counters);
    EXPECT_FALSE(sealed.join(kBase));
  }
  void say(std::uint8_t word) {
    const std::array<std::byte, 100> octets{std::byte{word}};
    EXPECT_TRUE(sealed.send(kBase, octets));
  }
  void read() {
    std::array<Datagram, 16> batch;
    while (const std::size_t count = sealed.receive(batch))
      for (std::size_t i = 0; i < count; ++i) {
        heard.push_back(std::to_integer<std::uint8_t>(batch[i].bytes[0]));
        from = batch[i];
      }
  }
  std::uint64_t count(std::string_view name) const { return counters.find(name)->value(); }

  Counters counters;
  SealedLink sealed;
  std::vector<std::uint8_t> heard;
  Datagram from{};  // the last one
};

template <typename... Members>
void run(Network& network, nanoseconds span, Members&... members) {
  for (nanoseconds passed{0}; passed < span; passed += 1ms) {
    (members.read(), ...);
    network.record();
    network.clock.advance(1ms);
  }
}

}  // namespace reckon::peer::members
