// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// One process with entities whose states it sends, and the states of other hosts as known from
// updates and from snapshots of leaders.
#pragma once

#include <cstdint>
#include <map>
#include <set>
#include <utility>
#include <vector>

#include "reckon/aoim/event_handler.hpp"
#include "reckon/tests/fuzz/leaders/map_record.hpp"
#include "reckon/tests/fuzz/leaders/plan.hpp"

namespace reckon::fuzz::leaders {

/// The version of a forged state; no true state reaches it.
inline constexpr double kForgedVersion = 9999.0;

/// The tag of the beacon that a host carries.
[[nodiscard]] constexpr std::uint32_t beacon_of(std::size_t host) noexcept {
  return static_cast<std::uint32_t>(1 + host);
}
/// The tag of a beacon without a carrier.
inline constexpr std::uint32_t kForgedBeacon = 0xBADBEAC;

/// The last received state of an entity.
struct Known {
  std::uint32_t epoch = 0;
  double version = 0.0;
};

class SimulatedHost : private aoim::EventHandler {
 public:
  SimulatedHost(const Plan& plan, std::size_t host, std::uint32_t epoch, nanoseconds clock,
                nanoseconds now);

  void receive(aoim::GroupIndex group, std::span<const std::byte> datagram, nanoseconds now,
               const aoim::SourceAddress& from, nanoseconds came);
  void step(nanoseconds now, aoim::DatagramSink sink);
  void say_goodbye(nanoseconds now, aoim::DatagramSink sink);
  void move(const aoim::Position& place) noexcept { place_ = place; }
  void set_clock(nanoseconds clock) { aoim_.set_utc_offset(clock, true); }
  /// Changes all of its entities; the next step sends them.
  void change() noexcept { ++version_; }

  [[nodiscard]] nanoseconds next(nanoseconds now) const noexcept;
  [[nodiscard]] aoim::AreaOfInterestManager& aoim() noexcept { return aoim_; }
  [[nodiscard]] const aoim::AreaOfInterestManager& aoim() const noexcept { return aoim_; }
  [[nodiscard]] const aoim::LeaderRole& role() const noexcept { return aoim_.leading()->role(); }
  [[nodiscard]] std::uint32_t epoch() const noexcept { return aoim_.presence().own().epoch; }
  [[nodiscard]] aoim::CellId cell() const noexcept {
    return aoim_.cells().cell_of(aoim_.cells().group(place_));
  }
  [[nodiscard]] bool hears(aoim::GroupIndex group) const noexcept {
    return aoim_.subscriptions().hears(group);
  }
  /// Whether it has joined the cell of the other host.
  [[nodiscard]] bool listens_to(const SimulatedHost& other) const noexcept {
    return aoim_.subscriptions().cells().is_joined(aoim_.cells().group(other.place_));
  }
  /// The group to which it sends its states.
  [[nodiscard]] aoim::GroupIndex group() const noexcept { return aoim_.route(place_); }
  [[nodiscard]] const std::map<pdu::EntityId, Known>& known() const noexcept { return known_; }
  [[nodiscard]] std::size_t entities() const noexcept { return sent_.size(); }
  [[nodiscard]] double version() const noexcept { return version_; }
  [[nodiscard]] pdu::EntityId entity(std::size_t index) const noexcept {
    const aoim::PeerId id = aoim_.presence().id();
    return {id.site, id.application, static_cast<std::uint16_t>(index + 1)};
  }
  [[nodiscard]] const MapRecord& maps() const noexcept { return maps_; }
  /// Updates sent as introductions, not because of changes.
  [[nodiscard]] std::uint64_t introductions() const noexcept { return introductions_; }

 private:
  struct Sent {
    aoim::GroupIndex group;
    nanoseconds at = -std::chrono::hours(1);
    double version = -1.0;
  };
  void look_around(nanoseconds now);
  void send_due(nanoseconds now);
  void claim(const aoim::PeerId&, std::uint32_t) noexcept override {}
  void drop(const aoim::PresenceEvent::Dropped&, bool) noexcept override {}
  void rename(const aoim::PeerId&) noexcept override {}
  void receive(const aoim::RelayedState& state, const aoim::SourceAddress& from) noexcept override;
  void report(const aoim::PresenceEvent&) noexcept override {}
  void take(const pdu::EntityState& state, std::uint32_t epoch, bool relayed);

  aoim::Position place_;
  std::uint32_t beacon_ = 0;  ///< the beacon that it carries; 0: none
  double version_ = 1.0;
  aoim::AreaOfInterestManager aoim_;
  MapRecord maps_;
  std::vector<Sent> sent_;
  std::map<pdu::EntityId, Known> known_;
  std::uint64_t introductions_ = 0;
};

}  // namespace reckon::fuzz::leaders
