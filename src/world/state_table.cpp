// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/peer/world/state_table.hpp"

#include <algorithm>
#include <cstddef>

#include "reckon/deadreckon/motion/acceleration_trust.hpp"
#include "reckon/deadreckon/motion/drm.hpp"
#include "reckon/pdu/seconds.hpp"
#include "reckon/peer/world/state_age.hpp"

namespace reckon::peer {
namespace {

using std::chrono::nanoseconds;

// An owner with a threshold cannot be silent for this long while its hand changes its speed. After
// this time the stated change has ended.
constexpr nanoseconds kLongestStroke = std::chrono::milliseconds(600);

constexpr std::ptrdiff_t kLine = 64;  // of a processor's cache [octets]

StateAge age_of(const RemoteEntity& row, nanoseconds now) noexcept {
  const nanoseconds since = now - row.state_time;
  nanoseconds doubted = now - row.doubted_at;
  if (row.strokes) doubted = std::max(doubted, since - kLongestStroke);
  return {since, row.timeout, row.frozen, doubted};
}

deadreckon::Pose pose_of(const RemoteEntity& row, const deadreckon::KinematicState& state,
                         nanoseconds now) noexcept {
  const StateAge age = age_of(row, now);
  // A program without trailers compares with the standard's prediction, so this uses that one.
  deadreckon::Pose pose = row.epoch != 0 ? deadreckon::extrapolate_trusted(state, age.tau)
                                         : deadreckon::extrapolate(state, age.tau);
  age.hold(pose);
  return pose;
}

// A row after a look: a copy for other threads is whole, and their reading does not change it.
const RemoteEntity& seen(const RemoteEntity& row) noexcept {
  static_cast<void>(*row.state);
  return row;
}

// The pose near `predicted` according to the history in `order`, if there is one.
deadreckon::Pose expected_by(const RemoteEntity& row, const deadreckon::AdaptiveOrder* order,
                             const deadreckon::Pose& predicted, nanoseconds now) noexcept {
  if (order == nullptr || row.frozen || order->history().size() == 0) return predicted;
  const StateAge age = age_of(row, now);
  deadreckon::Pose pose = order->predict_near(predicted, age.tau);
  age.hold(pose);
  return pose;
}

}  // namespace

deadreckon::Pose RemoteEntity::predicted(nanoseconds now) const noexcept {
  return pose_of(*this, *state, now);
}

RemoteEntity::Motion RemoteEntity::motion(nanoseconds now) const noexcept {
  const deadreckon::Pose pose = pose_of(*this, state.motion(), now);
  return {pose.position, pose.velocity};
}

deadreckon::Pose RemoteEntity::expected(nanoseconds now) const noexcept {
  return expected(predicted(now), now);
}

deadreckon::Pose RemoteEntity::shown(nanoseconds now) const noexcept {
  return shown(predicted(now), now);
}

deadreckon::Pose RemoteEntity::expected(const deadreckon::Pose& predicted,
                                        nanoseconds now) const noexcept {
  return expected_by(*this, order, predicted, now);
}

deadreckon::Pose RemoteEntity::shown(const deadreckon::Pose& predicted,
                                     nanoseconds now) const noexcept {
  const double at = pdu::to_seconds(now);
  if (order == nullptr) return convergence.shown(predicted, at);
  return convergence.shown(expected(predicted, now), at);
}

RemoteCopy::RemoteCopy(const RemoteEntity& row) noexcept : entity_(seen(row)) {
  entity_.order = nullptr;
  if (row.order != nullptr) order_ = *row.order;
}

deadreckon::Pose RemoteCopy::shown(nanoseconds now) const noexcept {
  const deadreckon::AdaptiveOrder* order = order_ ? &*order_ : nullptr;
  return entity_.convergence.shown(expected_by(entity_, order, entity_.predicted(now), now),
                                   pdu::to_seconds(now));
}

void StateTable::prefetch_row(const RemoteEntity& row) noexcept {
  const auto* octets = reinterpret_cast<const std::byte*>(&row);
  const auto* end = reinterpret_cast<const std::byte*>(&row.model);
  for (; octets < end; octets += kLine) __builtin_prefetch(octets, 1);
}

void StateTable::prefetch_felt(const RemoteEntity& row) noexcept {
  const auto bring = [](const auto& member) {
    const auto* octets = reinterpret_cast<const std::byte*>(&member);
    for (std::size_t at = 0; at < sizeof member; at += kLine) __builtin_prefetch(octets + at);
  };
  bring(row.state);
  bring(row.doubted_at);
  bring(row.timeout);
  bring(row.model);
}

StateTable::StateTable(std::size_t capacity) : rows_(capacity), index_(capacity) {}

RemoteEntity* StateTable::find(const pdu::EntityId& id) noexcept {
  const std::uint32_t row = index_.find(id.key());
  return row == KeyIndex::kNone ? nullptr : &rows_[row];
}

const RemoteEntity* StateTable::find(const pdu::EntityId& id) const noexcept {
  const std::uint32_t row = index_.find(id.key());
  return row == KeyIndex::kNone ? nullptr : &rows_[row];
}

RemoteEntity* StateTable::find_or_add(const pdu::EntityId& id, bool& added) noexcept {
  RemoteEntity* known = find(id);
  added = known == nullptr;
  if (!added || rows_.size() == rows_.capacity()) return known;

  index_.put(id.key(), rows_.size());
  RemoteEntity& row = rows_.push();
  row.id = id;
  return &row;
}

void StateTable::erase(std::size_t place) noexcept {
  const pdu::EntityId last = rows_.all().back().id;
  index_.erase(rows_[place].id.key());
  if (place + 1 < rows_.size()) index_.put(last.key(), place);
  rows_.erase(place);
}

}  // namespace reckon::peer
