// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Slots of the remote hands at one device, and the accounts of hands that left.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "reckon/haptics/contact/remote_contact.hpp"
#include "reckon/haptics/exchange/servo_types.hpp"

namespace reckon::haptics {

/// Up to kMaxRemoteHands contacts, in an order independent of their arrival. A hand that leaves
/// keeps its account, and is not credited twice when it returns. Servo thread; bounded; no
/// allocation.
class NearHands {
 public:
  /// @param most hands accepted, <= kMaxRemoteHands
  explicit NearHands(std::size_t most) noexcept : most_(most) {}
  NearHands(const NearHands&) = delete;
  NearHands& operator=(const NearHands&) = delete;

  /// Takes a new set. @param count steps of the servo so far
  void take(const ContactSet& set, const StepContext& step, std::uint64_t count) noexcept;
  /// One step: credits, predicts, and drops hands that have faded out.
  void advance(const StepContext& step, std::uint64_t count, EnergyLedger& ledger) noexcept;

  /// For hands in contact or nearly so: is_cut(place, apart) returns whether a solid is between our
  /// hand and that position [m]; see is_between_hands().
  void set_apart(auto&& is_cut) noexcept {
    for (RemoteContact* remote : all()) {
      if (!remote->is_hand()) continue;
      const bool near = remote->depth() > -kNear;
      remote->set_apart(near && is_cut(remote->predicted_place(), remote->is_apart()));
    }
  }

  /// Contacts in use.
  [[nodiscard]] std::span<RemoteContact* const> all() const noexcept {
    return {near_.data(), count_};
  }
  [[nodiscard]] bool empty() const noexcept { return count_ == 0; }
  /// Number of near hands without a slot, because there are too many.
  [[nodiscard]] std::size_t left_out() const noexcept { return left_out_; }
  /// Energy received from all hands since the start, minus the energy given to them [J].
  [[nodiscard]] double transferred() const noexcept;
  /// Whether the simulation is frozen, as of the last take().
  [[nodiscard]] bool frozen() const noexcept { return frozen_; }

 private:
  static constexpr double kNear = 0.02;  // [m], in front of another hand

  [[nodiscard]] bool place(const RemoteHand& hand, std::size_t at, const StepContext& step,
                           std::uint64_t count) noexcept;
  void drop_faded() noexcept;
  [[nodiscard]] PairAccount& pair_of(const pdu::EntityId& id) noexcept;
  [[nodiscard]] RemoteContact* slot_of(const pdu::EntityId& id, std::size_t at) noexcept;
  [[nodiscard]] RemoteContact* take_slot() noexcept;

  std::size_t most_;
  std::array<RemoteContact, kMaxRemoteHands> slots_{};
  std::array<RemoteContact*, kMaxRemoteHands> near_{};    // slots in use, in the order of slots_
  std::array<RemoteContact*, kMaxRemoteHands> placed_{};  // slots by place in the last set
  std::size_t count_ = 0;
  std::size_t left_out_ = 0;
  bool frozen_ = false;
  std::array<PairAccount, 8 * kMaxRemoteHands> pairs_{};
  double resting_ = 0.0;  // [J], received - given of all accounts without a contact now
};

}  // namespace reckon::haptics
