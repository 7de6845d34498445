// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/haptics/contact/near_hands.hpp"

#include <algorithm>

namespace reckon::haptics {

PairAccount& NearHands::pair_of(const pdu::EntityId& id) noexcept {
  PairAccount* oldest = &pairs_[0];
  for (PairAccount& pair : pairs_) {
    if (pair.used && pair.id == id) return pair;
    const bool older = pair.used ? pair.last_step < oldest->last_step : oldest->used;
    if (older) oldest = &pair;
  }
  *oldest = PairAccount{};
  return *oldest;
}

// Sets mostly keep their order, so the search starts at the hand's index in the last set.
RemoteContact* NearHands::slot_of(const pdu::EntityId& id, std::size_t at) noexcept {
  RemoteContact* guess = placed_[at];
  if (guess != nullptr && guess->occupied() && guess->id() == id) return guess;
  for (RemoteContact* remote : all()) {
    if (remote->id() == id) return remote;
  }
  return nullptr;
}

RemoteContact* NearHands::take_slot() noexcept {
  if (count_ >= most_) return nullptr;
  std::size_t slot = 0;
  while (slot < count_ && near_[slot] == &slots_[slot]) ++slot;
  std::copy_backward(near_.begin() + static_cast<std::ptrdiff_t>(slot),
                     near_.begin() + static_cast<std::ptrdiff_t>(count_),
                     near_.begin() + static_cast<std::ptrdiff_t>(count_) + 1);
  ++count_;
  return near_[slot] = &slots_[slot];
}

void NearHands::take(const ContactSet& set, const StepContext& step, std::uint64_t count) noexcept {
  frozen_ = set.frozen;
  left_out_ = set.left_out;
  for (RemoteContact* remote : all()) remote->leave();  // except those in the set
  for (std::size_t i = 0; i < std::min(set.count, kMaxRemoteHands); ++i) {
    if (!place(set.hands[i], i, step, count)) ++left_out_;
  }
}

bool NearHands::place(const RemoteHand& hand, std::size_t at, const StepContext& step,
                      std::uint64_t count) noexcept {
  RemoteContact* slot = slot_of(hand.id, at);
  if (slot != nullptr) {
    slot->come_back(hand, step);
  } else if ((slot = take_slot()) != nullptr) {
    PairAccount& account = pair_of(hand.id);
    resting_ -= account.received - account.given;
    slot->begin(hand, account, step);
    slot->keep_account(count);
  }
  placed_[at] = slot;
  return slot != nullptr;
}

void NearHands::advance(const StepContext& step, std::uint64_t count,
                        EnergyLedger& ledger) noexcept {
  for (RemoteContact* remote : all()) {
    remote->keep_account(count);
    remote->claim(ledger);
    remote->predict(step, frozen_);
  }
  drop_faded();
  for (RemoteContact* remote : all()) remote->advance(step);
}

void NearHands::drop_faded() noexcept {
  std::size_t kept = 0;
  for (RemoteContact* remote : all()) {
    if (remote->faded() && !remote->touching()) {
      resting_ += remote->pair().received - remote->pair().given;
      remote->clear();
    } else {
      near_[kept++] = remote;
    }
  }
  count_ = kept;
}

double NearHands::transferred() const noexcept {
  double sum = resting_;
  for (const RemoteContact* remote : all()) {
    sum += remote->pair().received - remote->pair().given;
  }
  return sum;
}

}  // namespace reckon::haptics
