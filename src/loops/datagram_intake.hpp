// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Entry of datagrams into the model loop: the area-of-interest manager filters them, then they are
// decoded and passed on update by update. With a backlog, states with a newer one pending are
// skipped.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "reckon/aoim/area_of_interest_manager.hpp"
#include "reckon/peer/clocks/time_keeper.hpp"
#include "reckon/peer/loops/assured_stage.hpp"
#include "reckon/peer/loops/entity_sender.hpp"
#include "reckon/peer/loops/model_counters.hpp"
#include "reckon/peer/loops/model_wiring.hpp"
#include "reckon/peer/loops/peer_hooks.hpp"
#include "reckon/peer/world/datagram_decoder.hpp"
#include "reckon/peer/world/overtaken_states.hpp"
#include "reckon/peer/world/remote_entities.hpp"

namespace reckon::peer {

/// Receives each update to be read.
class UpdateHandler {
 public:
  virtual ~UpdateHandler() = default;
  /// Called by the thread of read().  @param update valid until the call returns
  virtual void take_update(const Inbound& update, const Arrival& arrival) noexcept = 0;
};

/// One thread; allocates only at construction.
class DatagramIntake {
 public:
  /// References outlive this.
  DatagramIntake(const ModelWiring& wiring, aoim::AreaOfInterestManager& aoim, TimeKeeper& time,
                 RemoteEntities& remote, const HookList& hooks, ModelCounters& counted);

  /// Reads pending datagrams, beginning with urgent tiers, then held PDUs whose turn has come. The
  /// number of datagrams in a step is limited, so that a flood does not delay the own hand's
  /// updates.  @param own the simulation of this peer
  void read(const Pass& pass, const aoim::PeerId& own, AssuredStage& assured,
            UpdateHandler& handler) noexcept;
  /// Reports pending datagrams to the tap as unread, at shutdown.
  void report_unread() noexcept;
  /// Drops the key states of this epoch.
  void forget_keys(std::uint32_t epoch) noexcept { decoder_.forget_keys(epoch); }

 private:
  struct Reading {
    const Pass& pass;
    const aoim::PeerId& own;
    UpdateHandler& handler;
  };

  void drain(DatagramRing& ring, const Reading& reading) noexcept;
  [[nodiscard]] std::size_t read_some(std::span<const QueuedDatagram> datagrams,
                                      const Reading& reading) noexcept;
  [[nodiscard]] KeySpeaker key_speaker(const Arrival& arrival) const noexcept;
  [[nodiscard]] bool admit(const QueuedDatagram& datagram, const Pass& pass,
                           ArrivedDatagram& admitted) noexcept;
  [[nodiscard]] bool admit_unicast(const QueuedDatagram& datagram, const Pass& pass,
                                   ArrivedDatagram& admitted) noexcept;
  [[nodiscard]] std::uint32_t assured_sender(std::span<const std::byte> octets,
                                             const aoim::SourceAddress& from) const noexcept;
  void report_judged(const QueuedDatagram& datagram, const aoim::Incoming& incoming,
                     std::uint64_t lost_before) noexcept;

  const SceneFile& scene_;
  const GroupPool& pool_;
  DatagramRing& inbound_;
  DatagramRing* urgent_;
  DatagramTap* tap_;
  aoim::AreaOfInterestManager& aoim_;
  TimeKeeper& time_;
  RemoteEntities& remote_;
  const HookList& hooks_;
  ModelCounters& counted_;
  DatagramDecoder decoder_;
  OvertakenStates overtaken_;
  std::vector<QueuedDatagram> queued_;     // datagrams taken at a time
  std::vector<ArrivedDatagram> admitted_;  // the admitted part of queued_
  bool looks_far_ = false;                 // nearly all pending datagrams were replaced
};

}  // namespace reckon::peer
