// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The role of one peer in the leadership of cells: elections in the cells that it has joined, the
// group map if it leads the scene, snapshots as a leader and as a newcomer. Presence checks
// received PDUs first: each must come from a known epoch and its address, and maps and snapshots
// from a leader.
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

/// An entity state that a leader relayed to us.
struct RelayedState {
  std::uint32_t epoch = 0;                 ///< epoch of the entity's owner, as the leader states
  std::vector<std::byte> octets;           ///< an Entity State PDU
  std::optional<pdu::HapticRecord> model;  ///< its force model
  std::chrono::nanoseconds heard{};        ///< when the leader received it, on our clock
  std::optional<pdu::OwnershipRecord> ownership = {};  ///< of a body of the scene
};

/// A beacon of an own entity: its tag, which peers look up in the group map, and its cell.
struct CarriedBeacon {
  std::uint32_t tag = 0;  ///< see beacon_tag; not 0
  CellId cell;

  friend bool operator==(const CarriedBeacon&, const CarriedBeacon&) = default;
};

/// The sender's fields in a PDU.
struct LeaderSignature {
  std::uint8_t exercise_id = 0;
  std::uint32_t timestamp = 0;
  pdu::SimulationAddress simulation;
};

/// One thread; allocates for new cells, members and entities.
class LeaderRole {
 public:
  using Nanoseconds = std::chrono::nanoseconds;

  /// @param pool groups of the grid, 1 .. 1,000
  /// @param epoch of this peer
  /// @throws std::invalid_argument for a pool of more than 1,000 groups, or a quarantine that is
  /// not longer than the lease
  LeaderRole(const LeaderConfig& config, std::size_t pool, std::uint32_t epoch);

  /// Joins the scene.
  void start(std::chrono::nanoseconds utc, std::chrono::nanoseconds now);
  /// Leaves all cells and the scene; the next steps announce it.
  void stop(std::chrono::nanoseconds now);
  /// This peer has joined or left a cell with the group `group`. If leaders hand out groups,
  /// `group` is only a number of the cell; call read() once the traffic of the cell is received.
  void enter(CellId cell, GroupIndex group, std::chrono::nanoseconds utc,
             std::chrono::nanoseconds now);
  void leave(CellId cell, std::chrono::nanoseconds now);
  /// Replaces the set of own beacons. A beacon in a cell that this peer has not joined is not
  /// announced.
  void set_beacons(std::span<const CarriedBeacon> beacons, Nanoseconds now);

  // Received PDUs; `sender` is the epoch of their datagram.
  void receive(const pdu::CellRoles& roles, std::uint32_t sender, std::chrono::nanoseconds now);
  /// @param came arrival time, <= now. The lease starts then, because a suspended peer may find old
  /// maps in its queue
  void receive(const pdu::GroupMap& part, std::uint32_t sender, Nanoseconds now, Nanoseconds came);
  void receive(const pdu::CellSnapshot& part, std::uint32_t sender, std::chrono::nanoseconds now);
  /// Stores an Entity State from its owner, or an own one, in a joined group.
  void note(GroupIndex group, std::uint32_t epoch, const pdu::EntityState& state,
            std::span<const std::byte> octets, std::chrono::nanoseconds now) {
    states_.note(group, epoch, state, octets, now);
  }
  /// Stores records from the owner that extend the last stored state.
  void note_records(std::uint32_t epoch, const pdu::EntityId& entity,
                    std::span<const std::byte> records) {
    states_.note_records(epoch, entity, records);
  }
  /// Removes an entity that was received in a cell that we have not joined.
  void forget(std::uint32_t epoch, const pdu::EntityId& entity) { states_.forget(epoch, entity); }
  /// Removes an epoch that has ended.
  void forget(std::uint32_t epoch, std::chrono::nanoseconds now);

  /// Sends roles, maps and snapshots. `send` gets (GroupIndex, std::span<const std::byte>) for each
  /// PDU.
  using Send = std::function<void(GroupIndex, std::span<const std::byte>)>;
  void step(std::chrono::nanoseconds now, const LeaderSignature& signature, const Send& send);
  [[nodiscard]] std::chrono::nanoseconds next_step() const noexcept;

  /// States from received snapshots since the last call.
  [[nodiscard]] std::vector<RelayedState> take_relayed() { return std::exchange(relayed_, {}); }
  [[nodiscard]] bool has_relayed() const noexcept { return !relayed_.empty(); }
  // Groups that leaders hand out (LeaderConfig::hand_out) -----------------------------------------

  /// The group for sending to a cell. It is the base group until the cell's group has been in the
  /// map for `settle`. It is also the base group while peers may have different maps: the lease is
  /// over, there are two leaders of the scene, or a peer has announced that it lacks the map.
  [[nodiscard]] GroupIndex speak_group(CellId cell, Nanoseconds now) const noexcept;
  /// The group of a cell to join, if it has one.
  [[nodiscard]] std::optional<GroupIndex> listen_group(CellId cell) const noexcept {
    return directory_.last_group(cell);
  }
  /// Updates of this cell are received from now on. Requests its present states from its leader.
  void read(CellId cell, Nanoseconds now);
  /// A known peer has announced that it lacks the map.
  void doubt_map(Nanoseconds now) noexcept { doubted_ = now; }
  /// Whether others have a map and this peer has none.
  [[nodiscard]] bool lacks_map(Nanoseconds now) const noexcept {
    return config_.hand_out && heard_mapped_ && !leads(kWholeScene) && !directory_.holds(now);
  }
  /// True, once in `refresh`, while this peer lacks the map.
  [[nodiscard]] bool take_plea(Nanoseconds now) noexcept;

  /// A cell whose snapshot is overdue, so that its owners must be asked. False if there is none.
  bool take_given_up(std::chrono::nanoseconds now, CellId& cell) {
    return reader_.take_given_up(now, cell);
  }

  [[nodiscard]] std::uint32_t leader(CellId cell) const noexcept {
    return leadership_.leader(cell);
  }
  [[nodiscard]] bool leads(CellId cell) const noexcept { return leadership_.leads(cell); }
  /// Group of a cell in the map; without a value the base group is used.
  [[nodiscard]] std::optional<GroupIndex> group(CellId cell,
                                                std::chrono::nanoseconds now) const noexcept {
    return directory_.group(cell, now);
  }
  [[nodiscard]] const CellLeadership& leadership() const noexcept { return leadership_; }
  [[nodiscard]] const GroupDirectory& directory() const noexcept { return directory_; }
  /// Assignment of groups to cells. Current while this peer leads the scene.
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
  void sign(auto& pdu, const LeaderSignature& signature) const noexcept {
    pdu.header.exercise_id = signature.exercise_id;
    pdu.header.timestamp = signature.timestamp;
    pdu.simulation = signature.simulation;
    pdu.epoch = leadership_.epoch();
  }
  /// Shortest time between two maps.
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
  BeaconBook beacons_;  ///< of all peers
  std::map<CellId, Nanoseconds>
      populated_;  ///< occupied cells, and when a peer there was last received
  Nanoseconds next_hand_out_{}, next_map_{}, last_map_{};
  bool changed_ = false;                          ///< the pool has changed since the last map
  bool heard_mapped_ = false;                     ///< a peer has announced that it has a map
  int last_maps_ = 0;                             ///< maps still to send after the lead was lost
  int more_maps_ = 0;                             ///< maps still to send soon after a change
  Nanoseconds doubted_ = Nanoseconds::min() / 2;  ///< when peers last had different maps
  Nanoseconds next_plea_{}, next_map_ask_{};
  std::uint32_t version_ = 0;
  std::vector<std::byte> roles_;  ///< encoded, to be sent
  std::vector<RelayedState> relayed_;
};

}  // namespace reckon::aoim
