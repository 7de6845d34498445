// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Finds positions that an entity cannot have reached by its motion: teleports, and spikes of a
// single update. The next update decides between the two.
#pragma once

#include <array>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <vector>

#include "reckon/deadreckon/motion/kinematic_state.hpp"
#include "reckon/tools/datagrams/pdu_row.hpp"
#include "reckon/tools/listener/listener.hpp"

namespace reckon::tools {

/// An update that the previous one does not explain.
struct Jump {
  enum class Kind : std::uint8_t {
    teleport,  ///< the entity stays there, or sends nothing more
    spike,     ///< the next update continues the motion before
    by_turns,  ///< every other update is at a second position: two entities with one ID
  };
  Kind kind = Kind::teleport;
  pdu::EntityId id;
  std::uint64_t frame = 0;
  std::size_t pdu = 0;     ///< place in the datagram, from 1
  std::size_t offset = 0;  ///< of the PDU in the datagram
  bool is_entity_state = false;
  std::chrono::nanoseconds time{};  ///< arrival
  double metres = 0;                ///< from the extrapolation of the update before
  double degrees = 0;               ///< the same of the orientation
  double explained = 0;             ///< [m], limit explained by the motion
  double interval = 0;              ///< since the update before [s]
};

/// The search, over PDUs in order of arrival; one thread. An update is a jump if its position is
/// farther than explained() both from the extrapolation of the update before and from the motion at
/// the mean of both velocities, over the interval by timestamps and over the one by arrivals. Not
/// compared: the first update of an entity, an update after a time-out, a deactivation or a change
/// of sender, and late updates and copies. Some 800 octets per entity.
class JumpSearch {
 public:
  using Tell = std::function<void(const Jump&)>;

  explicit JumpSearch(std::size_t most_entities);

  /// Takes a PDU that decodes and is finite; calls `tell` for the jumps that it decides.
  void take_pdu(const PduRow& row, const peer::SourceDatagram& datagram, const Tell& tell);
  /// Reports jumps after which the entity sent nothing.
  void finish(const Tell& tell);

  /// Distance that the motion between two updates can explain [m]: 5 m, 0.1 s of the speed, half
  /// the change of velocity over the interval (at most 150 m/s^2), and a hidden acceleration of
  /// 10 m/s^2, or of the stated one, for at most 5 s.
  [[nodiscard]] static double explained(const deadreckon::KinematicState& before,
                                        const deadreckon::KinematicState& now, double interval);

 private:
  /// Since the update before, by timestamps and by arrivals [s].
  using Intervals = std::array<double, 2>;

  /// A possible jump, which the next update decides.
  struct Suspect {
    deadreckon::KinematicState before;
    Intervals since{};
    Jump jump;
  };
  /// State of the last spike.
  struct LastSpike {
    deadreckon::KinematicState state;
    Intervals ago{};
    int updates = 0;  ///< since it
  };
  struct Row {
    peer::IpEndpoint sender;
    double unstated_speed = 0;  ///< [m/s] of an entity whose motion differs from its stated
                                ///< velocity
    bool by_turns = false;      ///< reported: its spikes are no longer reported
    std::unique_ptr<Suspect> suspect;
    std::unique_ptr<LastSpike> spike;
  };
  /// How well an update continues another.
  struct Fit {
    double off = 0;       ///< [m] by the better interval, from the nearer of both predictions
    double allowed = 0;   ///< [m]
    double metres = 0;    ///< from the extrapolation
    double interval = 0;  ///< used interval [s]
    [[nodiscard]] bool is_explained() const { return off <= allowed; }
  };
  struct Observer;

  void compare(Row& row, const StateUpdate& update, const Jump& here, const Tell& tell);
  void decide(Row& row, const StateUpdate& update, const Intervals& passed, const Jump& here,
              const Tell& tell);
  static void tell_spike(Row& row, const deadreckon::KinematicState& state, const Intervals& passed,
                         const Tell& tell);
  static void suspect(Row& row, const deadreckon::KinematicState& before, const Intervals& passed,
                      const Fit& fit, const deadreckon::KinematicState& now, const Jump& here);
  static void drop_suspect(Row& row, const Tell& tell);
  [[nodiscard]] static Fit fit(const deadreckon::KinematicState& before,
                               const deadreckon::KinematicState& now, const Intervals& passed,
                               double unstated_speed = 0);

  Listener heard_;
  std::vector<Row> rows_;  // indexed as in the listener, which keeps all entities
};

}  // namespace reckon::tools
