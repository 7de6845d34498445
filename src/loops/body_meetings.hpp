// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Predicts contacts of this peer's bodies with bodies of others, and groups this peer's bodies by
// contact.
#pragma once

#include <array>
#include <bitset>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>

#include "reckon/haptics/bodies/body_world.hpp"
#include "reckon/peer/ownership/messages.hpp"
#include "reckon/peer/world/shared_bodies.hpp"

namespace reckon::peer {

/// Thread of the model loop; no allocation. Every kLook it looks at each pair of a moving body of
/// ours, or a copy that our hand touches, and a body of another peer.
class BodyMeetings {
 public:
  static constexpr std::chrono::milliseconds kLook{10};

  /// @param world may be null; then call nothing
  explicit BodyMeetings(const haptics::BodyWorld* world) noexcept : world_(world) {}

  void look(std::span<const haptics::BodyState> bodies, std::chrono::nanoseconds now) noexcept;
  /// Time until a body of ours meets this one of another peer [s]; infinite: none does soon.
  [[nodiscard]] double time_to(std::size_t body) const noexcept { return met_[body].time; }
  /// The body of ours that meets it.
  [[nodiscard]] std::size_t own_of(std::size_t body) const noexcept { return met_[body].own; }
  /// Whether it meets a copy that our hand touches.
  [[nodiscard]] bool is_beside(std::size_t body) const noexcept { return beside_[body]; }
  /// Owned bodies in contact with `body`, directly or through others, itself included. None: it had
  /// no contact within kContactHold. That time covers single steps in which pressed bodies sleep or
  /// separate.
  [[nodiscard]] ObjectSet company_of(std::size_t body,
                                     std::span<const haptics::BodyState> bodies) const noexcept;

 private:
  static constexpr std::chrono::milliseconds kContactHold{300};

  void note_company(std::span<const haptics::BodyState> bodies) noexcept;

  struct Company {
    ObjectSet bodies;
    std::chrono::nanoseconds seen{-kContactHold};
  };
  struct Meeting {
    double time = std::numeric_limits<double>::infinity();
    std::uint32_t own = 0;
  };

  const haptics::BodyWorld* world_;
  std::array<Meeting, kMostSharedBodies> met_{};
  std::bitset<kMostSharedBodies> beside_;
  std::array<Company, kMostSharedBodies> companies_{};
  std::chrono::nanoseconds looked_{-kLook};
};

}  // namespace reckon::peer
