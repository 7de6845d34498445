// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// A peer's state for terminals, files and measurements: copies that the model loop publishes, so
// that reading never disturbs a loop.
#pragma once

#include <Eigen/Core>
#include <array>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <span>

#include "reckon/haptics/exchange/servo_types.hpp"
#include "reckon/pdu/codec/enumerations.hpp"
#include "reckon/pdu/codec/records.hpp"
#include "reckon/peer/ownership/tenure.hpp"
#include "reckon/peer/world/device_stiffness.hpp"
#include "reckon/peer/world/hand_port.hpp"
#include "reckon/peer/world/state_table.hpp"

namespace reckon::peer {

/// Summary of the emissions of a remote entity; see EmissionTable.
struct EmittedView {
  std::uint8_t emitters = 0;  ///< emitter systems, also those without a beam
  std::uint8_t beams = 0;     ///< active ones
  std::uint16_t targets = 0;  ///< that are listed by these beams
  std::uint8_t iff = 0;       ///< IFF systems
  std::uint8_t iff_on = 0;
  std::uint8_t radios = 0;
  std::uint8_t transmitting = 0;  ///< of the radios
  /// Of the first IFF system that is on: its type, and parameter 3 with mode 3/A.
  std::uint16_t iff_type = 0, mode_3a = 0;
  float beam_hz = 0, beam_dbm = 0;  ///< frequency and power of the strongest active beam
  double radio_hz = 0;              ///< frequency of the first transmitting radio

  [[nodiscard]] bool any() const noexcept { return emitters + iff + radios > 0; }
};

/// One remote entity as a table row.
struct EntityView {
  pdu::EntityId id;
  std::array<char, 12> marking{};
  pdu::EntityKind kind = pdu::EntityKind::other;
  pdu::DeadReckoningAlgorithm algorithm = pdu::DeadReckoningAlgorithm::static_;
  Eigen::Vector3d position = Eigen::Vector3d::Zero();  ///< as shown, S [m]
  double rate_hz = 0.0;  ///< updates a second since the first reception; 0 after updates stop
  double jump_m = 0.0;   ///< innovation of the last update
  double age = 0.0;      ///< [s] since the last update
  bool haptic = false;
  bool frozen = false;
  bool refused = false;   ///< its last force model had impossible values
  double force_n = 0.0;   ///< magnitude on our hand now, the largest of several
  double k1 = 0.0;        ///< [N/m] as received
  double k1_felt = 0.0;   ///< [N/m], least stiffness at which our devices near it show it
  double ledger_j = 0.0;  ///< energy that this contact may spend
  std::uint64_t updates = 0;
  std::uint8_t parts = 0;  ///< parameters of its articulated parts, one or more for each part
  EmittedView emits;
};

/// One hand of this peer.
struct HandView {
  pdu::EntityId id;
  haptics::ServoSnapshot servo;  ///< newest
  DeviceStiffness stiffness;
};

/// Leaders of the scene and of a peer's cells, if the scene has leaders.
struct LeadersView {
  static constexpr std::size_t kCells = 64;  ///< shown; `cells` counts all
  struct Cell {
    std::int32_t column = 0, row = 0;
    pdu::SimulationAddress leader;  ///< 0:0: none is known
  };
  static constexpr std::size_t kFollowed = 16;
  /// A beacon that this peer follows.
  struct Followed {
    std::array<char, 32> name{};  ///< NUL at the end
    bool found = false;
    std::int32_t column = 0, row = 0;  ///< its cell, if it is found
    std::uint16_t group = 0;           ///< used for its traffic; 0: the base group
  };

  bool on = false;
  pdu::SimulationAddress scene;   ///< leader of the scene; 0:0: none is known
  std::uint32_t map_version = 0;  ///< of the map of groups in use; 0: none
  std::size_t map_cells = 0;      ///< cells with a group in it
  std::size_t cells = 0;          ///< cells of which this peer is a member
  std::size_t led = 0;            ///< number of these cells that this peer leads
  std::size_t leaderless = 0;     ///< number of these cells without a known leader
  std::size_t count = 0;
  std::array<Cell, kCells> rows{};
  std::size_t followed_count = 0;
  std::array<Followed, kFollowed> followed{};
};

/// Who owns a movable object of the scene.
struct BodyOwnerView {
  pdu::SimulationAddress owner;  ///< 0:0: not known, or it has left
  bool is_ours = false;
  std::uint32_t epoch = 0;                   ///< of the owner
  std::uint64_t version = 0;                 ///< see OwnershipRecord
  std::uint32_t changes = 0;                 ///< of the owner, as seen here
  OwnerChange cause = OwnerChange::founded;  ///< of the last one

  friend bool operator==(const BodyOwnerView&, const BodyOwnerView&) = default;
};

/// A peer as a whole, some twenty times a second.
struct PeerView {
  static constexpr std::size_t kRows = 64;  ///< shown, see ViewChoice; `entities` counts all

  std::chrono::nanoseconds time{0};
  std::chrono::nanoseconds started{0};  ///< by the same clock
  pdu::EntityId own;                    ///< first entity of this peer; entity 0 if it has none
  std::size_t owned = 0;                ///< entities of this peer
  /// When the entities on tracks started; negative: not yet.
  std::chrono::nanoseconds set_out{-1};
  double power_given = 0;  ///< [J] given to hands by entities without a device
  std::array<HandView, kMaxDevices> hands{};
  std::size_t hand_count = 0;
  std::size_t entities = 0;                  ///< remote ones known
  std::size_t peers = 0;                     ///< other Reckon peers known
  std::size_t groups = 0;                    ///< cell groups joined
  std::size_t bodies = 0, bodies_awake = 0;  ///< that this peer moves and sends
  /// Its bodies rest, because it does not receive enough of the peers that own bodies.
  bool bodies_rest = false;
  std::size_t body_owner_count = 0;  ///< movable objects of the scene; 0: their owner is fixed
  std::array<BodyOwnerView, kMostOwnable> body_owners{};
  std::uint64_t bodies_not_woken = 0;  ///< see BodyWorld::crowded()
  LeadersView leaders;
  bool frozen = false;
  std::chrono::nanoseconds first_remote{-1};  ///< from the start until a remote entity was shown
  /// Centre of the selection of rows: the first hand, the first entity or the origin, S [m].
  Eigen::Vector3d middle = Eigen::Vector3d::Zero();
  std::size_t count = 0;
  std::array<EntityView, kRows> rows{};  ///< in the order of their IDs

  /// Of the first hand; all zero if there is none.
  [[nodiscard]] const haptics::ServoSnapshot& servo() const noexcept { return hands[0].servo; }
  [[nodiscard]] std::span<const HandView> own_hands() const noexcept {
    return {hands.data(), hand_count};
  }
};

/// The row of a remote entity at `now`, with the force it puts on our hands.
[[nodiscard]] EntityView view_of(const RemoteEntity& row, std::span<const HandView> hands,
                                 std::chrono::nanoseconds now) noexcept;
/// Selects the entities of a picture if there are more entities than rows: the nearest ones. An
/// entity of the last picture stays until another is a tenth nearer, so that no entity flickers at
/// the limit.
///
/// In a large table each picture examines the next kLooks rows and the rows of the last picture:
/// all are examined within 100,000 / kLooks = 13 pictures.
class ViewChoice {
 public:
  static constexpr std::size_t kLooks = 8192;

  /// Places of the selected entities in `rows`, in the order of their IDs; valid until the next
  /// call. Nearest to `from` [m] by their last stated position. Some 10 ns for each examined row.
  [[nodiscard]] std::span<const std::uint32_t> choose(std::span<const RemoteEntity> rows,
                                                      const Eigen::Vector3d& from) noexcept;

 private:
  struct Candidate {
    double distance = 0;  // squared [m^2], less if it was chosen last time
    std::uint32_t place = 0;
    friend bool operator<(const Candidate& a, const Candidate& b) noexcept {
      return a.distance < b.distance;
    }
  };

  void offer_again(std::span<const RemoteEntity> rows, const Eigen::Vector3d& from) noexcept;
  [[nodiscard]] bool was_chosen(const pdu::EntityId& id) const noexcept;
  void offer(const Candidate& candidate) noexcept;

  std::array<Candidate, PeerView::kRows> nearest_{};  // a heap, the farthest at its head
  std::array<std::uint32_t, PeerView::kRows> places_{};
  std::array<pdu::EntityId, PeerView::kRows> chosen_{};  // IDs of the rows at places_
  std::size_t count_ = 0;
  std::size_t chosen_count_ = 0;
  std::size_t next_ = 0;  // next row to examine
};

/// The shown state of one remote entity at one model step, which a measurement compares with the
/// truth.
struct ShownSample {
  std::chrono::nanoseconds time{0};
  pdu::EntityId id;
  Eigen::Vector3d position = Eigen::Vector3d::Zero();  ///< S [m]
};

}  // namespace reckon::peer
