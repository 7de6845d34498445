// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Where datagrams enter the model loop: judged by the area-of-interest manager, decoded, and handed
// on update by update. Where many wait, states that a later one overtakes are left out.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "reckon/aoim/area_of_interest_manager.hpp"
#include "reckon/peer/clocks/time_keeper.hpp"
#include "reckon/peer/loops/entity_sender.hpp"
#include "reckon/peer/loops/model_counters.hpp"
#include "reckon/peer/loops/model_wiring.hpp"
#include "reckon/peer/world/datagram_decoder.hpp"
#include "reckon/peer/world/overtaken_states.hpp"
#include "reckon/peer/world/remote_entities.hpp"

namespace reckon::peer {

/// Receives each update that is to be read.
class UpdateHandler {
 public:
  virtual ~UpdateHandler() = default;
  /// By the thread of read(), of each datagram of this exercise, before what is in it. @param
  /// octets good until the call returns
  virtual void take_datagram(std::span<const std::byte> octets) noexcept = 0;
  /// By the thread of read(). @param update good until the call returns
  virtual void take_update(const Inbound& update, const Arrival& arrival) noexcept = 0;
};

/// One thread; allocates at construction alone.
class DatagramIntake {
 public:
  /// References outlive this.
  DatagramIntake(const ModelWiring& wiring, aoim::AreaOfInterestManager& aoim, TimeKeeper& time,
                 RemoteEntities& remote, ModelCounters& counted);

  /// Reads what has come, contact groups first: so many at a time that a flood does not keep the
  /// own hand from being sent. @param own the simulation of this peer
  void read(const Pass& pass, const aoim::PeerId& own, UpdateHandler& handler) noexcept;
  /// Nobody will read what waits: reports it to the tap.
  void report_unread() noexcept;
  /// Key states of this life are not read by any more.
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
  void report_judged(const QueuedDatagram& datagram, const aoim::Incoming& incoming,
                     std::uint64_t lost_before) noexcept;

  const SceneFile& scene_;
  const GroupPool& pool_;
  DatagramRing& inbound_;
  DatagramRing* felt_;
  DatagramTap* tap_;
  aoim::AreaOfInterestManager& aoim_;
  TimeKeeper& time_;
  RemoteEntities& remote_;
  ModelCounters& counted_;
  DatagramDecoder decoder_;
  OvertakenStates overtaken_;
  std::vector<QueuedDatagram> queued_;     // those taken at a time
  std::vector<ArrivedDatagram> admitted_;  // of them, those that are read
  bool looks_far_ = false;                 // nearly all that waited was overtaken
};

}  // namespace reckon::peer
