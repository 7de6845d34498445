// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The incoming half of a peer for tests of articulated parts.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include "reckon/pdu/seconds.hpp"
#include "reckon/pdu/timestamp.hpp"
#include "reckon/peer/loops/aoim_setup.hpp"
#include "reckon/peer/world/remote_entities.hpp"

namespace reckon::peer::test {

inline constexpr std::uint32_t kTurret = 128, kGun = 138;  // SISO UID 59
inline constexpr std::chrono::nanoseconds kUtc = std::chrono::hours(500'000);
inline constexpr double kPi = std::numbers::pi;

struct Record {
  std::uint32_t part;
  unsigned metric;  // SISO UID 58
  float value;
  std::uint16_t attached_to = 0;
};

inline std::vector<std::byte> octets_of(const std::vector<Record>& records) {
  std::vector<std::byte> octets(records.size() * pdu::kVariableParameterSize);
  std::span<std::byte> rest(octets);
  for (const Record& record : records) {
    pdu::ArticulatedPart wire;
    wire.part_attached_to = record.attached_to;
    wire.parameter_type = record.part * 32 + record.metric;
    wire.parameter_value = record.value;
    rest = rest.subspan(pdu::store_record(wire, rest));
  }
  return octets;
}

inline std::vector<std::byte> turret(double azimuth, double rate) {
  const double wrapped = std::remainder(azimuth, 2 * kPi);
  return octets_of(
      {{kTurret, 11, static_cast<float>(wrapped)}, {kTurret, 12, static_cast<float>(rate)}});
}

// The angle of the shorter way round [rad].
inline double off(double a, double b) { return std::abs(std::remainder(a - b, 2 * kPi)); }

// The incoming half of a peer in a world of 100 km, fed with octets of datagrams; the test sets the
// time.
class PartsReceiver {
 public:
  explicit PartsReceiver(const deadreckon::LocalFrame& frame = {0.8, 0.1, 400},
                         bool bodies_in_part = false)
      : scene_(parse_scene_file("[aoim]\nradius = \"100 km\"\ncell = \"10 km\"\n", "x")),
        frame_(frame),
        pool_(scene_.network.group, scene_.aoim.pool),
        aoim_(aoim_config(scene_), presence(scene_, frame_, pool_, {{1, 1}, "me", 5, 0, false})),
        decoder_(1, counters_),
        remote_(frame_, aoim_, settings(scene_, bodies_in_part), counters_) {
    const std::array<aoim::Focus, 1> here{{{{0, 0, 0}, 0.0, scene_.aoim.radius}}};
    static_cast<void>(aoim_.listen(aoim::kCellTier, here, std::chrono::nanoseconds(0)));
    state_.header.exercise_id = 1;
    state_.entity_type = {pdu::EntityKind::platform, pdu::EntityDomain::air};
    state_.dead_reckoning.algorithm = pdu::DeadReckoningAlgorithm::fpw;
    state_.linear_velocity = {10, 0, 0};  // so the time-out is 12 s
    octets_.reserve(8192);
  }

  // The next updates, besides their parts.
  [[nodiscard]] pdu::EntityState& state() { return state_; }

  // Takes an update of the instant `sent` that arrives at `now` [s]; its octets are freed
  // afterwards.
  void hear(std::span<const std::byte> records, double sent, double now, std::uint16_t entity = 9) {
    const Eigen::Vector3d place = frame_.origin() + Eigen::Vector3d(10 * sent + shift, 0, 0);
    state_.location = {place.x(), place.y(), place.z()};
    state_.entity_id = {7, 8, entity};
    state_.variable_parameters = records;
    state_.header.timestamp = pdu::to_dis_timestamp(kUtc + pdu::from_seconds(sent), true);
    octets_.resize(pdu::wire_size(state_));
    ASSERT_EQ(pdu::encode(state_, octets_), octets_.size());
    hear_octets(octets_, now);
    std::fill(octets_.begin(), octets_.end(), std::byte{0xFF});
  }
  void hear_octets(std::span<const std::byte> datagram, double now) {
    const std::chrono::nanoseconds at = pdu::from_seconds(now);
    for (const Inbound& update : decoder_.decode(datagram, {1, 1}))
      remote_.take(update, {at, kUtc + at, at, 0, {}}, {});
  }

  [[nodiscard]] ShownParts parts(double now, const pdu::EntityId& id = {7, 8, 9}) const {
    return remote_.parts(id, pdu::from_seconds(now));
  }
  // The part with this number; NaN if it is absent.
  [[nodiscard]] ShownPart part(std::uint32_t part, double now) const {
    const ShownParts all = parts(now);
    for (std::size_t i = 0; i < all.size(); ++i)
      if (all[i].part == part) return all[i];
    ShownPart none;
    none.value = none.rate = std::numeric_limits<double>::quiet_NaN();
    return none;
  }
  [[nodiscard]] RemoteEntities& remote() { return remote_; }
  [[nodiscard]] const RemoteEntity* row(std::uint16_t entity = 9) {
    return remote_.find({7, 8, entity});
  }
  [[nodiscard]] std::uint64_t count(std::string_view name) const {
    return counters_.find(name)->value();
  }

  double shift = 0;  // [m] added to the position of the next updates

 private:
  static RemoteSettings settings(const SceneFile& scene, bool bodies_in_part) {
    RemoteSettings settings{0.01, scene.convergence, {}};
    settings.bodies_in_part = bodies_in_part;
    return settings;
  }
  SceneFile scene_;
  deadreckon::LocalFrame frame_;
  GroupPool pool_;
  Counters counters_;
  aoim::AreaOfInterestManager aoim_;
  DatagramDecoder decoder_;
  RemoteEntities remote_;
  pdu::EntityState state_;
  std::vector<std::byte> octets_;
};

}  // namespace reckon::peer::test
