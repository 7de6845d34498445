// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// THE rules of `reckon inspect check`: one row each with its code, meaning and remedy. A new rule
// is one function and one row in rules.cpp (and one injected fault for the tests).
#pragma once

#include <Eigen/Geometry>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "reckon/pdu/entity/entity_state.hpp"
#include "reckon/tools/datagrams/pdu_row.hpp"
#include "reckon/tools/datagrams/survey.hpp"
#include "reckon/tools/inspect/check/stamp_course.hpp"

namespace reckon::tools {

/// Memory of an entity from its last Entity State; 0 updates: empty.
struct EntityMemory {
  std::uint64_t updates = 0;
  pdu::EntityId id;
  peer::IpEndpoint sender;
  peer::IpEndpoint earlier_sender;  ///< sender before the last change
  bool reported_duplicate = false;
  bool haptic = false;  ///< has had a force model: its heartbeat is 5 s
  bool gone = false;    ///< deactivated: silence is no fault
  bool frozen = false;
  std::uint64_t ownership = 0;           ///< version, of a body of a scene
  bool out_of_range = false;             ///< has sent an invalid angle
  bool turns = false;                    ///< its model states a turn rate
  std::uint8_t contradictions = 0;       ///< by positions, updates in a row
  std::uint8_t turn_contradictions = 0;  ///< by orientations
  std::chrono::nanoseconds time{};       ///< arrival
  std::uint32_t timestamp = 0;
  double heartbeat = 0;  ///< [s]
  std::uint64_t frame = 0;
  std::size_t pdu = 0;
  std::size_t offset = 0;
  Eigen::Vector3d position = Eigen::Vector3d::Zero();               ///< geocentric [m]
  Eigen::Vector3d velocity = Eigen::Vector3d::Zero();               ///< geocentric axes [m/s]
  Eigen::Quaterniond orientation = Eigen::Quaterniond::Identity();  ///< body to geocentric
  Eigen::Quaterniond earlier_orientation = Eigen::Quaterniond::Identity();  ///< the one before
  Eigen::Vector3d turn_rate = Eigen::Vector3d::Zero();                      ///< body axes [rad/s]
  StampCourse stamps;
};

/// Input of a rule. Only PDUs that decode and have finite numbers are checked.
struct CheckedPdu {
  const PduRow& row;
  const peer::SourceDatagram& datagram;
  const DatagramSurvey& survey;
  std::uint8_t highest_rank;             ///< bundle_rank of the PDUs before it
  const pdu::EntityState* entity_state;  ///< null for other types
  const EntityMemory* memory;            ///< of that entity; null if there was no room

  /// Whether it is an update of a known entity.
  [[nodiscard]] bool has_history() const {
    return entity_state != nullptr && memory != nullptr && memory->updates > 0;
  }
};

/// Finding of a rule.
struct RuleFault {
  std::size_t offset = 0;              ///< of the faulty field, from the PDU's first octet
  std::string reason;                  ///< a clause without full stop
  std::optional<double> degrees = {};  ///< size of a turn
};

using RuleFunction = std::optional<RuleFault> (*)(const CheckedPdu& checked);

struct CheckRule {
  std::string_view code;        ///< begins with E- error, W- warning, I- note
  std::string_view sentence;    ///< meaning
  std::string_view remedy;      ///< action for the user
  RuleFunction look = nullptr;  ///< null: found by the codec, or by the view itself
};

/// All rules, beginning with the rules of the codec.
[[nodiscard]] std::span<const CheckRule> check_rules();
/// The rule of a code; null if there is none.
[[nodiscard]] const CheckRule* find_check_rule(std::string_view code);

inline constexpr std::string_view kHeartbeatRule = "W-HEARTBEAT";
inline constexpr std::string_view kMemoryRule = "I-ENTITY-LIMIT";
inline constexpr std::string_view kDuplicateRule = "W-DUPLICATE-ID";
inline constexpr std::string_view kTeleportRule = "W-TELEPORT";
inline constexpr std::string_view kSpikeRule = "W-SPIKE";
inline constexpr std::string_view kCopiesRule = "I-COPIES";

inline constexpr std::size_t kLocationAt = 48;  ///< of the location in an Entity State [octet]

/// Silence longer than 2.4 heartbeats, as a clause; no value if it is shorter.
[[nodiscard]] std::optional<std::string> silence(const EntityMemory& memory,
                                                 std::chrono::nanoseconds now);

/// Stores an Entity State in the memory of its entity, after the rules have checked it.
void remember(EntityMemory& memory, const CheckedPdu& checked);

}  // namespace reckon::tools
