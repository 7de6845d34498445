// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Tunables of the presence protocol, and the times that follow from several of them.
#pragma once

#include <chrono>
#include <cstddef>

#include "reckon/aoim/presence/life_chain.hpp"

namespace reckon::aoim {

/// Tunables of the presence protocol; all times > 0.
struct PresenceConfig {
  std::chrono::nanoseconds heartbeat = std::chrono::seconds(1);
  /// Number of consecutive missed announcements after which a peer has timed out; default 6. At 20
  /// % loss three in a row are lost every two minutes, six every four hours.
  int missed = 6;
  /// Shortest time between two announcements of a peer, so that many newcomers cause no storm;
  /// default 100 ms. It is also the tolerance for the last missed announcement.
  std::chrono::nanoseconds minimum_gap = std::chrono::milliseconds(100);
  /// After a start or a newcomer a peer repeats its announcement after `brisk_gap`, twice that and
  /// so on up to half a heartbeat. It stops when all received peers list it, or after `brisk`. At
  /// 20 % loss all peers know each other within 2 s, and without loss nothing is sent twice. In a
  /// dispute, or with a new ID, it repeats every `brisk_gap` during `brisk`.
  std::chrono::nanoseconds brisk_gap = std::chrono::milliseconds(150);
  std::chrono::nanoseconds brisk = std::chrono::milliseconds(1500);
  /// A new epoch with the ID of a live peer is a restart if the old epoch is silent for this time.
  /// If the old epoch has just begun, as in a race for the ID, the time is `race_wait`.
  std::chrono::nanoseconds restart_wait = std::chrono::milliseconds(500);
  std::chrono::nanoseconds race_wait = std::chrono::milliseconds(800);
  /// A peer that has lost its ID listens for this time before it draws another, to learn the free
  /// ones.
  std::chrono::nanoseconds listen = std::chrono::milliseconds(100);
  /// A peer that has held its ID for this time is established and gives way to no newcomer.
  std::chrono::nanoseconds established = std::chrono::seconds(2);
  /// Two established peers with one ID, as after a partition, count their witnesses after this
  /// time, or after half of it if all witnesses have sent a list.
  std::chrono::nanoseconds dispute = std::chrono::milliseconds(2500);
  /// A peer that has proved no address, and an ended epoch without proofs, may continue at another
  /// address after this time.
  std::chrono::nanoseconds pin = std::chrono::seconds(3);
  /// An epoch that proves its identity takes its ID back if it was silent for no longer than this.
  std::chrono::nanoseconds take_back = std::chrono::seconds(30);
  /// One-way function of the proofs of identity; null: no proofs, and epochs keep their address.
  OneWay one_way = nullptr;
  /// Hash function of the proofs of addresses; null: no epoch proves its address.
  KeyedHash keyed_hash = nullptr;
  ChainLink secret{};  ///< of this epoch, random
  /// Silence after which a peer is reported as quiet.
  std::chrono::nanoseconds quiet = std::chrono::milliseconds(2500);
  /// Peers received within this time are in our Peers Heard list.
  std::chrono::nanoseconds listed = std::chrono::milliseconds(1750);
  /// Capacity of the peer table; default 1,024. Further peers are counted and not joined, unless a
  /// row can be dropped whose peer announced itself once and was silent since, or has never sent a
  /// list.
  std::size_t capacity = 1024;
  /// Most peers of one address and port, that is of one process; default 64, as a replayed exercise
  /// may have. Most peers of one address: half of `capacity`.
  std::size_t per_source = 64;
  /// Most pending claims to IDs of other peers; default 256. Further claimants are considered when
  /// they announce themselves again.
  std::size_t claims = 256;
  /// Most peers of one list; default 240. A peer that receives more sends them in parts of `part`,
  /// default 192, at least 2. An announcement, a Time Exchange and a list then fit one datagram.
  std::size_t most_listed = 240, part = 192;

  /// @throws std::invalid_argument for a heartbeat or number of misses that is not positive, or
  /// lists without room for one epoch, or parts without room for two; and for a first announcement
  /// with epoch 0 or the site of the scene.
  void check(const pdu::Presence& own) const;
  /// Silence after which a peer has timed out.
  [[nodiscard]] std::chrono::nanoseconds patience() const noexcept;
  /// Extra time, beyond a heartbeat, in which a peer that receives this many peers lists all of
  /// them.
  [[nodiscard]] std::chrono::nanoseconds list_round(std::size_t peers) const noexcept;
};

}  // namespace reckon::aoim
