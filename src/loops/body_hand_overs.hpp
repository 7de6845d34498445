// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Lets the world simulate the bodies that this peer may move, and no others: it stops those that
// are given away, and goes on with those that were granted.
#pragma once

#include <array>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <optional>

#include "reckon/haptics/bodies/body_world.hpp"
#include "reckon/peer/loops/body_stage.hpp"
#include "reckon/peer/ownership/ownership.hpp"

namespace reckon::peer {

/// Number of a world in OwnershipRecord::world; not 0.
[[nodiscard]] std::uint32_t number_of(const WorldId& world) noexcept;

/// Thread of the model loop; no allocation.
class BodyHandOvers {
 public:
  using Nanoseconds = std::chrono::nanoseconds;
  /// All outlive it.
  struct Stages {
    BodyStage& bodies;
    OwnedEntities& owned;
    RemoteEntities& remote;
  };

  /// @param world may be null; then call nothing  @param epoch of this peer
  BodyHandOvers(haptics::BodyWorld* world, Ownership& protocol, const Stages& stages,
                std::uint32_t epoch)
      : world_(world), protocol_(protocol), stages_(stages), epoch_(epoch) {}

  /// Whether this peer can simulate the body.
  [[nodiscard]] bool can_own(std::size_t body) const noexcept {
    return stages_.bodies.is_body(body) && world_->can_own(body);
  }
  /// Record of the states of a body that this peer owns.
  [[nodiscard]] pdu::OwnershipRecord own_record(std::size_t body) const noexcept;

  /// Takes the last states of bodies that the world has stopped. Then their grants are sent.
  void take_answers(const Pass& pass) noexcept;
  void note(const OwnershipEvent& event) noexcept;
  /// While another peer owns a body, the world simulates a copy of it. @param delay of its states
  /// [s]; infinite: the copy is not drawn to them; < 0: no copy
  void copy(std::size_t body, double delay) noexcept { delays_[body] = delay; }
  [[nodiscard]] bool copies(std::size_t body) const noexcept { return delays_[body] >= 0.0; }
  /// After the events of a pass.
  void send_orders(const Pass& pass) noexcept;
  /// This peer sends the body's states from now on.
  void begin_own(std::size_t body) noexcept { left_at_[body] = Nanoseconds(0); }
  /// Brings bodies to rest whose new owner has sent no state yet.
  void doubt_left(Nanoseconds now) noexcept;
  /// Brings a moving body to rest if no round of its owner and no state of the body has arrived for
  /// 1 s. The owner of a moving body sends ten rounds a second.
  void doubt_silent(Nanoseconds now) noexcept;

 private:
  // Bodies that this peer stops simulating in order to give them away.
  struct Yield {
    std::uint32_t transaction = 0;  // 0: none
    std::uint64_t serial = 0;       // of the orders; 0: not sent yet
    ObjectSet objects;              // without an answer
  };

  [[nodiscard]] static std::array<double, kMostOwnable> none() noexcept {
    std::array<double, kMostOwnable> delays;
    delays.fill(-1.0);
    return delays;
  }
  void take_ends() noexcept;
  void finish_yields() noexcept;
  void send_yields() noexcept;
  void send_changes() noexcept;
  [[nodiscard]] haptics::BodyOrder order_for(std::size_t body, haptics::BodyAct act) const noexcept;
  [[nodiscard]] std::optional<haptics::BodyAct> act_for(
      std::size_t body, const haptics::BodyState& state) const noexcept;
  [[nodiscard]] haptics::ObjectMotion granted_motion(std::size_t object) const noexcept;

  haptics::BodyWorld* world_;
  Ownership& protocol_;
  Stages stages_;
  std::uint32_t epoch_;
  Pass pass_;
  std::array<double, kMostOwnable> delays_ = none();  // of copies
  ObjectSet undrawn_;                                 // copies, as ordered last
  ObjectSet granted_;                                 // gained in the state of a grant
  std::array<std::uint64_t, kMostOwnable> sent_{};    // serial of the last order to a body
  std::array<Nanoseconds, kMostOwnable> left_at_{};   // shown by its last state here; 0: not
  std::array<Yield, 32> yields_{};
};

}  // namespace reckon::peer
