// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The page of one peer: shows its own hands, which pages may take over.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "reckon/haptics/bodies/body_world.hpp"
#include "reckon/peer/peer.hpp"
#include "reckon/peer/scene/scene_file.hpp"
#include "reckon/peer/world/peer_view.hpp"
#include "reckon/tools/exercise/simulated_hand.hpp"
#include "reckon/tools/verbs/view_controls.hpp"
#include "reckon/tools/viewer/self_view.hpp"

namespace reckon::tools {

/// Properties of the peer for its page.
struct PeerPageOptions {
  std::string source;  ///< the scene, as named
  std::string iface;   ///< interface of the peer; empty: the scene's, else chosen by rule
};

/// One thread, the reader of the peer's views.
class PeerPage {
 public:
  /// @param peer outlives this @param view of the peer, with its hands
  /// @param pointers the hands that follow pointers; their devices outlive this
  /// @throws as SelfView
  PeerPage(const ViewFlags& flags, const peer::SceneFile& scene, const PeerPageOptions& options,
           peer::Peer& peer, const peer::PeerView& view, std::span<const PointerHand> pointers)
      : peer_(peer),
        pointers_(pointers.begin(), pointers.end()),
        controls_({}, nullptr, [&peer] { peer.go_alone(); }),
        view_(flags, scene,
              {.kind = "peer",
               .source = options.source,
               .iface = options.iface,
               .controls = &controls_},
              hands_of(scene, view)) {
    view_.add_receiver(peer);
  }

  /// Shows the present state of the hands and bodies.
  void show(const peer::PeerView& view) {
    OwnHands& hands = view_.hands();
    for (std::size_t i = 0; i < view.hand_count && i < hands.size(); ++i) {
      hands.set_id(i, view.hands[i].id);
      hands.take(i, view.hands[i].servo);
    }
    if (haptics::BodyWorld* bodies = peer_.bodies(); bodies != nullptr) {
      (void)bodies->published().update();
      hands.take_bodies(bodies->published().read().bodies);
    }
    hands.take_owners(std::span(view.body_owners).first(view.body_owner_count), view.bodies_rest);
    controls_.set_rests(view.bodies_rest);
    mark_pointers(hands);
    view_.show_hands();
  }
  void note(const peer::Notice& notice) { view_.note(notice.text.data()); }
  [[nodiscard]] const SelfView& view() const noexcept { return view_; }

 private:
  void mark_pointers(OwnHands& hands) const {
    for (const PointerHand& pointer : pointers_)
      hands.set_pointer(pointer.device, controls_.is_free(pointer.device));
  }
  [[nodiscard]] OwnHands hands_of(const peer::SceneFile& scene, const peer::PeerView& view) {
    OwnHands hands(scene.hand);
    for (const peer::HandView& hand : view.own_hands()) hands.add(0, hand);
    for (const PointerHand& pointer : pointers_) controls_.add_hand(pointer.device, pointer);
    mark_pointers(hands);
    return hands;
  }

  peer::Peer& peer_;
  std::vector<PointerHand> pointers_;
  ViewControls controls_;  // used by the page, so declared before it
  SelfView view_;
};

}  // namespace reckon::tools
