// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/tools/inspect/check/rules.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "reckon/deadreckon/motion/drm.hpp"
#include "reckon/deadreckon/motion/geocentric.hpp"
#include "reckon/deadreckon/sending/update_policy.hpp"
#include "reckon/deadreckon/wire_conversion.hpp"
#include "reckon/pdu/pdu_types.hpp"
#include "reckon/pdu/seconds.hpp"
#include "reckon/pdu/timestamp.hpp"
#include "reckon/tools/datagrams/foreign.hpp"
#include "reckon/tools/inspect/check/enumeration_rules.hpp"
#include "reckon/tools/inspect/output/format.hpp"

namespace reckon::tools {
namespace {

using std::chrono::nanoseconds;
using Fault = std::optional<RuleFault>;

// Offsets of fields in an Entity State.
constexpr std::size_t kStatusAt = 10;
constexpr std::size_t kIdAt = 12;
constexpr std::size_t kVelocityAt = 36;
constexpr std::size_t kAccelerationAt = 104;
constexpr std::size_t kAngularVelocityAt = 116;

constexpr std::size_t kLargestPdu = 8192;    // octets, MAX_PDU_SIZE of the standard
constexpr double kDeepest = 6.34e6;          // polar radius less the deepest sea [m]
constexpr double kShortestInterval = 0.05;   // [s], positions round too much below it
constexpr double kLongestInterval = 5.0;     // [s], the motion may have changed unseen beyond it
constexpr double kLeastContradiction = 2.0;  // [m]
constexpr double kGrossly = 0.5;             // of the displacement
constexpr std::uint8_t kContradictions = 3;  // in a row: a sharp turn causes one, a spike two

bool is_zero(const pdu::Vector3Float& v) { return v.x == 0 && v.y == 0 && v.z == 0; }

double length(const pdu::Vector3Float& v) { return Eigen::Vector3d(v.x, v.y, v.z).norm(); }

Eigen::Vector3d position_of(const pdu::EntityState& pdu) {
  return {pdu.location.x, pdu.location.y, pdu.location.z};
}

/// The velocity in geocentric axes, for any axes of the dead-reckoning model.
Eigen::Vector3d velocity_of(const pdu::EntityState& pdu) {
  const Eigen::Vector3d velocity(pdu.linear_velocity.x, pdu.linear_velocity.y,
                                 pdu.linear_velocity.z);
  if (!deadreckon::drm_terms(pdu.dead_reckoning.algorithm).body_axes) return velocity;
  const deadreckon::Euler euler{pdu.orientation.psi, pdu.orientation.theta, pdu.orientation.phi};
  return deadreckon::quaternion_from_euler(euler) * velocity;
}

bool has_history(const CheckedPdu& checked) {
  return checked.entity_state != nullptr && checked.memory != nullptr &&
         checked.memory->updates > 0;
}

Fault static_moves(const CheckedPdu& checked) {
  const pdu::EntityState* pdu = checked.entity_state;
  if (pdu == nullptr || pdu->dead_reckoning.algorithm != pdu::DeadReckoningAlgorithm::static_)
    return std::nullopt;
  const auto says = [](std::string_view field, const pdu::Vector3Float& v, std::string_view unit) {
    return fmt::format("DRM static (1), but {} is {:.3g} {}", field, length(v), unit);
  };
  if (!is_zero(pdu->linear_velocity))
    return RuleFault{kVelocityAt, says("entity_linear_velocity", pdu->linear_velocity, "m/s")};
  const auto& reckoning = pdu->dead_reckoning;
  if (!is_zero(reckoning.linear_acceleration))
    return RuleFault{kAccelerationAt,
                     says("entity_linear_acceleration", reckoning.linear_acceleration, "m/s^2")};
  if (!is_zero(reckoning.angular_velocity))
    return RuleFault{kAngularVelocityAt,
                     says("entity_angular_velocity", reckoning.angular_velocity, "rad/s")};
  return std::nullopt;
}

Fault reserved_id(const CheckedPdu& checked) {
  if (checked.entity_state == nullptr) return std::nullopt;
  const pdu::EntityId id = checked.entity_state->entity_id;
  const bool reserved =
      id.entity == 0 || id.entity >= 0xFFFE || id.site == 0xFFFF || id.application == 0xFFFF;
  if (!reserved) return std::nullopt;
  return RuleFault{
      kIdAt, fmt::format("entity_id {} names none, all, or an id to be assigned", id_text(id))};
}

Fault no_place(const CheckedPdu& checked) {
  if (checked.entity_state == nullptr) return std::nullopt;
  const double radius = position_of(*checked.entity_state).norm();
  if (radius >= kDeepest && radius <= deadreckon::kLargestLocation) return std::nullopt;
  return RuleFault{kLocationAt, fmt::format("entity_location is {:.6g} km from the earth's centre",
                                            radius / 1e3)};
}

Fault too_large(const CheckedPdu& checked) {
  if (checked.row.bytes.size() <= kLargestPdu) return std::nullopt;
  return RuleFault{
      8, fmt::format("{} octets, the standard allows {}", checked.row.bytes.size(), kLargestPdu)};
}

template <typename... T>
pdu::ProtocolFamily family_of(pdu::PduType type, pdu::TypeList<T...>) {
  auto family = pdu::ProtocolFamily::other;
  (void)((T::kPduType == type && (family = T::kProtocolFamily, true)) || ...);
  return family;
}

Fault wrong_family(const CheckedPdu& checked) {
  if (!checked.row.decoded) return std::nullopt;
  const auto expected = family_of(checked.row.header.pdu_type, pdu::PduTypes{});
  if (checked.row.header.protocol_family == expected) return std::nullopt;
  return RuleFault{3, fmt::format("protocol_family is {}, of this type {}",
                                  static_cast<unsigned>(checked.row.header.protocol_family),
                                  static_cast<unsigned>(expected))};
}

Fault back_in_time(const CheckedPdu& checked) {
  if (!has_history(checked)) return std::nullopt;
  const std::uint32_t now = checked.row.header.timestamp;
  if (pdu::is_absolute(now) != pdu::is_absolute(checked.memory->timestamp)) return std::nullopt;
  const nanoseconds step = pdu::difference(now, checked.memory->timestamp);
  if (step >= nanoseconds::zero()) return std::nullopt;
  return RuleFault{4, fmt::format("timestamp is {:.6f} s before the one of frame {}",
                                  -pdu::to_seconds(step), checked.memory->frame)};
}

/// Error of the timestamp [s], by the time of arrival: from UTC if it is absolute, else from the
/// entity's own first one. No value if the source has no time.
std::optional<double> timestamp_error(const CheckedPdu& checked) {
  const nanoseconds arrival = checked.datagram.time;
  const std::uint32_t timestamp = checked.row.header.timestamp;
  if (arrival == nanoseconds::zero()) return std::nullopt;
  if (pdu::is_absolute(timestamp)) {
    return pdu::to_seconds(pdu::nearest_instant(timestamp, arrival) - arrival);
  }
  if (!has_history(checked) || pdu::is_absolute(checked.memory->first_timestamp))
    return std::nullopt;
  const double stated = pdu::to_seconds(pdu::past_the_hour(timestamp)) -
                        pdu::to_seconds(pdu::past_the_hour(checked.memory->first_timestamp));
  return std::remainder(stated - pdu::to_seconds(arrival - checked.memory->first_time), 3600.0);
}

bool is_out_of_tolerance(const CheckedPdu& checked) {
  return std::abs(timestamp_error(checked).value_or(0)) > kTimestampTolerance;
}

Fault out_of_tolerance(const CheckedPdu& checked) {
  if (checked.entity_state == nullptr || !is_out_of_tolerance(checked)) return std::nullopt;
  if (checked.memory != nullptr && checked.memory->out_of_tolerance) return std::nullopt;
  const double error = *timestamp_error(checked);
  const bool absolute = pdu::is_absolute(checked.row.header.timestamp);
  return RuleFault{4, fmt::format("{} timestamp is {:.3f} s {} the arrival, {:g} s are allowed",
                                  absolute ? "absolute" : "relative", std::abs(error),
                                  error > 0 ? "ahead of" : "behind", kTimestampTolerance)};
}

Fault missed_heartbeat(const CheckedPdu& checked) {
  if (!has_history(checked)) return std::nullopt;
  auto clause = silence(*checked.memory, checked.datagram.time);
  if (!clause.has_value()) return std::nullopt;
  return RuleFault{0, std::move(*clause)};
}

/// Whether two senders use one entity. A different address counts at once. The same address with
/// another port counts only when the first port returns, because a restarted program has a new port
/// too.
bool is_duplicate(const EntityMemory& memory, const peer::IpEndpoint& sender) {
  if (memory.reported_duplicate || sender == memory.sender) return false;
  return sender.octets != memory.sender.octets || sender == memory.earlier_sender;
}

Fault duplicate_id(const CheckedPdu& checked) {
  if (!has_history(checked) || checked.memory->gone ||
      !is_duplicate(*checked.memory, checked.datagram.source))
    return std::nullopt;
  return RuleFault{
      kIdAt, fmt::format("{} comes from {} and from {}", id_text(checked.entity_state->entity_id),
                         checked.memory->sender.text(), checked.datagram.source.text())};
}

/// Distance between the entity's displacement since the last update and the one from its velocities
/// [m], if it is gross; else 0.
double contradiction(const CheckedPdu& checked) {
  if (!has_history(checked)) return 0;
  const EntityMemory& memory = *checked.memory;
  const double interval =
      pdu::to_seconds(pdu::difference(checked.row.header.timestamp, memory.timestamp));
  if (interval < kShortestInterval || interval > kLongestInterval) return 0;
  const Eigen::Vector3d way = position_of(*checked.entity_state) - memory.position;
  const Eigen::Vector3d stated =
      0.5 * interval * (memory.velocity + velocity_of(*checked.entity_state));
  const double error = (way - stated).norm();
  const double scale = std::max(way.norm(), stated.norm());
  return error > kLeastContradiction && error > kGrossly * scale ? error : 0;
}

Fault velocity_contradicts(const CheckedPdu& checked) {
  const double error = contradiction(checked);
  if (error == 0 || checked.memory->contradictions + 1 != kContradictions) return std::nullopt;
  const double interval =
      pdu::to_seconds(pdu::difference(checked.row.header.timestamp, checked.memory->timestamp));
  const double went =
      (position_of(*checked.entity_state) - checked.memory->position).norm() / interval;
  return RuleFault{
      kVelocityAt,
      fmt::format("entity_linear_velocity is {:.3g} m/s, the positions went {:.3g} m/s: "
                  "{:.3g} m apart in {:.3g} s, the third time in a row",
                  velocity_of(*checked.entity_state).norm(), went, error, interval)};
}

std::uint64_t key_of(const CheckedPdu& checked) {
  return entity_key(checked.row.header.exercise_id, checked.entity_state->entity_id);
}

Fault attribute_first(const CheckedPdu& checked) {
  if (checked.entity_state == nullptr) return std::nullopt;
  const auto attributes = checked.survey.of(key_of(checked));
  if (attributes.empty() || attributes.front().pdu > checked.row.pdu) return std::nullopt;
  return RuleFault{kIdAt, fmt::format("its Attribute PDU is PDU {} of the datagram, before it",
                                      attributes.front().pdu)};
}

Fault coupled_without(const CheckedPdu& checked) {
  if (checked.entity_state == nullptr || !checked.row.header.coupled_extension())
    return std::nullopt;
  if (!checked.survey.of(key_of(checked)).empty()) return std::nullopt;
  return RuleFault{kStatusAt,
                   fmt::format("CEI is set, and no Attribute PDU in this datagram is for "
                               "{}",
                               id_text(checked.entity_state->entity_id))};
}

Fault out_of_order(const CheckedPdu& checked) {
  if (!checked.row.has_header ||
      pdu::bundle_rank(checked.row.header.pdu_type) >= checked.highest_rank)
    return std::nullopt;
  return RuleFault{
      2, fmt::format("{} stands behind a PDU that is to be after it", checked.row.type())};
}

/// THE rules.
constexpr auto kRules = std::to_array<CheckRule>({
    {"E-TRUNCATED", "The datagram ends before the PDU does.",
     "capture whole frames (tcpdump -s 0); else the sender's length field is wrong"},
    {"E-LENGTH", "The length field is too small for a PDU of this type.",
     "the sender must write the octets of the whole PDU, header included"},
    {"E-COUNT", "More records are announced than octets are left in the PDU.",
     "compare the sender's count of records with what it writes"},
    {"E-RECORD", "A record's length is too small or runs past the end of the PDU.",
     "a record's length includes its own header and padding"},
    {"E-VERSION", "The protocol or record version is not supported.",
     "set the sender to DIS 5, 6 or 7"},
    {"E-TYPE", "A record is of another type than its place asks for.",
     "compare the record's type with the PDU it is in"},
    {"E-STRAY", "Octets behind the last PDU are neither padding nor a PDU.",
     "padding is zero octets to the next multiple of 8; else a length field is too small"},
    {"E-FRAGMENT", "IP fragments that cannot be put together: some are missing, or overlap.",
     "keep datagrams below the MTU, 1400 octets are safe"},
    {"W-NOT-FINITE", "A field holds NaN or infinity; receivers drop such a PDU.",
     "look in the sender for a division by zero or an unset value"},
    {"W-STATIC-MOVES",
     "The entity is dead-reckoned as static but has a velocity, acceleration or "
     "rotation.",
     "send DRM 2 to 9 for what moves, or zeros for what stands", static_moves},
    {"W-DRM", "The dead-reckoning algorithm has no name in the standard.",
     "send 0 to 9; receivers treat others as static or drop them", unknown_drm},
    {"W-SIDE", "The force ID has no name.", "send 0 to 30", unknown_force},
    {"W-KIND", "The kind of the entity type has no name.", "send 0 to 9", unknown_kind},
    {"W-DOMAIN", "The domain of the entity type has no name for its kind.",
     "send 0 to 5; 0 to 12 for munitions and supplies", unknown_domain},
    {"W-ID", "The entity ID is one that is reserved.",
     "entity 1 to 65533, site and application below 65535", reserved_id},
    {"W-LOCATION", "The location lies deep in the earth or far out in space.",
     "locations are geocentric (ECEF of WGS84) in metres, not local or geodetic", no_place},
    {"W-SIZE", "The PDU is larger than the standard allows.", "send at most 8192 octets",
     too_large},
    {"W-FAMILY", "The protocol family does not belong to the PDU type.",
     "set the family of the standard's table", wrong_family},
    {"W-TIMESTAMP-ORDER", "An entity's timestamp runs backwards.",
     "reordered on the way, or two clocks stamp one entity", back_in_time},
    {"W-TIMESTAMP-TOLERANCE",
     "A timestamp is more than 5 s from the arrival. Reported once until it is "
     "right again.",
     "synchronise clocks (NTP), or send relative timestamps; captures that were replayed show it "
     "too",
     out_of_tolerance},
    {kHeartbeatRule, "An entity was silent for more than 2.4 heartbeats of its kind and domain.",
     "send Entity States at the heartbeat, and a deactivated one at the end", missed_heartbeat},
    {kDuplicateRule, "One entity ID comes from two senders. Reported once.",
     "give each simulation its own site and application", duplicate_id},
    {"W-VELOCITY", "Velocity and positions of an entity contradict each other grossly.",
     "check units (m/s), sign, and axes: geocentric for DRM 1 to 5, body for 6 to 9",
     velocity_contradicts},
    {kTeleportRule,
     "An entity's place is farther from where its last update led than its motion can explain.",
     "placed by hand, or lost updates; else look for what the sender did at that time"},
    {kSpikeRule, "The same for a single update: the next one is back on the way.",
     "look in the sender for a value that is set before the rest, or of another frame"},
    {"W-ATTRIBUTE-ORDER", "An Attribute PDU stands before the Entity State that it extends.",
     "put Entity States first in the datagram", attribute_first},
    {"W-COUPLED",
     "An Entity State says that it is extended, but no Attribute PDU of it is in the "
     "datagram.",
     "send both in one datagram, or clear bit 3 of the PDU status", coupled_without},
    {"I-UNKNOWN-TYPE",
     "No field table for this PDU type: its octets are kept as they are. Reported once for each "
     "type.",
     "nothing to do: it is stepped over by its length"},
    {kNoLengthRule, "The length field is 0: taken as the rest of the datagram. With --lenient.",
     "the sender must write the octets of the whole PDU into it"},
    {kTrailingRule, "Octets behind the last PDU or behind its last field are kept. With --lenient.",
     "nothing to do, if they are a product's own; else a length field or a count is wrong"},
    {kForeignRule, "A datagram of another protocol: no DIS of any version. Reported once.",
     "nothing to do; a group or port of the exercise's own keeps others apart"},
    {"I-UNNAMED",
     "A number stands for something that SISO-REF-010 has no name for. Reported at an entity's "
     "first "
     "update.",
     "look it up in the sender's list of enumerations; it may be newer than ours", unnamed_value},
    {"I-BUNDLE-ORDER", "The order of the bundle is not the one that older receivers survive.",
     "Entity State, other standard types, Attribute, experimental, trailer", out_of_order},
    {kMemoryRule,
     "More entities than are remembered: the rules over several updates leave them out.",
     "check a part of the exercise at a time"},
});

}  // namespace

std::span<const CheckRule> check_rules() { return kRules; }

const CheckRule* find_check_rule(std::string_view code) {
  const auto* found = std::find_if(kRules.begin(), kRules.end(),
                                   [&](const CheckRule& rule) { return rule.code == code; });
  return found == kRules.end() ? nullptr : found;
}

std::optional<std::string> silence(const EntityMemory& memory, nanoseconds now) {
  if (memory.updates == 0 || memory.gone) return std::nullopt;
  const double heartbeat = memory.haptic ? deadreckon::kHapticHeartbeat : memory.heartbeat;
  const double quiet = pdu::to_seconds(now - memory.time);
  if (quiet <= deadreckon::timeout(heartbeat)) return std::nullopt;
  return fmt::format("{} silent for {:.3f} s, its heartbeat is {:g} s", id_text(memory.id), quiet,
                     heartbeat);
}

void remember(EntityMemory& memory, const CheckedPdu& checked) {
  const pdu::EntityState& pdu = *checked.entity_state;
  const CheckedPdu seen{checked.row,          checked.datagram,     checked.survey,
                        checked.highest_rank, checked.entity_state, &memory};
  memory.contradictions = contradiction(seen) > 0
                              ? static_cast<std::uint8_t>(std::min(memory.contradictions + 1, 255))
                              : std::uint8_t{0};
  memory.out_of_tolerance = is_out_of_tolerance(seen);
  if (memory.updates == 0 || memory.gone) {
    memory.first_time = checked.datagram.time;
    memory.first_timestamp = pdu.header.timestamp;
    memory.sender = memory.earlier_sender = checked.datagram.source;
  }
  memory.reported_duplicate =
      memory.reported_duplicate || is_duplicate(memory, checked.datagram.source);
  if (memory.sender != checked.datagram.source) {
    memory.earlier_sender = memory.sender;
    memory.sender = checked.datagram.source;
  }
  ++memory.updates;
  memory.id = pdu.entity_id;
  memory.gone = (pdu.appearance & pdu::kAppearanceDeactivated) != 0;
  memory.time = checked.datagram.time;
  memory.timestamp = pdu.header.timestamp;
  memory.heartbeat = deadreckon::nominal_heartbeat(pdu.entity_type, is_zero(pdu.linear_velocity));
  memory.frame = checked.row.frame;
  memory.pdu = checked.row.pdu;
  memory.offset = checked.row.offset;
  memory.position = position_of(pdu);
  memory.velocity = velocity_of(pdu);
}

}  // namespace reckon::tools
