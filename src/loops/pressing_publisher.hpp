// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Publishes the remote hands near the bodies that this peer simulates.
#pragma once

#include <array>
#include <chrono>
#include <cstddef>
#include <span>

#include "reckon/haptics/bodies/body_world.hpp"
#include "reckon/haptics/exchange/servo_types.hpp"
#include "reckon/haptics/exchange/triple_buffer.hpp"
#include "reckon/haptics/servo/pressing_hands.hpp"
#include "reckon/peer/loops/touch_stage.hpp"
#include "reckon/peer/world/remote_entities.hpp"

namespace reckon::peer {

/// Publishes the nearest hands of other Reckon peers, up to PressingHands::kMost. Searches all felt
/// entities and bodies every kSearch; each publish() reads the newest updates of the found hands.
/// Thread of the model loop; no allocation.
class PressingPublisher {
 public:
  static constexpr std::chrono::milliseconds kSearch{50};
  static constexpr double kReach = 0.3;  ///< [m], between hand and body

  /// All outlive this. @param world, out may be null: then nothing is published  @param touch
  /// source of the energy accounts of hands
  PressingPublisher(const haptics::BodyWorld* world, haptics::TripleBuffer<haptics::HandList>* out,
                    const TouchStage& touch) noexcept
      : world_(world), out_(out), touch_(touch) {}

  void publish(std::span<const haptics::BodyState> bodies, const RemoteEntities& remote,
               std::chrono::nanoseconds now) noexcept;
  /// Number of hands that are near bodies and do not press them, beyond PressingHands::kMost.
  [[nodiscard]] std::size_t left_out() const noexcept { return left_out_; }

 private:
  struct Found {
    pdu::EntityId id;
    double distance = 0.0;  // [m]
  };
  void search(std::span<const haptics::BodyState> bodies, const RemoteEntities& remote,
              std::chrono::nanoseconds now) noexcept;

  const haptics::BodyWorld* world_;
  haptics::TripleBuffer<haptics::HandList>* out_;
  const TouchStage& touch_;
  std::chrono::nanoseconds searched_{-kSearch};
  std::array<Found, haptics::PressingHands::kMost> found_{};
  std::size_t count_ = 0, left_out_ = 0;
  haptics::HandList sent_;
};

}  // namespace reckon::peer
