// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The entities in the pictures: a small number for each, and its constant properties.
#pragma once

#include <array>
#include <chrono>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "reckon/pdu/codec/records.hpp"
#include "reckon/peer/network/link.hpp"
#include "reckon/tools/listener/listener.hpp"
#include "reckon/tools/viewer/protocol/picture.hpp"

namespace reckon::tools {

/// Assigns slots to entities. A new entity is shown once the roster that names it is published; a
/// freed slot is reused. One thread; allocates for new entities, within its bound.
class Roster {
 public:
  /// @param most limit of entities at a time, below kNoNumber
  explicit Roster(std::size_t most) : most_(most) {}

  /// The slot of an entity of the listener; assigns a new one if it has none, kNoNumber if
  /// there is no room. Keeps the properties from the newest state, and its sender.
  std::uint16_t admit(const Listener& listener, const StateUpdate& update,
                      const peer::IpEndpoint& sender);
  /// Notes the force model of an entity that has a slot, unless a newer state was received.
  void note_model(std::uint64_t key, double radius, std::chrono::nanoseconds arrival);
  /// By ReceivedEntity::key; kNoNumber if the entity has none.
  [[nodiscard]] std::uint16_t slot_of(std::uint64_t key) const noexcept;
  /// The same by ID only, for any exercise.
  [[nodiscard]] std::uint16_t slot_of(const pdu::EntityId& id) const noexcept;
  /// The key of the entity at a slot; 0 for a free slot.
  [[nodiscard]] std::uint64_t key_at(std::uint16_t slot) const noexcept {
    return slot < entries_.size() ? entries_[slot].key : 0;
  }
  /// The ID of the entity at a slot; none for a free slot.
  [[nodiscard]] std::optional<pdu::EntityId> id_at(std::uint16_t slot) const noexcept;
  /// The marking of the entity at a slot; empty for a free slot.
  [[nodiscard]] std::string_view marking_at(std::uint16_t slot) const noexcept;
  /// Whether the entity at a slot has a force model.
  [[nodiscard]] bool is_haptic(std::uint16_t slot) const noexcept {
    return key_at(slot) != 0 && entries_[slot].haptic;
  }
  /// Frees the slots of entities whose last update came before `time`.
  void forget_before(std::chrono::nanoseconds time);

  /// Begins a new epoch if something has changed. @return whether it did
  bool publish();
  [[nodiscard]] std::uint32_t epoch() const noexcept { return epoch_; }
  /// Whether the published roster names the slot.
  [[nodiscard]] bool is_published(std::uint16_t slot) const noexcept {
    return slot < entries_.size() && entries_[slot].published;
  }
  /// The roster message of the epoch.
  [[nodiscard]] const std::string& message() const noexcept { return message_; }
  [[nodiscard]] std::size_t size() const noexcept { return slots_.size(); }
  /// Upper bound of the slots assigned so far.
  [[nodiscard]] std::size_t bound() const noexcept { return entries_.size(); }

 private:
  struct Entry {
    std::uint64_t key = 0;  // 0: free
    pdu::EntityId id;
    std::array<std::byte, 1> side{};  // force ID
    std::array<std::byte, 8> type{};
    std::array<std::byte, 12> marking{};  // including the character set
    peer::IpEndpoint sender;
    bool haptic = false;
    bool published = false;
    double radius = 0;  // [m] of the force model
    std::chrono::nanoseconds received{};
  };
  [[nodiscard]] std::uint16_t place(std::uint64_t key);
  void append_entry(std::string& out, std::size_t slot) const;

  std::size_t most_;
  std::vector<Entry> entries_;
  std::vector<std::uint16_t> free_;
  std::unordered_map<std::uint64_t, std::uint16_t> slots_;
  std::unordered_map<std::uint64_t, std::uint16_t> by_id_;
  bool changed_ = false;
  std::uint32_t epoch_ = 0;
  std::string message_;
};

}  // namespace reckon::tools
