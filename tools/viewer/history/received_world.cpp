// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/tools/viewer/history/received_world.hpp"

#include <algorithm>
#include <cmath>

#include "reckon/deadreckon/motion/drm.hpp"
#include "reckon/pdu/seconds.hpp"

namespace reckon::tools {
namespace {

using std::chrono::nanoseconds;

/// Low 16 bits of the address.
std::uint16_t group_number(const peer::IpEndpoint& group) {
  const std::size_t end = group.is_v6 ? 16 : 4;
  return static_cast<std::uint16_t>(group.octets[end - 2] << 8 | group.octets[end - 1]);
}

std::uint8_t side_of(const ReceivedEntity& entity) {
  constexpr std::size_t kSideAt = 18;
  return std::to_integer<std::uint8_t>(entity.octets[kSideAt]);
}

}  // namespace

/// Called by the table for an update before it takes it.
struct ReceivedWorld::Watching final : EntityTable::Watch {
  Watching(ReceivedWorld& the_world, const peer::SourceDatagram& the_datagram, Roster& the_roster,
           nanoseconds the_start)
      : world(the_world), datagram(the_datagram), roster(the_roster), start(the_start) {}
  void before_state(const StateUpdate& update) override {
    world.note_update(update, datagram, roster, start);
  }
  void before_model(const ReceivedEntity& entity, const ModelUpdate& update) override {
    roster.note_model(entity.key, update.model.radius, update.arrival);
  }
  ReceivedWorld& world;
  const peer::SourceDatagram& datagram;
  Roster& roster;
  nanoseconds start;
};

void ReceivedWorld::take_pdu(const PduRow& row, const peer::SourceDatagram& datagram,
                             Roster& roster, nanoseconds start) {
  if (row.decoded && row.header.pdu_type == pdu::PduType::cell_roles)
    return groups_.take_roles(row.bytes, datagram.time);
  Watching watching(*this, datagram, roster, start);
  table_.take_pdu(row, datagram, &watching);
}

void ReceivedWorld::note_update(const StateUpdate& update, const peer::SourceDatagram& datagram,
                                Roster& roster, nanoseconds start) {
  const std::uint16_t slot = roster.admit(table_.listener(), update, datagram.source);
  if (slot == kNoNumber) return;
  groups_.note_update(slot, datagram.group, update.arrival);
  if (slot >= errors_.size()) errors_.resize(slot + std::size_t{1});
  if (update.is_first) {
    errors_[slot] = {};
    return;
  }
  const deadreckon::Pose old = table_.entities()[update.place].pose_at(update.arrival);
  const deadreckon::Pose now =
      deadreckon::extrapolate(update.state, pdu::to_seconds(update.arrival - update.state_time));
  const double time = pdu::to_seconds(update.arrival - start);
  errors_[slot].restart(settings_, errors_[slot].shown(old, time), now, time);
  const double jump = (now.position - old.position).norm();
  if (!std::isfinite(jump)) return;
  ++jumps_.count;
  jumps_.sum += jump;
  jumps_.worst = std::max(jumps_.worst, jump);
}

std::optional<Eigen::Vector3d> ReceivedWorld::first_place() const {
  for (const ReceivedEntity& entity : table_.entities())
    if (entity.has_state) return entity.state.position;
  return std::nullopt;
}

std::size_t ReceivedWorld::weight() const noexcept {
  constexpr std::size_t kModel = 400;
  return table_.entities().size() * (sizeof(ReceivedEntity) + sizeof(EntityRow)) +
         table_.listener().models().size() * (sizeof(ReceivedModel) + kModel) +
         errors_.size() * sizeof(deadreckon::ConvergingError) + groups_.weight();
}

void ReceivedWorld::add_marks(nanoseconds time, nanoseconds start, const Roster& roster,
                              const deadreckon::LocalFrame& frame,
                              std::vector<EntityMark>& out) const {
  const double seconds = pdu::to_seconds(time - start);
  const auto entities = table_.entities();
  for (std::size_t i = 0; i < entities.size() && out.size() < kMostPictureRows; ++i) {
    const ReceivedEntity& entity = entities[i];
    if (!entity.has_state || entity.gone || entity.is_silent(time)) continue;
    const std::uint16_t slot = roster.slot_of(entity.key);
    if (!roster.is_published(slot)) continue;
    const EntityRow& row = table_.rows()[i];
    const deadreckon::Pose pose = entity.pose_at(time);
    EntityMark& mark = out.emplace_back();
    mark.slot = slot;
    mark.side = side_of(entity);
    mark.cause = row.cause;
    mark.group = group_number(row.group);
    mark.position = frame.scene_from_world(pose.position);
    mark.orientation = frame.scene_from_world(pose.orientation);
    if (slot < errors_.size() && errors_[slot].converging(seconds)) {
      const deadreckon::Pose shown = errors_[slot].shown(pose, seconds);
      mark.error = frame.scene_from_world_vector(shown.position - pose.position).cast<float>();
    }
    mark.rate = row.rate(entity, time);
    mark.jump = row.jump;
    mark.velocity = frame.scene_from_world_vector(pose.velocity).cast<float>();
    mark.updated = pdu::to_seconds(entity.arrival - start);
  }
}

}  // namespace reckon::tools
