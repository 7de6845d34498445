// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Classes of entities for an HLA federate, by the entity types of SISO-REF-010.
#pragma once

#include "reckon/pdu/codec/records.hpp"

namespace reckon::peer {

/// Entities whose type begins like this one: zeros at the end match anything.
///
///   EntityClass{}                                                   // every entity
///   EntityClass{{pdu::EntityKind::platform}}                        // every platform
///   EntityClass{{pdu::EntityKind::platform, pdu::EntityDomain::land, 225}}
struct EntityClass {
  pdu::EntityType type{};

  /// Whether an entity of type `other` belongs to it.
  [[nodiscard]] bool contains(const pdu::EntityType& other) const noexcept;
  friend constexpr bool operator==(const EntityClass&, const EntityClass&) = default;
};

}  // namespace reckon::peer
