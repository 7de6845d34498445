// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/tools/viewer/history/roster.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstring>
#include <string_view>
#include <utility>

#include "reckon/peer/notation/entity_type_text.hpp"
#include "reckon/tools/datagrams/survey.hpp"
#include "reckon/tools/terminal/json_text.hpp"

namespace reckon::tools {
namespace {

// Offsets in the fixed octets of an Entity State.
constexpr std::size_t kSideAt = 18, kTypeAt = 20, kMarkingAt = 128;

/// Copies a field. @return whether it changed
template <std::size_t Size>
bool renew(std::array<std::byte, Size>& field, const FixedOctets& octets, std::size_t at) {
  if (std::memcmp(field.data(), octets.data() + at, Size) == 0) return false;
  std::memcpy(field.data(), octets.data() + at, Size);
  return true;
}

std::string lower_case(std::string_view text) {
  std::string out(text);
  std::transform(out.begin(), out.end(), out.begin(), [](char letter) {
    return letter >= 'A' && letter <= 'Z' ? static_cast<char>(letter - 'A' + 'a') : letter;
  });
  return out;
}

/// "platform land".
std::string kind_text(std::span<const std::byte> type) {
  const auto kind = static_cast<pdu::EntityKind>(type[0]);
  const std::string_view named = pdu::name(kind);
  if (named.empty()) return fmt::format("kind {}", std::to_integer<unsigned>(type[0]));
  if (kind != pdu::EntityKind::platform) return lower_case(named);
  return lower_case(
      fmt::format("{} {}", named, pdu::name(static_cast<pdu::EntityDomain>(type[1]))));
}

pdu::EntityType type_of(std::span<const std::byte> octets) {
  const auto part = [octets](std::size_t i) { return std::to_integer<std::uint8_t>(octets[i]); };
  pdu::EntityType type;
  type.kind = static_cast<pdu::EntityKind>(part(0));
  type.domain = static_cast<pdu::EntityDomain>(part(1));
  type.country = static_cast<std::uint16_t>(part(2) << 8 | part(3));
  type.category = part(4);
  type.subcategory = part(5);
  type.specific = part(6);
  type.extra = part(7);
  return type;
}

std::string side_text(std::byte side) {
  const std::string_view named = pdu::name(static_cast<pdu::ForceId>(side));
  return named.empty() ? fmt::format("side {}", std::to_integer<unsigned>(side))
                       : lower_case(named);
}

/// Its letters up to the first NUL, after the octet of the character set.
std::string_view letters(std::span<const std::byte> marking) {
  const std::string_view all(reinterpret_cast<const char*>(marking.data()) + 1, marking.size() - 1);
  return all.substr(0, all.find('\0'));
}

}  // namespace

std::uint16_t Roster::slot_of(std::uint64_t key) const noexcept {
  const auto found = slots_.find(key);
  return found == slots_.end() ? kNoNumber : found->second;
}

std::uint16_t Roster::slot_of(const pdu::EntityId& id) const noexcept {
  const auto found = by_id_.find(entity_key(0, id));
  return found == by_id_.end() ? kNoNumber : found->second;
}

std::optional<pdu::EntityId> Roster::id_at(std::uint16_t slot) const noexcept {
  if (key_at(slot) == 0) return std::nullopt;
  return entries_[slot].id;
}

std::string_view Roster::marking_at(std::uint16_t slot) const noexcept {
  return key_at(slot) == 0 ? std::string_view() : letters(entries_[slot].marking);
}

std::uint16_t Roster::place(std::uint64_t key) {
  const auto known = slots_.find(key);
  if (known != slots_.end()) return known->second;
  if (slots_.size() >= most_) return kNoNumber;
  std::uint16_t slot = static_cast<std::uint16_t>(entries_.size());
  if (free_.empty()) {
    entries_.emplace_back();
  } else {
    slot = free_.back();
    free_.pop_back();
    entries_[slot] = {};
  }
  entries_[slot].key = key;
  slots_.emplace(key, slot);
  changed_ = true;
  return slot;
}

std::uint16_t Roster::admit(const Listener& listener, const StateUpdate& update,
                            const peer::IpEndpoint& sender) {
  const ReceivedEntity& entity = listener.entities()[update.place];
  const std::uint16_t slot = place(entity.key);
  if (slot == kNoNumber) return slot;
  Entry& entry = entries_[slot];
  // A replay of the past brings nothing new.
  if (update.arrival < entry.received) return slot;
  entry.received = update.arrival;
  entry.id = entity.id;
  by_id_[entity_key(0, entity.id)] = slot;
  changed_ |= renew(entry.side, update.octets, kSideAt);
  changed_ |= renew(entry.type, update.octets, kTypeAt);
  changed_ |= renew(entry.marking, update.octets, kMarkingAt);
  changed_ |= std::exchange(entry.sender, sender) != sender;
  return slot;
}

void Roster::note_model(std::uint64_t key, double radius, std::chrono::nanoseconds arrival) {
  const std::uint16_t slot = slot_of(key);
  if (slot == kNoNumber) return;
  Entry& entry = entries_[slot];
  if (arrival < entry.received || (entry.haptic && entry.radius == radius)) return;
  entry.haptic = true;
  entry.radius = radius;
  changed_ = true;
}

void Roster::forget_before(std::chrono::nanoseconds time) {
  for (std::size_t slot = 0; slot < entries_.size(); ++slot) {
    Entry& entry = entries_[slot];
    if (entry.key == 0 || entry.received >= time) continue;
    slots_.erase(entry.key);
    const auto named = by_id_.find(entity_key(0, entry.id));
    if (named != by_id_.end() && named->second == slot) by_id_.erase(named);
    free_.push_back(static_cast<std::uint16_t>(slot));
    entry = {};
    changed_ = true;
  }
}

void Roster::append_entry(std::string& out, std::size_t slot) const {
  const Entry& entry = entries_[slot];
  const pdu::EntityId& id = entry.id;
  const pdu::EntityType type = type_of(entry.type);
  JsonObject(out)
      .value("slot", slot)
      .text("id", fmt::format("{}:{}:{}", id.site, id.application, id.entity))
      .text("marking", letters(entry.marking))
      .text("kind", kind_text(entry.type))
      .text("type", peer::entity_type_words(type))
      .text("type_numbers", peer::entity_type_numbers(type))
      .text("side", side_text(entry.side[0]))
      .value("haptic", entry.haptic)
      .decimals("radius", entry.radius, 4)
      .text("peer", id.simulation() == aoim::kSceneId
                        ? std::string()
                        : fmt::format("{}:{}", id.site, id.application))
      .text("host", entry.sender.is_unspecified() ? std::string() : entry.sender.text())
      .end();
}

bool Roster::publish() {
  if (!std::exchange(changed_, false)) return false;
  ++epoch_;
  std::vector<std::size_t> named;
  for (std::size_t slot = 0; slot < entries_.size(); ++slot) {
    entries_[slot].published = entries_[slot].key != 0;
    if (entries_[slot].published) named.push_back(slot);
  }
  message_.clear();
  JsonObject(message_)
      .text("type", "roster")
      .value("epoch", epoch_)
      .array("entities", named,
             [this](std::string& out, std::size_t slot) { append_entry(out, slot); })
      .end();
  return true;
}

}  // namespace reckon::tools
