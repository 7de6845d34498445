// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// THE list of PDU types with a field table, the most frequent ones first: all 72 of IEEE
// 1278.1-2012 and our own ten. A new PDU is one header and one row here (and one golden sample for
// the tests). Codec, printer, JSON, tests and bench use the list.
#pragma once

#include <cstddef>
#include <span>
#include <utility>

#include "reckon/pdu/aggregate/aggregate_state.hpp"
#include "reckon/pdu/aggregate/is_group_of.hpp"
#include "reckon/pdu/aggregate/is_part_of.hpp"
#include "reckon/pdu/aggregate/transfer_ownership.hpp"
#include "reckon/pdu/codec/codec.hpp"
#include "reckon/pdu/emission/designator.hpp"
#include "reckon/pdu/emission/electromagnetic_emission.hpp"
#include "reckon/pdu/emission/iff.hpp"
#include "reckon/pdu/emission/supplemental_emission_entity_state.hpp"
#include "reckon/pdu/emission/underwater_acoustic.hpp"
#include "reckon/pdu/entity/attribute.hpp"
#include "reckon/pdu/entity/collision.hpp"
#include "reckon/pdu/entity/collision_elastic.hpp"
#include "reckon/pdu/entity/entity_state.hpp"
#include "reckon/pdu/entity/entity_state_update.hpp"
#include "reckon/pdu/environment/areal_object_state.hpp"
#include "reckon/pdu/environment/environmental_process.hpp"
#include "reckon/pdu/environment/gridded_data.hpp"
#include "reckon/pdu/environment/linear_object_state.hpp"
#include "reckon/pdu/environment/point_object_state.hpp"
#include "reckon/pdu/information_operations/action.hpp"
#include "reckon/pdu/information_operations/report.hpp"
#include "reckon/pdu/live_entity/appearance.hpp"
#include "reckon/pdu/live_entity/articulated_parts.hpp"
#include "reckon/pdu/live_entity/le_detonation.hpp"
#include "reckon/pdu/live_entity/le_fire.hpp"
#include "reckon/pdu/live_entity/tspi.hpp"
#include "reckon/pdu/logistics/repair_complete.hpp"
#include "reckon/pdu/logistics/repair_response.hpp"
#include "reckon/pdu/logistics/resupply_cancel.hpp"
#include "reckon/pdu/logistics/resupply_offer.hpp"
#include "reckon/pdu/logistics/resupply_received.hpp"
#include "reckon/pdu/logistics/service_request.hpp"
#include "reckon/pdu/management/acknowledge.hpp"
#include "reckon/pdu/management/action_request.hpp"
#include "reckon/pdu/management/action_response.hpp"
#include "reckon/pdu/management/comment.hpp"
#include "reckon/pdu/management/data.hpp"
#include "reckon/pdu/management/data_query.hpp"
#include "reckon/pdu/management/entity_request.hpp"
#include "reckon/pdu/management/event_report.hpp"
#include "reckon/pdu/management/record_query_r.hpp"
#include "reckon/pdu/management/record_r.hpp"
#include "reckon/pdu/management/set_data.hpp"
#include "reckon/pdu/management/set_record_r.hpp"
#include "reckon/pdu/management/start_resume.hpp"
#include "reckon/pdu/management/stop_freeze.hpp"
#include "reckon/pdu/minefield/minefield_data.hpp"
#include "reckon/pdu/minefield/minefield_query.hpp"
#include "reckon/pdu/minefield/minefield_response_nack.hpp"
#include "reckon/pdu/minefield/minefield_state.hpp"
#include "reckon/pdu/radio/intercom_control.hpp"
#include "reckon/pdu/radio/receiver.hpp"
#include "reckon/pdu/radio/signal.hpp"
#include "reckon/pdu/radio/transmitter.hpp"
#include "reckon/pdu/reckon/assured_record.hpp"
#include "reckon/pdu/reckon/cell_membership.hpp"
#include "reckon/pdu/reckon/cell_roles.hpp"
#include "reckon/pdu/reckon/cell_snapshot.hpp"
#include "reckon/pdu/reckon/compressed_states.hpp"
#include "reckon/pdu/reckon/datagram_trailer.hpp"
#include "reckon/pdu/reckon/group_map.hpp"
#include "reckon/pdu/reckon/peers_heard.hpp"
#include "reckon/pdu/reckon/presence_pdu.hpp"
#include "reckon/pdu/reckon/time_exchange.hpp"
#include "reckon/pdu/reckon/unicast_frame.hpp"
#include "reckon/pdu/warfare/detonation.hpp"
#include "reckon/pdu/warfare/directed_energy_fire.hpp"
#include "reckon/pdu/warfare/entity_damage_status.hpp"
#include "reckon/pdu/warfare/fire.hpp"

namespace reckon::pdu {

template <typename... T>
struct TypeList {
  static constexpr std::size_t kSize = sizeof...(T);
};

// One row a type, so that a new one is one line.
// clang-format off
using PduTypes = TypeList<
    EntityState,
    Attribute,
    Fire,
    Detonation,
    EntityStateUpdate,
    Transmitter,
    Signal,
    Receiver,
    EnvironmentalProcess,
    ElectromagneticEmission,
    Iff,
    Designator,
    CollisionElastic,
    Collision,
    StartResume,
    StopFreeze,
    Acknowledge,
    CreateEntity,
    RemoveEntity,
    Data,
    Comment,
    ActionRequest,
    ActionResponse,
    DataQuery,
    SetData,
    EventReport,
    IntercomSignal,
    IntercomControl,
    CreateEntityR,
    RemoveEntityR,
    StartResumeR,
    StopFreezeR,
    AcknowledgeR,
    ActionRequestR,
    ActionResponseR,
    DataQueryR,
    SetDataR,
    DataR,
    EventReportR,
    CommentR,
    RecordR,
    SetRecordR,
    RecordQueryR,
    GriddedData,
    PointObjectState,
    LinearObjectState,
    ArealObjectState,
    UnderwaterAcoustic,
    SupplementalEmissionEntityState,
    ServiceRequest,
    ResupplyOffer,
    ResupplyReceived,
    ResupplyCancel,
    RepairComplete,
    RepairResponse,
    DirectedEnergyFire,
    EntityDamageStatus,
    AggregateState,
    IsGroupOf,
    TransferOwnership,
    IsPartOf,
    MinefieldState,
    MinefieldQuery,
    MinefieldData,
    MinefieldResponseNack,
    Tspi,
    Appearance,
    ArticulatedParts,
    LeFire,
    LeDetonation,
    InformationOperationsAction,
    InformationOperationsReport,
    Presence,
    DatagramTrailer,
    CellMembership,
    TimeExchange,
    PeersHeard,
    CellRoles,
    GroupMap,
    CellSnapshot,
    UnicastFrame,
    CompressedStates,
    AssuredRecord>;
// clang-format on

/// Whether the list has the type.
template <typename... T>
[[nodiscard]] constexpr bool is_listed(PduType type, TypeList<T...>) noexcept {
  return ((T::kPduType == type) || ...);
}
[[nodiscard]] constexpr bool is_listed(PduType type) noexcept {
  return is_listed(type, PduTypes{});
}

/// Decodes `bytes` (one PDU or longer) as the type in its header and calls `f(const T&)`. On any
/// error `f` is not called. unknown_type: the type is not in the list, and the caller may keep the
/// octets.
template <typename F, typename... T>
[[nodiscard]] DecodeError visit(std::span<const std::byte> bytes, const PduHeader& header, F&& f,
                                TypeList<T...>) {
  DecodeError error = DecodeError::unknown_type;
  const auto attempt = [&]<typename Candidate>(std::type_identity<Candidate>) {
    if (Candidate::kPduType != header.pdu_type) return false;
    Candidate pdu;
    error = decode(bytes, pdu);
    if (error == DecodeError::none) f(std::as_const(pdu));
    return true;
  };
  static_cast<void>((attempt(std::type_identity<T>{}) || ...));
  return error;
}
template <typename F>
[[nodiscard]] DecodeError visit(std::span<const std::byte> bytes, const PduHeader& header, F&& f) {
  return visit(bytes, header, std::forward<F>(f), PduTypes{});
}

}  // namespace reckon::pdu
