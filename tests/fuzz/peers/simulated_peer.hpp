// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// One process of the simulation: the product's peer logic, and the minimum of entities needed to
// check which process sends an entity and which ones show it.
#pragma once

#include <cstdint>
#include <map>
#include <span>
#include <vector>

#include "reckon/aoim/event_handler.hpp"
#include "reckon/tests/fuzz/peers/counted_truth.hpp"
#include "reckon/tests/fuzz/peers/plan.hpp"

namespace reckon::fuzz {

inline constexpr double kRadius = 60.0;  // [m], of interest
inline constexpr nanoseconds kEntityHeartbeat = std::chrono::seconds(5);
inline constexpr nanoseconds kEntityTimeout = std::chrono::seconds(12);
inline constexpr std::size_t kTracked = 512;

/// Most peers that the simulated processes remember.
[[nodiscard]] constexpr std::size_t table_size(std::size_t hosts) noexcept {
  return 2 * hosts + 24;
}

/// A remote entity as it is shown.
struct ShownEntity {
  pdu::EntityId id;
  std::uint32_t epoch = 0;
  nanoseconds heard{};
};

/// An entity of this process.
struct OwnEntity {
  std::uint16_t number = 1;
  aoim::Position home;
  double speed = 0.0;  ///< [m/s], back and forth along x over 200 m
  nanoseconds next_heartbeat{}, last_sent = nanoseconds(-1'000'000'000'000);
  aoim::GroupIndex last_group;
  nanoseconds jump_at = nanoseconds::max();

  [[nodiscard]] aoim::Position at(nanoseconds now) const noexcept;
};

class SimulatedPeer : private aoim::EventHandler {
 public:
  SimulatedPeer(const Plan& plan, std::size_t host, std::uint32_t epoch, nanoseconds now,
                nanoseconds clock);

  /// Handles one datagram as the loop does. Resulting events are kept until take_events().
  aoim::Incoming receive(aoim::GroupIndex group, std::span<const std::byte> datagram,
                         nanoseconds now, const aoim::SourceAddress& from);
  /// The other work of the loop. Call it whenever next() is reached and after receive().
  void step(nanoseconds now, aoim::DatagramSink sink);
  /// The last step: sends the leave announcement.
  void leave(nanoseconds now, aoim::DatagramSink sink);
  [[nodiscard]] nanoseconds next(nanoseconds now) const noexcept;
  void set_clock(nanoseconds clock) noexcept;

  /// Events since the last call.
  [[nodiscard]] std::vector<aoim::PresenceEvent> take_events();
  [[nodiscard]] const aoim::AreaOfInterestManager& aoim() const noexcept { return aoim_; }
  [[nodiscard]] aoim::PeerId id() const noexcept { return id_; }
  [[nodiscard]] bool is_joined(aoim::GroupIndex group) const noexcept {
    return aoim_.subscriptions().hears(group);
  }
  /// When this process joined the group of an entity at `position`; the minimum if it has not.
  [[nodiscard]] nanoseconds joined(const aoim::Position& position) const noexcept {
    const auto found = joined_.find(aoim_.route(position).value);
    return found == joined_.end() ? nanoseconds::min() : found->second;
  }
  [[nodiscard]] const std::vector<OwnEntity>& entities() const noexcept { return entities_; }
  [[nodiscard]] const std::vector<ShownEntity>& shown() const noexcept { return shown_; }
  /// Its record of this life; null without one.
  [[nodiscard]] const aoim::Peer* find(std::uint32_t epoch) const noexcept;
  [[nodiscard]] bool shows(const pdu::EntityId& id, std::uint32_t epoch) const noexcept;
  /// Distance from an entity at `position` to the nearest own entity [m].
  [[nodiscard]] double distance_to(const aoim::Position& position, nanoseconds now) const noexcept;
  /// Whether this life is a listed member at that address.
  [[nodiscard]] bool lists(std::uint32_t epoch, const aoim::SourceAddress& from) const noexcept {
    return aoim_.presence().standing(epoch, &from) == aoim::Standing::member;
  }
  /// Datagrams that the tracker has counted.
  [[nodiscard]] std::uint64_t counted() const noexcept {
    return aoim_.sequences().counts().received;
  }
  /// The expected counts of the tracker.
  [[nodiscard]] const CountedTruth& truth() const noexcept { return truth_; }
  /// The verdict on the last datagram was not the expected one.
  [[nodiscard]] bool was_misjudged() const noexcept { return misjudged_; }

 private:
  void claim(const aoim::PeerId& name, std::uint32_t epoch) noexcept override;
  void drop(const aoim::PresenceEvent::Dropped& life, bool silent) noexcept override;
  void rename(const aoim::PeerId& own) noexcept override { id_ = own; }
  void receive(const aoim::RelayedState& state, const aoim::SourceAddress& from) noexcept override;
  void report(const aoim::PresenceEvent& event) noexcept override;
  void take_entities(std::span<const std::byte> datagram, std::uint32_t epoch, nanoseconds now);
  void note_truth(aoim::GroupIndex group, const aoim::Incoming& incoming);
  void look_around(nanoseconds now);
  void send_due(nanoseconds now);
  void send(OwnEntity& entity, nanoseconds now);
  [[nodiscard]] nanoseconds next_heartbeat(const OwnEntity& entity, nanoseconds now) const noexcept;

  bool wide_, moves_ = false;
  nanoseconds chatter_at_ = nanoseconds::max();
  aoim::AreaOfInterestManager aoim_;
  aoim::PeerId id_;
  std::vector<OwnEntity> entities_;
  std::vector<ShownEntity> shown_;
  std::vector<aoim::PresenceEvent> events_;
  std::vector<aoim::Focus> foci_;
  std::map<std::uint16_t, nanoseconds> joined_;  ///< join time by group
  CountedTruth truth_;
  bool misjudged_ = false;
  nanoseconds next_look_{};
};

}  // namespace reckon::fuzz
