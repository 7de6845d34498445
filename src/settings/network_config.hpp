// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Address and manner of sending, and the senders that a peer obeys and feels.
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "reckon/pdu/codec/enumerations.hpp"
#include "reckon/pdu/codec/records.hpp"
#include "reckon/peer/network/link.hpp"
#include "reckon/peer/network/unicast_peers.hpp"
#include "reckon/peer/settings/management_rule.hpp"
#include "reckon/peer/settings/touch_rule.hpp"

namespace reckon::peer {

/// How long updates wait for a bundle: time-out, quorum or both (hybrid). New and felt updates
/// never wait.
struct BundlePolicy {
  /// Time-out: longest wait of a pose, 0 .. 1 s; with a quorum, the longest time-out leaves only
  /// the quorum.
  std::chrono::nanoseconds hold{0};
  std::uint32_t updates = 0;  ///< quorum: this many are sent together; 0 = only by size
};

/// The policy of the entities of one type.
struct BundleClass {
  pdu::EntityType type{};  ///< 0 matches any number
  BundlePolicy policy;
};

/// Address and manner of sending.
struct NetworkConfig {
  GroupAddress group = GroupAddress::v4(0xEFC00100, 3000);  ///< base group; the pool follows it
  bool interop = false;           ///< plain DIS to the base group, no Reckon trailer
  bool lenient = false;           ///< with interop: a length field of 0 is read as the rest
  std::uint8_t exercise = 1;      ///< DIS exercise ID
  bool exercise_named = false;    ///< whether the file gives it; set by the reader
  std::uint8_t ttl = 1;           ///< hops; 1 = this LAN
  std::size_t bundle_max = 1288;  ///< [octets] of a datagram's payload
  /// [1/s] datagrams in one group, from all peers; the receive buffer holds 50 ms of them.
  std::size_t rate = 20'000;
  bool offload = true;  ///< the kernel segments and coalesces runs of datagrams, if it can
  BundlePolicy bundle;  ///< of updates that match no class
  std::vector<BundleClass> bundle_classes;  ///< the first match applies
  /// Form of sent Entity States; the peers of a scene must have the same.
  pdu::CompressedForm compression = pdu::CompressedForm::none;
  std::string iface;  ///< interface name or address; empty = chosen by the documented rule
  std::filesystem::path
      key;  ///< key file of a sealed exercise; absolute once loaded; empty = plain
  /// Recipients of each datagram without multicast, see FanOutLink; empty: groups.
  std::vector<NamedPeer> peers;
  /// Most remote entities, 1 .. kMostEntities. Address space is reserved for all; some 1 kB each is
  /// used once they are there. Further ones are counted and not shown.
  std::size_t entities = 100'000;
  static constexpr std::size_t kMostEntities = 1'000'000;
  /// Memory limit [octets] for the entities of plain DIS programs
  std::size_t strangers_memory = std::size_t{32} << 20;
  ManagementRule management;       ///< senders whose Stop/Freeze and Start/Resume are obeyed
  std::optional<TouchRule> touch;  ///< as in the scene, see touch_rule()

  /// The owners whose force models and bodies are felt.
  [[nodiscard]] TouchRule touch_rule() const { return touch.value_or(TouchRule::usual(interop)); }
};

/// The policy of the entities of this type. Some ns for each class.
[[nodiscard]] const BundlePolicy& bundle_policy_of(const NetworkConfig& network,
                                                   const pdu::EntityType& type) noexcept;

}  // namespace reckon::peer
