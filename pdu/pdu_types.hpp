// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// THE list of PDU types with a field table, those of daily traffic first: all 72 of IEEE
// 1278.1-2012 and our own four. A new PDU is one header and one row here (and one golden sample
// for the tests); codec, printer, JSON, tests and bench follow from it.
#pragma once

#include <cstddef>
#include <span>
#include <utility>

#include "pdu/acknowledge.hpp"
#include "pdu/action_request.hpp"
#include "pdu/action_response.hpp"
#include "pdu/aggregate_state.hpp"
#include "pdu/appearance.hpp"
#include "pdu/areal_object_state.hpp"
#include "pdu/articulated_parts.hpp"
#include "pdu/attribute.hpp"
#include "pdu/cell_membership.hpp"
#include "pdu/codec.hpp"
#include "pdu/collision.hpp"
#include "pdu/collision_elastic.hpp"
#include "pdu/comment.hpp"
#include "pdu/data.hpp"
#include "pdu/data_query.hpp"
#include "pdu/datagram_trailer.hpp"
#include "pdu/designator.hpp"
#include "pdu/detonation.hpp"
#include "pdu/directed_energy_fire.hpp"
#include "pdu/electromagnetic_emission.hpp"
#include "pdu/entity_damage_status.hpp"
#include "pdu/entity_request.hpp"
#include "pdu/entity_state.hpp"
#include "pdu/entity_state_update.hpp"
#include "pdu/environmental_process.hpp"
#include "pdu/event_report.hpp"
#include "pdu/fire.hpp"
#include "pdu/gridded_data.hpp"
#include "pdu/iff.hpp"
#include "pdu/information_operations_action.hpp"
#include "pdu/information_operations_report.hpp"
#include "pdu/intercom_control.hpp"
#include "pdu/is_group_of.hpp"
#include "pdu/is_part_of.hpp"
#include "pdu/le_detonation.hpp"
#include "pdu/le_fire.hpp"
#include "pdu/linear_object_state.hpp"
#include "pdu/minefield_data.hpp"
#include "pdu/minefield_query.hpp"
#include "pdu/minefield_response_nack.hpp"
#include "pdu/minefield_state.hpp"
#include "pdu/point_object_state.hpp"
#include "pdu/presence.hpp"
#include "pdu/receiver.hpp"
#include "pdu/record_query_r.hpp"
#include "pdu/record_r.hpp"
#include "pdu/repair_complete.hpp"
#include "pdu/repair_response.hpp"
#include "pdu/resupply_cancel.hpp"
#include "pdu/resupply_offer.hpp"
#include "pdu/resupply_received.hpp"
#include "pdu/service_request.hpp"
#include "pdu/set_data.hpp"
#include "pdu/set_record_r.hpp"
#include "pdu/signal.hpp"
#include "pdu/start_resume.hpp"
#include "pdu/stop_freeze.hpp"
#include "pdu/supplemental_emission_entity_state.hpp"
#include "pdu/time_exchange.hpp"
#include "pdu/transfer_ownership.hpp"
#include "pdu/transmitter.hpp"
#include "pdu/tspi.hpp"
#include "pdu/underwater_acoustic.hpp"

namespace reckon::pdu {

template <typename... T>
struct TypeList {
  static constexpr std::size_t kSize = sizeof...(T);
};

// One row a type, so that a new one is a line of its own.
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
    TimeExchange>;
// clang-format on

/// True where the list holds the type.
template <typename... T>
[[nodiscard]] constexpr bool is_listed(PduType type, TypeList<T...>) noexcept {
  return ((T::kPduType == type) || ...);
}
[[nodiscard]] constexpr bool is_listed(PduType type) noexcept {
  return is_listed(type, PduTypes{});
}

/// Decodes `bytes` (one PDU or longer) as the type its header names and calls `f(const T&)`; on any
/// error `f` is not called. unknown_type: not in the list, the octets are the caller's to keep.
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
