// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/tools/verbs/peer_page.hpp"

namespace reckon::tools {

PeerPage::PeerPage(const ViewFlags& flags, const peer::SceneFile& scene,
                   const PeerPageOptions& options, const peer::PeerView& view,
                   std::span<const PointerHand> pointers)
    : pointers_(pointers.begin(), pointers.end()),
      controls_({}, nullptr),
      view_(flags, scene,
            {.kind = "peer",
             .source = options.source,
             .iface = options.iface,
             .controls = &controls_},
            hands_of(scene, view)) {}

void PeerPage::show(const peer::PeerView& view) {
  OwnHands& hands = view_.hands();
  for (std::size_t i = 0; i < view.hand_count && i < hands.size(); ++i) {
    hands.set_id(i, view.hands[i].id);
    hands.take(i, view.hands[i].servo);
  }
  mark_pointers(hands);
  view_.show_hands();
}

void PeerPage::mark_pointers(OwnHands& hands) const {
  for (const PointerHand& pointer : pointers_)
    hands.set_pointer(pointer.device, controls_.is_free(pointer.device));
}

OwnHands PeerPage::hands_of(const peer::SceneFile& scene, const peer::PeerView& view) {
  OwnHands hands(scene.hand);
  for (const peer::HandView& hand : view.own_hands()) hands.add(0, hand);
  for (const PointerHand& pointer : pointers_) controls_.add_hand(pointer.device, pointer);
  mark_pointers(hands);
  return hands;
}

}  // namespace reckon::tools
