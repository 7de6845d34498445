// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Owners in one process that exchange messages at once, for tests.
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <utility>
#include <vector>

#include "reckon/peer/ownership/ownership.hpp"

namespace reckon::peer {

class LocalOwner final : public OwnershipUser {
 public:
  LocalOwner(std::uint32_t number, std::size_t objects)
      : epoch(number), protocol({number, number, objects, true}, *this) {}

  [[nodiscard]] bool may_take(std::size_t, std::uint32_t taker) override {
    return taker != untouchable;
  }
  [[nodiscard]] bool is_busy(std::size_t object) override { return busy[object]; }
  [[nodiscard]] ObjectSet company_of(std::size_t object) override {
    ObjectSet set;
    set.set(object);
    return set | company;
  }
  [[nodiscard]] bool is_any_awake() override { return true; }
  [[nodiscard]] std::uint64_t host_of(std::uint32_t of) override {
    return one_host ? 1 : std::uint64_t{of};
  }

  std::uint32_t epoch;
  std::uint32_t untouchable = 0;
  ObjectSet busy, company;
  bool one_host = false, runs = true;
  std::vector<OwnershipEvent> events;
  Ownership protocol;
};

/// Peers 1, 2 .. with these numbers as epochs; the first is the oldest.
class LocalOwners {
 public:
  explicit LocalOwners(std::size_t peers, std::size_t objects = 2) {
    for (std::size_t i = 1; i <= peers; ++i)
      owners_.push_back(std::make_unique<LocalOwner>(static_cast<std::uint32_t>(i), objects));
  }
  [[nodiscard]] LocalOwner& operator[](std::size_t epoch) { return *owners_[epoch - 1]; }
  /// Runs in steps of 10 ms.
  void run(std::chrono::milliseconds time) {
    for (std::chrono::milliseconds passed{0}; passed < time;
         passed += std::chrono::milliseconds(10)) {
      now += std::chrono::milliseconds(10);
      for (const auto& owner : owners_) {
        if (!owner->runs) continue;
        owner->protocol.step(now);
        exchange(*owner);
      }
    }
  }
  /// All vote, and the first owns all objects.
  void begin() { run(std::chrono::seconds(6)); }
  [[nodiscard]] bool owns(std::size_t epoch, std::size_t object) {
    return (*this)[epoch].protocol.owns(object, now);
  }

  std::chrono::nanoseconds now{std::chrono::seconds(100)};
  /// Whether a message is lost.
  std::function<bool(std::uint32_t from, std::uint32_t to, const OwnershipMessage&)> loses =
      [](auto, auto, const auto&) { return false; };
  std::vector<std::pair<std::uint32_t, OwnershipMessage>> sent;  ///< by all, with the sender

 private:
  void exchange(LocalOwner& owner) {
    for (const OwnershipEvent& event : owner.protocol.events()) {
      owner.events.push_back(event);
      if (event.kind == OwnershipEvent::Kind::yield) owner.protocol.yielded(event.transaction, now);
    }
    owner.protocol.clear_events();
    const std::vector<OutgoingMessage> out(owner.protocol.outgoing().begin(),
                                           owner.protocol.outgoing().end());
    owner.protocol.clear_outgoing();
    for (const OutgoingMessage& message : out) {
      sent.emplace_back(owner.epoch, message.message);
      for (const auto& other : owners_) {
        const bool is_for = message.to == 0 || message.to == other->epoch;
        if (other->epoch == owner.epoch || !is_for || !other->runs) continue;
        if (loses(owner.epoch, other->epoch, message.message)) continue;
        other->protocol.receive(owner.epoch, message.message, now);
        exchange(*other);
      }
    }
  }
  std::vector<std::unique_ptr<LocalOwner>> owners_;
};

}  // namespace reckon::peer
