// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/peer/world/portless_bodies.hpp"

#include <algorithm>

#include "reckon/pdu/seconds.hpp"

namespace reckon::peer {

using std::chrono::nanoseconds;

namespace {

// A resting body is repeated to our own hands, whose record of it would expire.
constexpr std::chrono::seconds kRefresh{1};

}  // namespace

void PortlessBody::note_motion(const OwnedEntity& entity, nanoseconds now) noexcept {
  const EntityTruth& truth = entity.truth();
  const bool other = truth.time != last_.time;
  const bool elsewhere =
      truth.position != last_.position || truth.orientation.coeffs() != last_.orientation.coeffs();
  moves_ =
      !entity.is_frozen() && last_.time > nanoseconds(0) && (elsewhere || !entity.is_resting());
  if (other || now - refreshed_ >= kRefresh) {
    ++version_;
    refreshed_ = now;
  }
  if (answered_ > nanoseconds(0)) budget_.advance(pdu::to_seconds(now - answered_), moves_);
  answered_ = now;
  last_ = truth;
}

double PortlessBody::answer(const OwnedEntity& entity, EnergyBooks& books, nanoseconds now) {
  note_motion(entity, now);
  account_count_ = 0;
  double given = 0.0;
  for (ReceivedAccount& pair : books.pairs()) {
    if (pair.own != number_) continue;
    if (pair.unanswered && pair.need > 0.0) {
      const double share = budget_.take(pair.need);
      pair.we_gave += share;
      given += share;
      if (share > 0.0) ++version_;
    }
    if (pair.other.simulation() != entity.id().simulation())
      pressed_at_ = std::max(pressed_at_, pair.heard);
    pair.unanswered = false;
    if (account_count_ < accounts_.size()) accounts_[account_count_++] = {pair.other, pair.we_gave};
  }
  return given;
}

void note_own_needs(std::span<const HandPort> hands, const OwnedEntities& owned, EnergyBooks& books,
                    nanoseconds now) noexcept {
  const pdu::EntityId own = owned.simulation();
  for (const HandPort& port : hands) {
    const haptics::ServoSnapshot& servo = port.servo();
    for (std::size_t i = 0; i < servo.count; ++i) {
      const haptics::ContactAccount& contact = servo.contacts[i];
      if (contact.id.simulation() != own.simulation()) continue;
      const OwnedEntity* hand = owned.find(port.hand());
      if (hand == nullptr) continue;
      ReceivedAccount& pair = books.pair(contact.id.entity, hand->id(), now);
      pair.given = contact.given;
      pair.need = contact.need;
      pair.unanswered = true;
    }
  }
}

}  // namespace reckon::peer
