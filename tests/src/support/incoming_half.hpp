// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The incoming half of a peer without a network: a scene, its groups and cells, and the remote
// entities. A test sets their updates and times.
#pragma once

#include <gtest/gtest.h>

#include <array>
#include <chrono>
#include <cstdint>
#include <functional>
#include <string>
#include <string_view>

#include "reckon/deadreckon/wire_conversion.hpp"
#include "reckon/pdu/timestamp.hpp"
#include "reckon/peer/loops/aoim_setup.hpp"
#include "reckon/peer/world/remote_entities.hpp"

namespace reckon::test {

struct IncomingHalf {
  using nanoseconds = std::chrono::nanoseconds;
  using Settings = std::function<peer::RemoteSettings(const peer::SceneFile&)>;
  static constexpr nanoseconds kUtc = std::chrono::hours(500'000);  ///< at time 0

  /// Peer 1:1 in the world of a scene file, at its origin. @param settings made of the scene
  IncomingHalf(const std::string& text, const Settings& settings)
      : scene(peer::parse_scene_file(text, "x")),
        pool(scene.network.group, scene.aoim.pool),
        aoim(peer::aoim_config(scene),
             peer::presence(scene, frame, pool, {{1, 1}, "me", 5, 0, false})),
        remote(frame, aoim, settings(scene), counters) {
    stand_at({0, 0, 0}, nanoseconds(0));
  }

  /// Moves the focus of the scene's radius there [m, m/s].
  void stand_at(const Eigen::Vector3d& place, nanoseconds now, double speed = 0) {
    const std::array<aoim::Focus, 1> here{
        {{{place.x(), place.y(), place.z()}, speed, scene.aoim.radius}}};
    static_cast<void>(aoim.listen(aoim::kCellTier, here, now));
  }
  /// Sets the state of an entity at `stamp` in an update.
  void put_state(peer::Inbound& update, const pdu::EntityId& id,
                 const deadreckon::KinematicState& state, nanoseconds stamp,
                 deadreckon::AccelerationReading wire = {}) const {
    update.entity = update.state.entity_id = id;
    update.has_state = true;
    ASSERT_EQ(to_wire(state, frame, update.state, wire), deadreckon::ConversionError::none);
    update.state.header.timestamp = pdu::to_dis_timestamp(kUtc + stamp, true);
  }
  /// An update arrives.
  void take(const peer::Inbound& update, nanoseconds now, std::uint32_t epoch = 0,
            const aoim::SourceAddress& from = {}) {
    peer::Arrival arrival{now, kUtc + now, now, epoch, {}};
    arrival.from = from;
    remote.take(update, arrival, {});
  }
  /// The value of a counter; the largest number if there is none of this name.
  [[nodiscard]] std::uint64_t count(std::string_view name) const {
    const peer::Counter* found = counters.find(name);
    return found == nullptr ? ~0ULL : found->value();
  }

  peer::SceneFile scene;
  deadreckon::LocalFrame frame{0.8, 0.1, 400};
  peer::GroupPool pool;
  peer::Counters counters;
  aoim::AreaOfInterestManager aoim;
  peer::RemoteEntities remote;
};

}  // namespace reckon::test
