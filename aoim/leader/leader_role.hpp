// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The part of one peer in leading and being led: elections in the cells it is in, the map of groups
// where it leads the scene, snapshots where it leads a cell and where it comes late. What others
// say must have passed the tests of Presence: only a known life, from its own address, may say
// anything here, and only who leads may say maps and snapshots.
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "reckon/aoim/leader/beacon_book.hpp"
#include "reckon/aoim/leader/cell_leadership.hpp"
#include "reckon/aoim/leader/group_directory.hpp"
#include "reckon/aoim/leader/group_pool.hpp"
#include "reckon/aoim/leader/snapshot_reader.hpp"
#include "reckon/aoim/leader/snapshot_server.hpp"
#include "reckon/aoim/leader/state_store.hpp"
#include "reckon/pdu/reckon/cell_roles.hpp"
#include "reckon/pdu/reckon/cell_snapshot.hpp"
#include "reckon/pdu/reckon/group_map.hpp"

namespace reckon::aoim {

/// A state that a leader relayed to us.
struct RelayedState {
  std::uint32_t epoch = 0;                 ///< life of the entity's owner, as the leader says
  std::vector<std::byte> octets;           ///< an Entity State PDU
  std::optional<pdu::HapticRecord> model;  ///< its force model
  std::chrono::nanoseconds heard{};        ///< when the leader heard it, by our clock
};

/// A tag that is looked up in the map of groups, and the cell in which we carry it.
struct CarriedBeacon {
  std::uint32_t tag = 0;  ///< see beacon_tag; not 0
  CellId cell;

  friend bool operator==(const CarriedBeacon&, const CarriedBeacon&) = default;
};

/// Who a PDU says it is from.
struct LeaderSignature {
  std::uint8_t exercise_id = 0;
  std::uint32_t timestamp = 0;
  pdu::SimulationAddress simulation;
};

/// One thread; allocates as cells, members and entities are new.
class LeaderRole {
 public:
  using Nanoseconds = std::chrono::nanoseconds;

  /// @param pool groups of the grid, 1 .. 1,000
  /// @param epoch our life
  /// @throws std::invalid_argument for a pool of more than 1,000 groups, or a quarantine that is
  /// not longer than the lease
  LeaderRole(const LeaderConfig& config, std::size_t pool, std::uint32_t epoch);

  /// We take part in the scene.
  void start(std::chrono::nanoseconds utc, std::chrono::nanoseconds now);
  /// We say good-bye everywhere; the next steps send it.
  void stop(std::chrono::nanoseconds now);
  /// We have joined a cell, whose traffic runs in `group`, or left it. Where groups are handed out,
  /// `group` is but a number of the cell, and read() is to be called once its traffic is heard.
  void enter(CellId cell, GroupIndex group, std::chrono::nanoseconds utc,
             std::chrono::nanoseconds now);
  void leave(CellId cell, std::chrono::nanoseconds now);
  /// All beacons that we carry, in the place of those before. One in a cell that we have not joined
  /// is not announced.
  void set_beacons(std::span<const CarriedBeacon> beacons, Nanoseconds now);

  // What others say, `sender` being the life that their datagram is from.
  void receive(const pdu::CellRoles& roles, std::uint32_t sender, std::chrono::nanoseconds now);
  /// @param came when it arrived, <= now: its lease runs from then on, for who slept may find maps
  /// that wait for it
  void receive(const pdu::GroupMap& part, std::uint32_t sender, Nanoseconds now, Nanoseconds came);
  void receive(const pdu::CellSnapshot& part, std::uint32_t sender, std::chrono::nanoseconds now);
  /// An Entity State of its owner, ours too, in a group that we have joined.
  void note(GroupIndex group, std::uint32_t epoch, const pdu::EntityState& state,
            std::span<const std::byte> octets, std::chrono::nanoseconds now) {
    states_.note(group, epoch, state, octets, now);
  }
  /// Records of its owner that extend the last state noted.
  void note_records(std::uint32_t epoch, const pdu::EntityId& entity,
                    std::span<const std::byte> records) {
    states_.note_records(epoch, entity, records);
  }
  /// An entity of this life was heard in a cell that is none of ours.
  void forget(std::uint32_t epoch, const pdu::EntityId& entity) { states_.forget(epoch, entity); }
  /// Presence says that this life is over.
  void forget(std::uint32_t epoch, std::chrono::nanoseconds now);

  /// Elections, maps, snapshots: `send` gets (GroupIndex, std::span<const std::byte>), a PDU each.
  using Send = std::function<void(GroupIndex, std::span<const std::byte>)>;
  void step(std::chrono::nanoseconds now, const LeaderSignature& signature, const Send& send);
  [[nodiscard]] std::chrono::nanoseconds next_step() const noexcept;

  /// States of snapshots since the last call.
  [[nodiscard]] std::vector<RelayedState> take_relayed() { return std::exchange(relayed_, {}); }
  [[nodiscard]] bool has_relayed() const noexcept { return !relayed_.empty(); }
  // Where groups are handed out (LeaderConfig::hand_out) ------------------------------------------

  /// The group to speak to in a cell: the base group until the cell's has been in the map for
  /// `settle`, and where the map may not be everybody's: its lease is over, two lead the scene, or
  /// somebody has said that it has none.
  [[nodiscard]] GroupIndex speak_group(CellId cell, Nanoseconds now) const noexcept;
  /// The group to listen to for a cell; none where it has none.
  [[nodiscard]] std::optional<GroupIndex> listen_group(CellId cell) const noexcept {
    return directory_.last_group(cell);
  }
  /// All that is said of this cell is heard from now on: its leader is asked for what was.
  void read(CellId cell, Nanoseconds now);
  /// A peer that is known says that it has no map.
  void doubt_map(Nanoseconds now) noexcept { doubted_ = now; }
  /// Whether others have a map and we have none.
  [[nodiscard]] bool lacks_map(Nanoseconds now) const noexcept {
    return config_.hand_out && heard_mapped_ && !leads(kWholeScene) && !directory_.holds(now);
  }
  /// True, once in `refresh`, where we lack the map.
  [[nodiscard]] bool take_plea(Nanoseconds now) noexcept;

  /// A cell whose snapshot did not come in time: its owners are to be asked. False: none.
  bool take_given_up(std::chrono::nanoseconds now, CellId& cell) {
    return reader_.take_given_up(now, cell);
  }

  [[nodiscard]] std::uint32_t leader(CellId cell) const noexcept {
    return leadership_.leader(cell);
  }
  [[nodiscard]] bool leads(CellId cell) const noexcept { return leadership_.leads(cell); }
  /// Group handed out for a cell; none: the base group.
  [[nodiscard]] std::optional<GroupIndex> group(CellId cell,
                                                std::chrono::nanoseconds now) const noexcept {
    return directory_.group(cell, now);
  }
  [[nodiscard]] const CellLeadership& leadership() const noexcept { return leadership_; }
  [[nodiscard]] const GroupDirectory& directory() const noexcept { return directory_; }
  /// What is given to whom where we lead the scene; else as it was when we last did.
  [[nodiscard]] const GroupPool& pool() const noexcept { return pool_; }
  [[nodiscard]] const StateStore& states() const noexcept { return states_; }
  [[nodiscard]] const SnapshotServer& server() const noexcept { return server_; }
  [[nodiscard]] bool reads(CellId cell) const noexcept { return reader_.reads(cell); }

 private:
  void take_state(const pdu::SnapshotState& head, std::span<const std::byte> octets,
                  GroupIndex group, Nanoseconds now);
  void answer(const pdu::CellRole& role, Nanoseconds now);
  void note_populated(CellId cell, Nanoseconds now);
  void note_own_cells(Nanoseconds now);
  void take_events(Nanoseconds now);
  void say_roles(Nanoseconds now, const LeaderSignature& signature, const Send& send);
  void send_roles(const LeaderSignature& signature, const Send& send);
  void add_role(const pdu::CellRole& role, const LeaderSignature& signature, const Send& send);
  void hand_out(Nanoseconds now);
  void publish(Nanoseconds now, const LeaderSignature& signature, const Send& send);
  [[nodiscard]] std::vector<pdu::CellGroup> map_rows(Nanoseconds now) const;
  void send_map(std::span<const pdu::CellGroup> rows, const LeaderSignature& signature,
                const Send& send);
  template <typename Pdu>
  void sign(Pdu& pdu, const LeaderSignature& signature) const noexcept {
    pdu.header.exercise_id = signature.exercise_id;
    pdu.header.timestamp = signature.timestamp;
    pdu.simulation = signature.simulation;
    pdu.epoch = leadership_.epoch();
  }
  /// Changes of the map within this are sent together.
  static constexpr Nanoseconds kMapGap = std::chrono::milliseconds(100);

  LeaderConfig config_;
  std::size_t groups_;
  CellLeadership leadership_;
  GroupPool pool_;
  GroupDirectory directory_, rival_;
  StateStore states_;
  SnapshotServer server_;
  SnapshotReader reader_;
  std::map<CellId, GroupIndex> entered_;
  std::vector<CarriedBeacon> carried_;
  BeaconBook beacons_;                       ///< of all
  std::map<CellId, Nanoseconds> populated_;  ///< cells in which somebody is, and was heard when
  Nanoseconds next_hand_out_{}, next_map_{}, last_map_{};
  bool changed_ = false;                          ///< the pool, since the last map
  bool heard_mapped_ = false;                     ///< somebody has said that there is a map
  int last_maps_ = 0;                             ///< still to say after the lead was lost
  int more_maps_ = 0;                             ///< still to say soon after a change
  Nanoseconds doubted_ = Nanoseconds::min() / 2;  ///< when the map was last not everybody's
  Nanoseconds next_plea_{}, next_map_ask_{};
  std::uint32_t version_ = 0;
  std::vector<std::byte> roles_;  ///< encoded, to be sent
  std::vector<RelayedState> relayed_;
};

}  // namespace reckon::aoim
