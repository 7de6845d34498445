// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/peer/world/remote_parts.hpp"

#include <numeric>

#include "reckon/pdu/seconds.hpp"

namespace reckon::peer {
namespace {

using deadreckon::PartConvergence;
using deadreckon::PartMotion;
using deadreckon::PartParameter;
using deadreckon::PartReading;
using deadreckon::PartState;

// Parts of a frozen entity keep their received values.
PartState standing(const PartState& state) {
  PartState still;
  for (PartParameter part : state.parameters()) {
    part.rate = 0;
    static_cast<void>(still.set(part));
  }
  return still;
}

std::size_t left_out(const PartReading& reading) {
  return reading.not_finite + reading.unknown + reading.no_value + reading.no_room;
}

}  // namespace

ShownPart ShownParts::operator[](std::size_t i) const noexcept {
  const PartParameter& received = parts_->state().parameters()[i];
  const PartMotion motion = parts_->shown(i, now_);
  return {received.part, received.attached_to, received.metric, motion.value, motion.rate};
}

RemoteParts::RemoteParts(const deadreckon::ConvergenceSettings& settings, Counters& counters)
    : settings_(settings),
      places_(kEntities),
      free_(kEntities),
      refused_(counters.make("parts_refused", "invalid records of articulated parts")),
      full_(counters.make("parts_full", "updates whose articulated parts exceed the limit")) {
  std::iota(free_.rbegin(), free_.rend(), std::uint16_t{0});
}

void RemoteParts::update(RemoteEntity& row, std::span<const std::byte> records,
                         std::chrono::nanoseconds now, bool abrupt) noexcept {
  if (records.empty()) return release(row);
  PartState state;
  if (const std::size_t bad = left_out(deadreckon::from_wire(records, state))) refused_.add(bad);
  if (state.parameters().empty()) return release(row);

  const bool at_once = abrupt || row.parts_place == RemoteEntity::kNoParts;
  PartConvergence* parts = claim(row);
  if (parts == nullptr) return full_.add();
  if (at_once) *parts = PartConvergence(settings_);
  parts->update(row.frozen ? standing(state) : state, pdu::to_seconds(row.state_time),
                pdu::to_seconds(now), row.timeout);
  row.parts = static_cast<std::uint8_t>(state.parameters().size());
}

// The place of a row, or a free one for it; null if there is none.
PartConvergence* RemoteParts::claim(RemoteEntity& row) noexcept {
  if (row.parts_place == RemoteEntity::kNoParts) {
    if (free_.empty()) return nullptr;
    row.parts_place = free_.back();
    free_.pop_back();
  }
  return &places_[row.parts_place];
}

void RemoteParts::release(RemoteEntity& row) noexcept {
  if (row.parts_place == RemoteEntity::kNoParts) return;
  free_.push_back(row.parts_place);  // within the capacity of construction
  row.parts_place = RemoteEntity::kNoParts;
  row.parts = 0;
}

ShownParts RemoteParts::shown(const RemoteEntity& row,
                              std::chrono::nanoseconds now) const noexcept {
  if (row.parts_place == RemoteEntity::kNoParts) return {};
  return {places_[row.parts_place], pdu::to_seconds(now)};
}

}  // namespace reckon::peer
