// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/tools/inspect/check/rules.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "reckon/aoim/groups/peer_id.hpp"
#include "reckon/deadreckon/sending/update_policy.hpp"
#include "reckon/deadreckon/wire_conversion.hpp"
#include "reckon/pdu/pdu_types.hpp"
#include "reckon/pdu/seconds.hpp"
#include "reckon/pdu/timestamp.hpp"
#include "reckon/tools/datagrams/foreign.hpp"
#include "reckon/tools/inspect/check/enumeration_rules.hpp"
#include "reckon/tools/inspect/check/motion_rules.hpp"
#include "reckon/tools/inspect/output/format.hpp"

namespace reckon::tools {
namespace {

using std::chrono::nanoseconds;
using Fault = std::optional<RuleFault>;

// Offsets of fields in an Entity State.
constexpr std::size_t kStatusAt = 10;
constexpr std::size_t kIdAt = 12;

constexpr std::size_t kLargestPdu = 8192;  // octets, MAX_PDU_SIZE of the standard
constexpr double kDeepest = 6.34e6;        // polar radius less the deepest sea [m]

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
  const pdu::WorldCoordinates& at = checked.entity_state->location;
  const double radius = Eigen::Vector3d(at.x, at.y, at.z).norm();
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
  return RuleFault{3, fmt::format("protocol_family is {}, but this type has {}",
                                  static_cast<unsigned>(checked.row.header.protocol_family),
                                  static_cast<unsigned>(expected))};
}

Fault back_in_time(const CheckedPdu& checked) {
  if (!checked.has_history()) return std::nullopt;
  const std::uint32_t now = checked.row.header.timestamp;
  if (pdu::is_absolute(now) != pdu::is_absolute(checked.memory->timestamp)) return std::nullopt;
  const nanoseconds step = pdu::difference(now, checked.memory->timestamp);
  if (step >= nanoseconds::zero()) return std::nullopt;
  return RuleFault{4, fmt::format("timestamp is {:.6f} s before the one of frame {}",
                                  -pdu::to_seconds(step), checked.memory->frame)};
}

Fault missed_heartbeat(const CheckedPdu& checked) {
  if (!checked.has_history()) return std::nullopt;
  auto clause = silence(*checked.memory, checked.datagram.time);
  if (!clause.has_value()) return std::nullopt;
  return RuleFault{0, std::move(*clause)};
}

/// Whether two senders use one entity. A different address counts at once. The same address with
/// another port counts only when the first port returns, because a restarted program also has a new
/// port.
bool is_duplicate(const EntityMemory& memory, const peer::IpEndpoint& sender) {
  if (memory.reported_duplicate || sender == memory.sender) return false;
  return sender.octets != memory.sender.octets || sender == memory.earlier_sender;
}

std::uint64_t key_of(const CheckedPdu& checked) {
  return entity_key(checked.row.header.exercise_id, checked.entity_state->entity_id);
}

/// Version of the ownership of a body of a scene; 0 of other entities.
std::uint64_t ownership_of(const CheckedPdu& checked) {
  const pdu::OwnershipRecord* owner = checked.survey.owner_of(key_of(checked));
  return owner == nullptr ? 0 : owner->version;
}

/// Whether the entity may have another sender than before.
bool begins_anew(const EntityMemory& memory, const CheckedPdu& checked) {
  return memory.updates == 0 || memory.gone || ownership_of(checked) > memory.ownership;
}

Fault wrong_owner(const CheckedPdu& checked) {
  if (checked.entity_state == nullptr ||
      checked.entity_state->entity_id.simulation() != aoim::kSceneId || checked.survey.epoch == 0)
    return std::nullopt;
  const pdu::OwnershipRecord* owner = checked.survey.owner_of(key_of(checked));
  if (owner == nullptr)
    return RuleFault{kIdAt, fmt::format("this datagram has no Ownership Record for {}",
                                        id_text(checked.entity_state->entity_id))};
  if (owner->owner == checked.survey.epoch) return std::nullopt;
  return RuleFault{kIdAt, fmt::format("its owner is {:08x}, its sender is {:08x}", owner->owner,
                                      checked.survey.epoch)};
}

Fault duplicate_id(const CheckedPdu& checked) {
  if (!checked.has_history() || begins_anew(*checked.memory, checked) ||
      !is_duplicate(*checked.memory, checked.datagram.source))
    return std::nullopt;
  return RuleFault{
      kIdAt, fmt::format("{} comes from {} and from {}", id_text(checked.entity_state->entity_id),
                         checked.memory->sender.text(), checked.datagram.source.text())};
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
                   fmt::format("CEI is set, but this datagram has no Attribute PDU for {}",
                               id_text(checked.entity_state->entity_id))};
}

Fault out_of_order(const CheckedPdu& checked) {
  if (!checked.row.has_header ||
      pdu::bundle_rank(checked.row.header.pdu_type) >= checked.highest_rank)
    return std::nullopt;
  return RuleFault{2, fmt::format("{} follows a PDU that must come after it", checked.row.type())};
}

/// THE rules.
constexpr auto kRules = std::to_array<CheckRule>({
    {"E-TRUNCATED", "The datagram ends before the PDU does.",
     "capture whole frames (tcpdump -s 0); otherwise the sender's length field is wrong"},
    {"E-LENGTH", "The length field is too small for a PDU of this type.",
     "the sender must write the octets of the whole PDU, header included; --lenient reads those of "
     "length 0"},
    {kByteOrderRule, "The length field is correct if its two octets are swapped.",
     "the sender writes little-endian: every field of DIS is big-endian (htons, htonl, as for "
     "network order)"},
    {"E-COUNT", "The record count exceeds the octets left in the PDU.",
     "compare the sender's record count with its records"},
    {"E-RECORD", "A record's length is too small or runs past the end of the PDU.",
     "a record's length includes its own header and padding"},
    {"E-VERSION", "The protocol or record version is not supported.",
     "set the sender to DIS 5, 6 or 7"},
    {"E-TYPE", "The type of a record does not fit its position.",
     "compare the record's type with its PDU"},
    {"E-STRAY", "Octets after the last PDU are neither padding nor a PDU.",
     "padding is zero octets to the next multiple of 8; otherwise a length field is too small"},
    {"E-FRAGMENT", "IP fragments cannot be reassembled: some are missing, or overlap.",
     "keep datagrams below the MTU, 1400 octets are safe"},
    {"W-NOT-FINITE", "A field holds NaN or infinity; receivers drop such a PDU.",
     "look in the sender for a division by zero or an unset value"},
    {kTrailingWarning, "Octets within the PDU's length follow its last field.",
     "correct the named count or length; --lenient keeps vendor octets"},
    {"W-STATIC-MOVES",
     "The entity is dead-reckoned as static but has a velocity, acceleration or "
     "rotation.",
     "send DRM 2 to 9 for moving entities, or zeros for fixed ones", static_moves},
    {"W-DRM", "The dead-reckoning algorithm has no name in the standard.",
     "send 0 to 9; receivers treat others as static or drop them", unknown_drm},
    {"W-SIDE", "The force ID has no name.", "send 0 to 30", unknown_force},
    {"W-KIND", "The kind of the entity type has no name.", "send 0 to 9", unknown_kind},
    {"W-DOMAIN", "The domain of the entity type has no name for its kind.",
     "send 0 to 5; 0 to 12 for munitions and supplies", unknown_domain},
    {"W-ID", "The entity ID is reserved.", "entity 1 to 65533, site and application below 65535",
     reserved_id},
    {"W-LOCATION", "The location is deep in the earth or far out in space.",
     "locations are geocentric (ECEF of WGS84) in metres, not local or geodetic", no_place},
    {"W-SIZE", "The PDU is larger than the standard allows.", "send at most 8192 octets",
     too_large},
    {"W-FAMILY", "The protocol family does not belong to the PDU type.",
     "set the family of the standard's table", wrong_family},
    {"W-TIMESTAMP-ORDER", "An entity's timestamp runs backwards.",
     "reordered on the way, or two clocks stamp one entity", back_in_time},
    {kStampStillRule,
     "An entity's timestamp does not advance while updates arrive. Reported once until it does.",
     "set the timestamp of each PDU before it is sent; receivers cannot extrapolate with a "
     "constant one"},
    {kStampPaceRule,
     "An entity's timestamps do not count the time past the hour. Reported once until they are "
     "correct again.",
     "count units of 3600 s / 2^31 (1.676 us), shifted left by one bit; set bit 0 only in absolute "
     "ones; captures replayed at another rate also break this rule"},
    {kToleranceRule,
     "A timestamp is more than 5 s from the arrival. Reported once until it is correct again.",
     "synchronise clocks (NTP), or send relative timestamps; replayed captures also break this "
     "rule"},
    {kHeartbeatRule, "An entity was silent for more than 2.4 heartbeats of its kind and domain.",
     "send Entity States at the heartbeat, and a deactivated one at the end", missed_heartbeat},
    {kDuplicateRule, "Two senders use one entity ID. Reported once.",
     "give each simulation its own site and application", duplicate_id},
    {"W-VELOCITY", "Velocity and positions of an entity contradict each other grossly.",
     "check units (m/s), sign, and axes: geocentric for DRM 1 to 5, body for 6 to 9",
     velocity_contradicts},
    {"W-ORIENTATION",
     "An angle is out of its range (reported once an entity), or the orientation contradicts the "
     "turn rate grossly.",
     "psi and phi lie within -pi to pi, theta within -pi/2 to pi/2, in radians; the turn rate is "
     "in "
     "rad/s about body axes",
     wrong_orientation},
    {"W-FLOAT64", "The value of an articulated part looks like a float64.",
     "write parameter_value as a float32 of 4 octets, and 4 octets of zeros behind it",
     float64_parameter},
    {kTeleportRule, "An entity is farther from its predicted position than its motion can explain.",
     "it was repositioned, or updates were lost; otherwise examine the sender at that time"},
    {kSpikeRule, "The same for a single update: the next one returns to the path.",
     "look in the sender for a value that is set before the others, or in another frame"},
    {"W-ATTRIBUTE-ORDER", "An Attribute PDU precedes the Entity State that it extends.",
     "put Entity States first in the datagram", attribute_first},
    {"W-COUPLED",
     "An Entity State is marked as extended, but its datagram has no Attribute PDU for it.",
     "send both in one datagram, or clear bit 3 of the PDU status", coupled_without},
    {"W-OWNER", "A body of a scene comes without its Ownership Record, or not from its owner.",
     "send the record in the same datagram; only the owner sends a body", wrong_owner},
    {"I-UNKNOWN-TYPE",
     "No field table for this PDU type: its octets are kept unchanged. Reported once for each "
     "type.",
     "no action: its length field is used to skip it"},
    {kNoLengthRule, "The length field is 0: the rest of the datagram is used. With --lenient.",
     "the sender must write the octets of the whole PDU into it"},
    {kTrailingRule, "Octets after the last PDU or its last field are kept. With --lenient.",
     "no action for vendor octets; otherwise a length field or a count is wrong"},
    {kForeignRule, "A datagram of another protocol, not DIS. Reported once.",
     "no action; use a separate group or port for the exercise"},
    {kCopiesRule, "The same sender repeats the same octets within 5 ms. Reported once, at the end.",
     "capture on one interface (not any) or in one direction (tcpdump -Q in); editcap -w 0.005 IN "
     "OUT removes copies from a file"},
    {"I-UNNAMED", "A number has no name in SISO-REF-010. Reported at an entity's first update.",
     "look it up in the sender's enumerations, which may be newer", unnamed_value},
    {"I-BUNDLE-ORDER", "Older receivers may fail on the order of this bundle.",
     "Entity State, other standard types, Attribute, experimental, trailer", out_of_order},
    {kMemoryRule, "More entities than the table holds: rules over several updates omit the excess.",
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
  remember_motion(memory, checked);
  if (begins_anew(memory, checked)) memory.sender = memory.earlier_sender = checked.datagram.source;
  memory.reported_duplicate =
      memory.reported_duplicate || is_duplicate(memory, checked.datagram.source);
  if (memory.sender != checked.datagram.source) {
    memory.earlier_sender = memory.sender;
    memory.sender = checked.datagram.source;
  }
  ++memory.updates;
  memory.ownership = ownership_of(checked);
  memory.id = pdu.entity_id;
  memory.gone = (pdu.appearance & pdu::kAppearanceDeactivated) != 0;
  memory.time = checked.datagram.time;
  memory.timestamp = pdu.header.timestamp;
  const pdu::Vector3Float& v = pdu.linear_velocity;
  memory.heartbeat =
      deadreckon::nominal_heartbeat(pdu.entity_type, v.x == 0 && v.y == 0 && v.z == 0);
  memory.frame = checked.row.frame;
  memory.pdu = checked.row.pdu;
  memory.offset = checked.row.offset;
}

}  // namespace reckon::tools
