// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Hosts of a simulated network that serve objects and fetch them.
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <random>
#include <string>
#include <vector>

#include "reckon/peer/clocks/clock.hpp"
#include "reckon/peer/network/simulated_network.hpp"
#include "reckon/peer/objects/object_exchange.hpp"

namespace reckon::test {

inline constexpr std::size_t kObjectPool = 256;

/// Octets without a pattern.
inline std::string random_octets(std::size_t size, std::uint64_t seed = 1) {
  std::string octets(size, '\0');
  std::mt19937_64 random(seed);
  for (char& octet : octets) octet = static_cast<char>(random());
  return octets;
}

/// A fetch into memory.
struct MemoryFetch {
  MemoryFetch(peer::ObjectExchange& exchange, const peer::ObjectHash& hash, std::uint64_t size)
      : store(size), fetch(exchange.fetch(kObjectPool, hash, size, store)) {}

  [[nodiscard]] bool is_complete() const { return fetch->state() == peer::FetchState::complete; }

  peer::MemoryStore store;
  peer::FetchHandle fetch;
};

class ObjectHosts {
 public:
  static constexpr std::chrono::microseconds kStep{250};

  /// @param law of each direction
  explicit ObjectHosts(std::size_t hosts, const peer::ImpairmentLaw& law = {},
                       std::uint64_t seed = 1)
      : clock_(std::chrono::seconds(1)),
        network_({.links = hosts, .datagrams_in_flight = 4096, .seed = seed}, clock_) {
    network_.impair(law);
    for (std::size_t i = 0; i < hosts; ++i) add(i, 1000 * seed + i);
  }

  [[nodiscard]] peer::ObjectExchange& host(std::size_t index) { return *hosts_[index]; }
  [[nodiscard]] const peer::Clock& clock() const { return clock_; }
  [[nodiscard]] peer::SimulatedNetwork& network() { return network_; }

  /// Serves an object at a host, which then knows the chunks group.
  void serve(std::size_t index, std::shared_ptr<const peer::ObjectSource> source) {
    pdu::ObjectOffer offer;
    offer.scene_hash = 7;
    offer.manifest = source->hash();
    offer.size = source->layout().size();
    offer.pool_size = kObjectPool;
    host(index).serve(std::move(source));
    host(index).offer(offer);
  }
  /// The host fails; null from then on.
  void kill(std::size_t index) { hosts_[index].reset(); }

  void step() {
    for (const auto& one : hosts_)
      if (one) one->step();
    clock_.advance(kStep);
  }
  /// Steps until done() or the time is over. @return time in seconds, or a negative number
  double run(std::chrono::nanoseconds longest, const std::function<bool()>& done) {
    const auto begin = clock_.now();
    while (clock_.now() - begin < longest) {
      step();
      if (done()) return std::chrono::duration<double>(clock_.now() - begin).count();
    }
    return -1;
  }
  [[nodiscard]] std::uint64_t octets_sent() const {
    std::uint64_t sum = 0;
    for (const auto& one : hosts_) sum += one ? one->counts().octets_sent : 0;
    return sum;
  }

 private:
  void add(std::size_t index, std::uint64_t seed) {
    peer::ObjectExchangeOptions options;
    options.base = peer::GroupPool::ipv4_default().base();
    options.epoch = static_cast<std::uint32_t>(100 + index);
    options.seed = 100 * seed + 1;
    options.simulation = {1, static_cast<std::uint16_t>(1 + index)};
    hosts_.push_back(std::make_unique<peer::ObjectExchange>(network_.link(index), clock_, options));
  }

  peer::ManualClock clock_;
  peer::SimulatedNetwork network_;
  std::vector<std::unique_ptr<peer::ObjectExchange>> hosts_;
};

}  // namespace reckon::test
