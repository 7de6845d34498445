// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/peer/world/contact_beginnings.hpp"

#include <algorithm>

namespace reckon::peer {

bool ContactBeginnings::may_press(std::size_t place, const RemoteEntity& row, std::size_t hand,
                                  double depth, const RowOwners& owners, Nanoseconds now) noexcept {
  const auto bit = static_cast<std::uint8_t>(1U << hand);
  if (!(depth > 0.0)) {
    outside_[place] = static_cast<std::uint8_t>(outside_[place] | bit);
    return true;
  }
  Hand& peers = pressed_[hand];
  const aoim::PeerId peer = row.id.simulation();
  const aoim::SourceAddress& from = owners.owner(place);
  if ((outside_[place] & bit) == 0) {
    const Pressed* before = find(peers, peer, from);
    if (before == nullptr || now - before->at > kRemembered) {
      ++held_back_;
      last_held_back_ = row.id;
      return false;
    }
    outside_[place] = static_cast<std::uint8_t>(outside_[place] | bit);
  }
  note_pressed(peers, peer, from, now);
  return true;
}

ContactBeginnings::Pressed* ContactBeginnings::find(Hand& hand, const aoim::PeerId& peer,
                                                    const aoim::SourceAddress& from) noexcept {
  const auto found = std::ranges::find_if(hand, [&](const Pressed& one) {
    const bool sealed = one.from.boot != 0 && from.boot != 0;
    return one.peer == peer && (sealed || one.from.octets == from.octets);
  });
  return found == hand.end() ? nullptr : &*found;
}

void ContactBeginnings::note_pressed(Hand& hand, const aoim::PeerId& peer,
                                     const aoim::SourceAddress& from, Nanoseconds now) noexcept {
  Pressed* one = find(hand, peer, from);
  if (one == nullptr) one = &*std::ranges::min_element(hand, {}, &Pressed::at);
  *one = {peer, from, now};
}

}  // namespace reckon::peer
