// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The hands of a program's own peers, from the snapshots that their servos publish, as a page shows
// them.
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "reckon/haptics/bodies/body_world.hpp"
#include "reckon/haptics/exchange/servo_types.hpp"
#include "reckon/peer/scene/peer_config.hpp"
#include "reckon/peer/world/peer_view.hpp"
#include "reckon/tools/viewer/view_stage.hpp"

namespace reckon::tools {

/// What the hidden twin of a hand feels.
struct TwinFeeling {
  std::optional<double> force;  ///< [N]; none while it stands aside
  double energy = 0;            ///< [J], at its port
  std::uint64_t resets = 0;     ///< times that it got lost
};

/// Follows hands, numbered from 0 over all peers. One thread: that which looks at the peers.
class OwnHands {
 public:
  /// @param hand what the scene's hands show to others
  explicit OwnHands(const peer::HandModel& hand) : hand_(hand) {}

  /// A hand of peer `peer`, in the order of their numbers.
  void add(std::size_t peer, const peer::HandView& view);
  /// The newest of a hand: from its peer's picture, or a step of its servo.
  void take(std::size_t hand, const haptics::ServoSnapshot& step);
  /// A page may move it; `free`: none does.
  void set_pointer(std::size_t hand, bool free) { hands_[hand].pointer_free = free; }
  /// It has a hidden twin.
  void set_twin(std::size_t hand, const TwinFeeling& twin) { hands_[hand].twin = twin; }
  /// Its entity may get another number while a conflict is settled.
  void set_id(std::size_t hand, const pdu::EntityId& id) { hands_[hand].id = id; }

  /// Where the scene's bodies are.
  void take_bodies(std::span<const haptics::BodyState> bodies);

  [[nodiscard]] std::size_t size() const noexcept { return hands_.size(); }
  /// As they are told once.
  [[nodiscard]] std::vector<TouchHand> names() const;
  /// Where they are. @param steady_to_utc what the steady clock lacks to UTC
  /// @param knows_all whether all hands of the exercise are among them: then what each would feel
  /// of the others without a network between them is known
  [[nodiscard]] HandFrame frame(std::chrono::nanoseconds steady_to_utc, bool knows_all);

 private:
  struct Hand {
    std::size_t peer = 0;
    pdu::EntityId id;
    std::optional<bool> pointer_free;  // of a hand that pages move
    std::optional<TwinFeeling> twin;
    double limit = 0;  // [N]
    haptics::ServoSnapshot step;
    double rate_limited = 0;  // [s], of it so far when it was looked at last
    std::uint64_t let_go = 0;
  };
  [[nodiscard]] HandMark mark(std::size_t index);
  [[nodiscard]] std::optional<double> true_force(std::size_t index) const;

  peer::HandModel hand_;
  std::vector<BodyMark> bodies_;
  std::vector<Hand> hands_;
};

}  // namespace reckon::tools
