// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// One peer of the simulation: the protocol, and hands that ask for objects.
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>

#include "reckon/peer/ownership/ownership.hpp"
#include "reckon/tests/fuzz/owners/plan.hpp"

namespace reckon::fuzz::owners {

/// Lives of a peer follow each other; each has an epoch of its own.
class SimulatedOwner final : public peer::OwnershipUser {
 public:
  SimulatedOwner(const Plan& plan, std::size_t index) : plan_(plan), index_(index) { begin(0); }

  /// A new life.
  void begin(std::uint32_t started) {
    ++lives_;
    peer::OwnershipConfig config;
    config.epoch = epoch_of(index_, lives_);
    config.started = started;
    config.objects = plan_.objects;
    protocol_ = std::make_unique<peer::Ownership>(config, *this);
    is_up_ = true;
    is_paused_ = false;
  }
  [[nodiscard]] static std::uint32_t epoch_of(std::size_t index, std::uint32_t life) {
    return static_cast<std::uint32_t>(1000 * (index + 1)) + life;
  }
  [[nodiscard]] static std::size_t index_of(std::uint32_t epoch) { return epoch / 1000 - 1; }

  [[nodiscard]] peer::Ownership& protocol() noexcept { return *protocol_; }
  [[nodiscard]] const peer::Ownership& protocol() const noexcept { return *protocol_; }
  [[nodiscard]] std::uint32_t epoch() const noexcept { return epoch_of(index_, lives_); }
  [[nodiscard]] bool runs() const noexcept { return is_up_ && !is_paused_; }
  [[nodiscard]] bool is_up() const noexcept { return is_up_; }
  void set_up(bool up) noexcept { is_up_ = up; }
  void set_paused(bool paused) noexcept { is_paused_ = paused; }

  void touch(std::size_t object, bool touches) {
    hands_[object] = touches;
    if (touches) {
      protocol_->ask(object);
    } else {
      protocol_->withdraw(object);
    }
  }
  /// Asks again for what the hands of a former life touched.
  void lift_hands() { hands_.reset(); }
  void forbid_motion() noexcept { is_still_ = true; }

  [[nodiscard]] bool may_take(std::size_t, std::uint32_t) override { return true; }
  [[nodiscard]] bool is_busy(std::size_t object) override { return hands_[object]; }
  [[nodiscard]] peer::ObjectSet company_of(std::size_t object) override {
    peer::ObjectSet company;
    company.set(object);
    if (object < plan_.island) {
      for (std::size_t i = 0; i < plan_.island; ++i) company.set(i);
    }
    return company;
  }
  [[nodiscard]] bool is_any_awake() override { return plan_.moves && !is_still_; }
  [[nodiscard]] std::uint64_t host_of(std::uint32_t epoch) override {
    return plan_.hosts[index_of(epoch)];
  }

 private:
  const Plan& plan_;
  std::size_t index_;
  std::uint32_t lives_ = 0;
  bool is_up_ = true, is_paused_ = false, is_still_ = false;
  peer::ObjectSet hands_;
  std::unique_ptr<peer::Ownership> protocol_;
};

}  // namespace reckon::fuzz::owners
