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
  /// Announcements missed in a row after which a peer is lost; default 6. At 20 % loss three in a
  /// row go missing every two minutes, six every four hours.
  int missed = 6;
  /// Least time between two announcements of ours, so that many newcomers cause no storm; default
  /// 100 ms. It is also the slack that the last missed announcement is given.
  std::chrono::nanoseconds minimum_gap = std::chrono::milliseconds(100);
  /// After a start or a newcomer we announce ourselves again after `brisk_gap`, twice that and so
  /// on up to half a heartbeat, until all whom we hear list us, for the time `brisk` at most: at 20
  /// % loss everybody knows everybody within 2 s, and without loss nothing is sent twice. In a
  /// dispute, or with a new id of ours, every `brisk_gap` for all of that time.
  std::chrono::nanoseconds brisk_gap = std::chrono::milliseconds(150);
  std::chrono::nanoseconds brisk = std::chrono::milliseconds(1500);
  /// A new epoch under a live id is a restart when the old life is silent for so long; where the
  /// old life itself has just begun, as in a race for the id, for `race_wait`.
  std::chrono::nanoseconds restart_wait = std::chrono::milliseconds(500);
  std::chrono::nanoseconds race_wait = std::chrono::milliseconds(800);
  /// Who has lost its id listens for so long before it draws another, so as to know which are free.
  std::chrono::nanoseconds listen = std::chrono::milliseconds(100);
  /// Who has held its id for so long gives way to no newcomer.
  std::chrono::nanoseconds established = std::chrono::seconds(2);
  /// Two that are both established, as after a partition, ask their witnesses after so long; after
  /// half of it where all of them have spoken.
  std::chrono::nanoseconds dispute = std::chrono::milliseconds(2500);
  /// A peer that proves itself from another address speaks from there when its old one has sent
  /// nothing for so long since; from the one before at once.
  std::chrono::nanoseconds still = std::chrono::milliseconds(200);
  /// A life that has offered no proof and is over may come back from another address after so long.
  std::chrono::nanoseconds pin = std::chrono::seconds(3);
  /// One that proves itself takes its id back from who came meanwhile, if it was silent for no
  /// longer.
  std::chrono::nanoseconds take_back = std::chrono::seconds(30);
  /// How lives prove that they are the same as before; null: they do not, and keep their address.
  OneWay one_way = nullptr;
  ChainLink secret{};  ///< of this life, drawn at random
  /// Silence after which a peer is reported as quiet.
  std::chrono::nanoseconds quiet = std::chrono::milliseconds(2500);
  /// Peers heard within this time are in our list of those whom we hear.
  std::chrono::nanoseconds listed = std::chrono::milliseconds(1750);
  /// Peers remembered; default 1,024. Further ones are counted and not joined, unless one can go
  /// that announced itself once and was silent since, or has never sent a list.
  std::size_t capacity = 1024;
  /// Peers believed of one address and port, that is of one process; default 64, what a replayed
  /// exercise may have. Of one address: half of `capacity`.
  std::size_t per_source = 64;
  /// Claims to the id of another that are looked into at a time; default 256. Further claimants are
  /// heard when they announce themselves again.
  std::size_t claims = 256;
  /// Peers of one list; default 256. Who hears more sends them in turns of `part`, default
  /// 192, at least 2: the list, an announcement and what else goes with it fit one datagram.
  std::size_t most_listed = 256, part = 192;

  /// @throws std::invalid_argument for a heartbeat or number of misses that is not positive, or
  /// lists without room for one, parts of them for two.
  void check() const;
  /// Silence after which a peer is lost.
  [[nodiscard]] std::chrono::nanoseconds patience() const noexcept;
  /// How much longer than a heartbeat one that hears so many peers takes to list all of them.
  [[nodiscard]] std::chrono::nanoseconds list_round(std::size_t peers) const noexcept;
};

}  // namespace reckon::aoim
