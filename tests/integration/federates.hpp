// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Federates over a simulated network, stepped by hand with one clock.
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "reckon/pdu/seconds.hpp"
#include "reckon/peer/clocks/clock.hpp"
#include "reckon/peer/federate.hpp"
#include "reckon/peer/joined_peer.hpp"
#include "reckon/peer/network/simulated_network.hpp"
#include "reckon/peer/scene/scene_file.hpp"

namespace reckon::test {

/// A scene without objects, for peers of Reckon only.
[[nodiscard]] inline peer::SceneFile open_country() {
  peer::SceneFile scene = *peer::dis_exercise(1, 0.82, 0.145);
  scene.network.interop = false;
  scene.aoim.cell = 500.0;
  scene.aoim.radius = 2000.0;
  return scene;
}

class Federates {
 public:
  /// @param most that may join @param law of each direction between them
  Federates(std::size_t most, const peer::ImpairmentLaw& law, std::uint64_t seed = 1)
      : clock_(std::chrono::seconds(1), std::chrono::hours(1)),
        network_(options(most, seed), clock_) {
    network_.impair(law);
  }
  /// A law that delays, and may lose and reorder.
  [[nodiscard]] static peer::ImpairmentLaw delayed(std::chrono::nanoseconds delay,
                                                   double loss = 0.0,
                                                   std::chrono::nanoseconds jitter = {}) {
    peer::ImpairmentLaw law;
    law.delay = delay;
    law.loss = loss;
    law.jitter = jitter;
    return law;
  }

  /// Joins the next federate, which publishes and subscribes to all; its application number is its
  /// index from 1.  @param scene_peer its number in the scene; 0: none
  peer::Federate& join(const peer::SceneFile& scene, std::uint32_t scene_peer = 0) {
    const auto number = static_cast<std::uint32_t>(federates_.size() + 1);
    peer::FederateOptions options;
    options.name = "FED" + std::to_string(number);
    options.scene = scene;
    options.application = static_cast<std::uint16_t>(number);
    options.scene_peer = scene_peer;
    federates_.push_back(
        std::make_unique<peer::Federate>(options, network_.link(number - 1), clock_, number));
    federates_.back()->publish(peer::EntityClass{});
    federates_.back()->subscribe(peer::EntityClass{});
    return *federates_.back();
  }

  /// Sets the law of all directions.
  void impair(const peer::ImpairmentLaw& law) { network_.impair(law); }
  /// Sets the law of one direction.
  void impair(std::size_t sender, std::size_t receiver, const peer::ImpairmentLaw& law) {
    network_.impair(sender, receiver, law);
  }
  /// Ends a federate without a farewell; another one with this epoch takes its place.
  void restart(std::size_t i, const peer::SceneFile& scene, std::uint32_t epoch) {
    peer::FederateOptions options;
    options.scene = scene;
    options.application = static_cast<std::uint16_t>(i + 1);
    federates_[i].reset();
    federates_[i] = std::make_unique<peer::Federate>(options, network_.link(i), clock_, epoch);
  }

  /// Passes of `each` until `span` is over: time advances, drive() sets the truth, all step, look()
  /// reads the shown entities.
  template <class Drive, class Look>
  void run(std::chrono::nanoseconds span, std::chrono::nanoseconds each, Drive&& drive,
           Look&& look) {
    for (const std::chrono::nanoseconds end = now() + span; now() < end;) {
      clock_.advance(each);
      drive();
      for (auto& federate : federates_) federate->step();
      look();
    }
  }

  [[nodiscard]] std::size_t size() const { return federates_.size(); }
  /// A link without a federate: a host of its own.
  [[nodiscard]] peer::Link& link(std::size_t number) { return network_.link(number); }
  [[nodiscard]] peer::Federate& operator[](std::size_t i) { return *federates_[i]; }
  [[nodiscard]] std::chrono::nanoseconds now() const { return clock_.now(); }
  [[nodiscard]] double time() const { return pdu::to_seconds(now()); }  ///< [s]
  [[nodiscard]] std::uint64_t count(std::size_t i, const char* counter) {
    const peer::Counter* found = federates_[i]->peer().counters().find(counter);
    return found == nullptr ? 0 : found->value();
  }
  /// The ID of its first entity.
  [[nodiscard]] pdu::EntityId id_of(std::size_t i) {
    return federates_[i]->peer().model().own_id();
  }

 private:
  static peer::SimulatedNetworkOptions options(std::size_t most, std::uint64_t seed) {
    peer::SimulatedNetworkOptions options;
    options.links = most;
    options.seed = seed;
    options.datagrams_in_flight = 4096;
    return options;
  }

  peer::ManualClock clock_;
  peer::SimulatedNetwork network_;
  std::vector<std::unique_ptr<peer::Federate>> federates_;
};

}  // namespace reckon::test
