// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The hands of a program's own peers for a page, from the snapshots that their servos publish.
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "reckon/haptics/bodies/body_world.hpp"
#include "reckon/haptics/exchange/servo_types.hpp"
#include "reckon/peer/settings/hand_config.hpp"
#include "reckon/peer/world/peer_view.hpp"
#include "reckon/tools/viewer/view_stage.hpp"

namespace reckon::tools {

/// Force and energy of a hand's hidden twin.
struct TwinFeeling {
  std::optional<double> force;  ///< [N]; none after a reset, while the twin waits
  double energy = 0;            ///< [J], at its port
  std::uint64_t resets = 0;     ///< number of resets
};

/// Follows hands, numbered from 0 over all peers. One thread, the reader of the peers' views.
class OwnHands {
 public:
  /// @param hand model that the scene's hands show to others
  explicit OwnHands(const peer::HandModel& hand) : hand_(hand) {}

  /// Adds a hand of peer `peer`, in the order of their numbers.
  void add(std::size_t peer, const peer::HandView& view);
  /// Sets the newest snapshot of a hand: from its peer's view, or from a step of its servo.
  void take(std::size_t hand, const haptics::ServoSnapshot& step);
  /// Marks a hand that pages may move; `free`: no page has it.
  void set_pointer(std::size_t hand, bool free) { hands_[hand].pointer_free = free; }
  /// Marks a hand that has a hidden twin.
  void set_twin(std::size_t hand, const TwinFeeling& twin) { hands_[hand].twin = twin; }
  /// Sets the ID of a hand's entity, which may change while a conflict is resolved.
  void set_id(std::size_t hand, const pdu::EntityId& id) { hands_[hand].id = id; }

  /// Sets the poses of the scene's bodies.
  void take_bodies(std::span<const haptics::BodyState> bodies);

  /// Sets the owners of the bodies. @param rests see PeerView::bodies_rest
  void take_owners(std::span<const peer::BodyOwnerView> owners, bool rests);

  [[nodiscard]] std::size_t size() const noexcept { return hands_.size(); }
  /// The constant properties of the hands.
  [[nodiscard]] std::vector<TouchHand> names() const;
  /// The present state of the hands. @param steady_to_utc offset from the steady clock to UTC
  /// @param knows_all whether all hands of the exercise are among them: then the forces without a
  /// network between them are known
  [[nodiscard]] HandFrame frame(std::chrono::nanoseconds steady_to_utc, bool knows_all);

 private:
  struct Hand {
    std::size_t peer = 0;
    pdu::EntityId id;
    std::optional<bool> pointer_free;  // only for a hand that pages move
    std::optional<TwinFeeling> twin;
    double limit = 0;  // [N]
    haptics::ServoSnapshot step;
    double rate_limited = 0;              // [s], total at the last call of frame()
    double at_bodies = 0, at_others = 0;  // [s], the same: at bodies of any peer, of other peers
    bool is_at_body = false, is_at_others = false;  // since the last call of frame()
    std::uint64_t force_drops = 0;
  };
  [[nodiscard]] HandMark mark(std::size_t index);
  void note_bodies();
  [[nodiscard]] bool shares_body(std::size_t index) const;
  [[nodiscard]] std::optional<double> true_force(std::size_t index) const;

  peer::HandModel hand_;
  std::vector<BodyMark> bodies_;
  std::vector<peer::BodyOwnerView> owners_;  // of owners_text_
  bool rests_ = false;
  std::shared_ptr<const std::string> owners_text_;
  std::vector<Hand> hands_;
};

}  // namespace reckon::tools
