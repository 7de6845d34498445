// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Contents of Assured Records (PDU 150) that agree on the owners of objects. Each head is followed
// by records of its count. The protocol is src/ownership.
#pragma once

#include <array>
#include <cstdint>

#include "reckon/pdu/codec/codec.hpp"
#include "reckon/pdu/codec/records.hpp"

namespace reckon::pdu {

/// Bits of objects: bit i of octet k is object 8 k + i.
using ObjectBits = std::array<std::uint8_t, 32>;

inline constexpr std::uint8_t kRoundDecided = 1, kRoundActive = 2, kRoundLease = 4,
                              kRoundLeaves = 8, kRoundYields = 16, kRoundFollows = 32;

/// Kind 16. `count` octets follow: the last round of each voter from `first` on.
struct OwnershipRound {
  std::uint32_t founded = 0, founder = 0;
  std::uint32_t act = 0, hash = 0, table = 0;
  std::uint8_t round = 0;
  std::uint8_t flags = 0;  ///< kRound..
  std::uint8_t first = 0, count = 0;
};
static_assert(kFixedSize<OwnershipRound> == 24);

/// Kind 17. `voters` OwnershipVoters and `removed` epochs follow.
struct OwnershipProposal {
  std::uint32_t founded = 0, founder = 0;
  std::uint32_t act = 0, chair = 0;
  std::uint32_t attempt = 0, proposer = 0, accepted_attempt = 0, accepted_proposer = 0;
  std::uint32_t digest = 0;
  std::uint8_t phase = 0;  ///< 0 prepare, 1 promise, 2 propose, 3 decided
  std::uint8_t voters = 0, removed = 0;
  std::uint8_t padding = 0;
  ObjectBits given{};
};
static_assert(kFixedSize<OwnershipProposal> == 72);

struct OwnershipVoter {
  std::uint32_t epoch = 0;
  std::uint32_t host = 0;  ///< below 64
};
static_assert(kFixedSize<OwnershipVoter> == 8);

/// Kind 18.
struct OwnershipVote {
  std::uint32_t founded = 0, founder = 0;
  std::uint32_t act = 0, attempt = 0, proposer = 0;
};
static_assert(kFixedSize<OwnershipVote> == 20);

inline constexpr std::uint16_t kTableAsks = 1;

/// Kind 19. `count` OwnershipHoldings follow.
struct OwnershipTable {
  std::uint32_t founded = 0, founder = 0;
  std::uint32_t serial = 0;
  std::uint32_t act = 0;
  std::uint16_t flags = 0;  ///< kTableAsks
  std::uint16_t count = 0;
};
static_assert(kFixedSize<OwnershipTable> == 20);

struct OwnershipHolding {
  std::uint16_t object = 0, padding = 0;
  std::uint32_t owner = 0;  ///< epoch; 0: nobody
  std::uint64_t version = 0;
};
static_assert(kFixedSize<OwnershipHolding> == 16);

/// Kind 20.
struct OwnershipAgreement {
  std::uint32_t founded = 0, founder = 0;
  std::uint32_t serial = 0;
  ObjectBits objects{};
};
static_assert(kFixedSize<OwnershipAgreement> == 44);

/// Identifier of the record set in Transfer Ownership PDUs between peers: "HAP", 5.
inline constexpr std::uint32_t kTransferRecordType = 0x48415005;
/// Values of TransferOwnership::transfer_type. SISO-REF-010 UID 224.
inline constexpr std::uint8_t kTransferPush = 1, kTransferPull = 2, kTransferCancel = 7;

/// In a pull or its cancellation.
struct TransferRequest {
  std::uint32_t founded = 0, founder = 0;
  ObjectBits objects{};
};
static_assert(kFixedSize<TransferRequest> == 40);

/// In a push. `count` TransferStates follow.
inline constexpr std::uint16_t kGrantPushed = 1;

struct TransferGrant {
  std::uint32_t founded = 0, founder = 0;
  std::uint32_t to = 0;        ///< epoch
  std::uint32_t lease_ms = 0;  ///< remainder of the lease [ms]
  std::uint8_t round = 0;
  std::uint8_t count = 0;
  std::uint16_t flags = 0;  ///< kGrantPushed
  std::uint32_t padding = 0;
  ObjectBits objects{};
};
static_assert(kFixedSize<TransferGrant> == 56);

/// An object with its new version, and its state in the scene's frame.
struct TransferState {
  OwnershipHolding holding;
  std::uint64_t utc = 0;  ///< [ns] since 1970
  WorldCoordinates position;
  double w = 1.0, x = 0.0, y = 0.0, z = 0.0;  ///< orientation, from the object's axes to the scene
  WorldCoordinates velocity, turn_rate;       ///< [m/s], [rad/s]
  WorldCoordinates acceleration;              ///< [m/s^2]
};
static_assert(kFixedSize<TransferState> == 152);

}  // namespace reckon::pdu
