// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Descriptor of a Fire or Detonation PDU: a munition, an expendable, or another object that
// explodes.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>

#include "reckon/pdu/codec/codec.hpp"
#include "reckon/pdu/codec/records.hpp"

namespace reckon::pdu {

/// The 16 octets of every kind. Visitors that only inspect a PDU get the record of its kind.
struct MunitionDescriptor {
  EntityType munition_type;
  std::uint16_t warhead = 0;
  std::uint16_t fuse = 0;
  std::uint16_t quantity = 0;
  std::uint16_t rate = 0;  ///< [1/min]
};
static_assert(kFixedSize<MunitionDescriptor> == 16);

/// Chaff, flares and the like.
struct ExpendableDescriptor {
  EntityType expendable_type;
  std::uint64_t padding = 0;
};
static_assert(kFixedSize<ExpendableDescriptor> == kFixedSize<MunitionDescriptor>);

/// An exploding object that is no munition.
struct ExplosionDescriptor {
  EntityType exploding_object_type;
  std::uint16_t explosive_material = 0;
  std::uint16_t padding = 0;
  float explosive_force = 0.0F;  ///< equivalent mass of TNT [kg]
};
static_assert(kFixedSize<ExplosionDescriptor> == kFixedSize<MunitionDescriptor>);

/// Kind of a descriptor, from the PDU status of DIS 7; before DIS 7 always a munition.
enum class DescriptorKind : std::uint8_t { munition = 0, expendable = 1, explosion = 2 };

[[nodiscard]] constexpr DescriptorKind descriptor_kind(const PduHeader& header) noexcept {
  if (is_before_dis7(header)) return DescriptorKind::munition;
  const unsigned mask = header.pdu_type == PduType::fire ? 1U : 3U;
  return static_cast<DescriptorKind>((header.pdu_status >> 4U) & mask);
}

/// Shows the octets of a descriptor as another record of the same size.
template <typename Record, typename Visitor>
void show_descriptor_as(Visitor& visitor, const MunitionDescriptor& descriptor) {
  std::array<std::byte, kFixedSize<MunitionDescriptor>> octets{};
  Record record;
  if (store_record(descriptor, octets) == 0 || !load_record(std::span(octets), record)) return;
  visitor("descriptor", std::as_const(record));
}

/// Visits the descriptor of a Fire or Detonation PDU; visitors that only inspect get the record of
/// its kind.
template <typename Visitor, typename Pdu>
constexpr void descriptor_field(Visitor& visitor, Pdu& pdu) {
  if constexpr (Looks<Visitor, Pdu>) {
    const DescriptorKind kind = descriptor_kind(pdu.header);
    if (kind == DescriptorKind::expendable)
      return show_descriptor_as<ExpendableDescriptor>(visitor, pdu.descriptor);
    if (kind == DescriptorKind::explosion)
      return show_descriptor_as<ExplosionDescriptor>(visitor, pdu.descriptor);
  }
  visitor("descriptor", pdu.descriptor);
}

}  // namespace reckon::pdu
