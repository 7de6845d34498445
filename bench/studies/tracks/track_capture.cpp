// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <array>
#include <cmath>
#include <map>
#include <optional>
#include <vector>

#include "reckon/bench/studies/tracks/track_builder.hpp"
#include "reckon/bench/studies/tracks/track_file.hpp"
#include "reckon/deadreckon/motion/geocentric.hpp"
#include "reckon/deadreckon/wire_conversion.hpp"
#include "reckon/pdu/seconds.hpp"
#include "reckon/pdu/timestamp.hpp"
#include "reckon/tools/command_line/console.hpp"
#include "reckon/tools/datagrams/bounded_time.hpp"
#include "reckon/tools/datagrams/pdu_row.hpp"
#include "reckon/tools/datagrams/selection.hpp"
#include "reckon/tools/terminal/text_table.hpp"

namespace reckon::bench {
namespace {

using deadreckon::KinematicState;
using deadreckon::LocalFrame;
using Eigen::Vector3d;
using std::chrono::nanoseconds;

struct ReceivedUpdate {
  double captured = 0;  // [s] since the first Entity State
  double stamped = 0;   // [s] since the first of the entity, by its own clock
  KinematicState state;
};

struct ReceivedEntity {
  std::string name;
  std::uint32_t timestamp = 0;
  std::vector<ReceivedUpdate> updates;
};

/// The tangent plane of the sphere below `point`, with its origin there.
LocalFrame frame_at(const Vector3d& point) {
  const double latitude = std::atan2(point.z(), std::hypot(point.x(), point.y()));
  const double longitude = std::atan2(point.y(), point.x());
  return {latitude, longitude, 0};
}

/// Whether the sender's timestamps are reliable: at least nine of ten increase from one update to
/// the next, and their span equals the capture's within 5 % plus half a second.
bool stamps_run(const std::vector<ReceivedUpdate>& updates) {
  std::size_t grew = 0;
  for (std::size_t i = 1; i < updates.size(); ++i)
    grew += updates[i].stamped > updates[i - 1].stamped;
  const double captured = updates.back().captured - updates.front().captured;
  const double stamped = updates.back().stamped - updates.front().stamped;
  return 10 * grew >= 9 * (updates.size() - 1) &&
         std::abs(stamped - captured) <= 0.5 + 0.05 * captured;
}

/// Collects the Entity States of a capture by entity.
class StateCollector {
 public:
  void read(peer::DatagramSource& source) {
    tools::DatagramInspector inspector;
    peer::SourceDatagram datagram;
    while (source.next(datagram, {}) == peer::SourceEvent::datagram)
      (void)inspector.inspect(datagram, [&](const tools::PduRow& row) {
        take(row);
        return true;
      });
  }

  void take(const tools::PduRow& row) {
    if (row.entity_state == nullptr || !row.decoded) return;
    const pdu::EntityState& pdu = *row.entity_state;
    if ((pdu.appearance & pdu::kAppearanceDeactivated) != 0) return;
    if (!frame_) begin(pdu, tools::bounded_time(row.time));
    KinematicState state;
    if (from_wire(pdu, *frame_, state) != deadreckon::ConversionError::none) {
      ++refused_;
      return;
    }
    if (++updates_ > TrackBuilder::kMostSamples)
      throw tools::UsageError(fmt::format(
          "more than {} Entity States; cut a part with `reckon cut`", TrackBuilder::kMostSamples));
    state.position -= origin_;
    add(pdu, state, pdu::to_seconds(tools::bounded_time(row.time) - start_));
  }

  void build(TrackBuilder& builder) const {
    for (const auto& [key, entity] : entities_) {
      const bool by_stamps = stamps_run(entity.updates);
      const double start = entity.updates.front().captured;
      for (const ReceivedUpdate& received : entity.updates) {
        const double time = by_stamps ? start + received.stamped : received.captured;
        builder.add(entity.name, {motion_sample(received.state, time), true, true, true});
      }
    }
  }

  [[nodiscard]] std::string note() const {
    std::size_t captured = 0;
    for (const auto& [key, entity] : entities_) captured += !stamps_run(entity.updates);
    std::string note =
        "Recorded traffic contains only sent updates, not the motion between them. Savings are "
        "against sending the recorded updates again.";
    if (captured > 0)
      note += fmt::format(
          " The timestamps of {} of {} do not advance with the capture: its arrival times are "
          "used.",
          captured,
          entities_.size() == 1 ? "1 entity" : fmt::format("{} entities", entities_.size()));
    if (refused_ > 0)
      note += fmt::format(" {} left out: not finite or out of range.",
                          tools::counted(refused_, "Entity State"));
    return note;
  }

 private:
  using Key = std::array<std::uint16_t, 3>;

  void begin(const pdu::EntityState& pdu, nanoseconds time) {
    start_ = time;
    const Vector3d point(pdu.location.x, pdu.location.y, pdu.location.z);
    frame_ = point.allFinite() ? frame_at(point) : LocalFrame(0, 0, 0);
    if (point.allFinite()) origin_ = frame_->scene_from_world(point);
  }

  void add(const pdu::EntityState& pdu, const KinematicState& state, double captured) {
    const pdu::EntityId& id = pdu.entity_id;
    ReceivedEntity& entity = entities_[Key{id.site, id.application, id.entity}];
    const std::uint32_t stamp = pdu.header.timestamp;
    if (entity.updates.empty())
      entity.name = fmt::format("{}:{}:{}", id.site, id.application, id.entity);
    const double stamped = entity.updates.empty()
                               ? 0
                               : entity.updates.back().stamped +
                                     pdu::to_seconds(pdu::difference(stamp, entity.timestamp));
    entity.timestamp = stamp;
    entity.updates.push_back({captured, stamped, state});
  }

  std::optional<LocalFrame> frame_;
  Vector3d origin_ = Vector3d::Zero();
  nanoseconds start_{};
  std::map<Key, ReceivedEntity> entities_;
  std::size_t updates_ = 0;
  std::uint64_t refused_ = 0;
};

}  // namespace

TrackFile read_track_capture(const std::filesystem::path& path) {
  const auto source = tools::open_recording(path.string());
  StateCollector collector;
  collector.read(*source);
  TrackBuilder builder;
  collector.build(builder);
  TrackFile file;
  file.name = path.filename().string();
  file.tracks = builder.finish();
  if (file.tracks.empty())
    throw tools::UsageError(
        fmt::format("{}: no Entity State, so nothing moves; `reckon info {}` shows its contents",
                    path.string(), path.string()));
  file.note = collector.note();
  file.has_orientation = true;
  file.is_capture = true;
  const std::string damage = tools::damage_text(source->report());
  file.damaged = !damage.empty();
  if (file.damaged) file.note += fmt::format(" The capture is damaged: {}.", damage);
  return file;
}

}  // namespace reckon::bench
