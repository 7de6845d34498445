// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Stop/Freeze and Start/Resume: permitted senders, execution and acknowledgement.
#pragma once

#include "reckon/aoim/area_of_interest_manager.hpp"
#include "reckon/peer/clocks/time_keeper.hpp"
#include "reckon/peer/loops/entity_sender.hpp"
#include "reckon/peer/loops/model_counters.hpp"
#include "reckon/peer/loops/peer_watches.hpp"
#include "reckon/peer/scene/scene_file.hpp"
#include "reckon/peer/world/datagram_decoder.hpp"
#include "reckon/peer/world/owned_entities.hpp"

namespace reckon::peer {

/// One thread; no allocation.
class OrderStage {
 public:
  /// References outlive this.
  OrderStage(const NetworkConfig& network, aoim::AreaOfInterestManager& aoim, OwnedEntities& owned,
             const TimeKeeper& time, PeerWatches& watches, ModelCounters& counted) noexcept
      : network_(network),
        aoim_(aoim),
        owned_(owned),
        time_(time),
        watches_(watches),
        counted_(counted) {}

  /// Whether an order is genuine and from a permitted sender, or is addressed to others. A refused
  /// order is counted and reported.
  [[nodiscard]] bool obeys(const Inbound& order, const Arrival& arrival, const Pass& pass) noexcept;
  /// Freezes or resumes the addressed entities, and acknowledges.
  /// @param own answers for the whole peer
  void carry_out(const Inbound& order, const Arrival& arrival, const pdu::EntityId& own,
                 const Pass& pass) noexcept;

 private:
  void acknowledge(const Inbound& order, const Arrival& arrival, const pdu::EntityId& own,
                   const Pass& pass) noexcept;

  const NetworkConfig& network_;
  aoim::AreaOfInterestManager& aoim_;
  OwnedEntities& owned_;
  const TimeKeeper& time_;
  PeerWatches& watches_;
  ModelCounters& counted_;
};

}  // namespace reckon::peer
