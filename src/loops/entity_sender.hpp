// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Decides whether an entity of ours has to be sent, and how. Part of the model loop.
#pragma once

#include <chrono>
#include <cstddef>
#include <optional>
#include <span>

#include "reckon/aoim/area_of_interest_manager.hpp"
#include "reckon/peer/clocks/time_keeper.hpp"
#include "reckon/peer/loops/peer_hooks.hpp"
#include "reckon/peer/loops/send_counters.hpp"
#include "reckon/peer/world/owned_entity.hpp"
#include "reckon/peer/world/scene_position.hpp"

namespace reckon::peer {

/// The pass in which an update is sent.
struct Pass {
  std::chrono::nanoseconds now{0};
  std::chrono::nanoseconds utc{0};  ///< the same instant in UTC; without jumps
};

/// Reason and manner of an update.
struct Dispatch {
  deadreckon::SendReason reason = deadreckon::SendReason::event;
  bool in_company = false;  ///< a nearby hand may feel it, so it does not wait
  std::size_t audience = kAllAudiences;
  bool is_asked = false;  ///< requested by a newcomer
};

/// The sending part of the model loop. One thread; no allocation.
class EntitySender {
 public:
  /// References outlive this.
  EntitySender(const NetworkConfig& network, aoim::AreaOfInterestManager& aoim,
               const TimeKeeper& time, const HookList& hooks, Counters& counters)
      : network_(network),
        aoim_(aoim),
        time_(time),
        hooks_(hooks),
        counters_(counters, aoim.tiers()) {}

  /// Whether the entity is requested, independent of its predictor: by a newcomer, a change of
  /// cell, or a new listener of a tier. A withheld one is not.
  [[nodiscard]] bool is_asked(OwnedEntity& entity, const Pass& pass) const noexcept {
    return !entity.is_withheld(pass.now) && asked_tier({entity, pass, pass.now});
  }

  /// Decides by the true state at `at`, and sends if an update is due. True if it was sent.
  /// @param probes at which its force must be accurate  @param accounts sent with it
  bool consider(OwnedEntity& entity, const Pass& pass, std::chrono::nanoseconds at,
                std::span<const deadreckon::ProbeState> probes = {},
                std::span<const EnergyAccount> accounts = {}) noexcept;

  /// Sends it regardless of its predictors.
  bool send(OwnedEntity& entity, const Pass& pass, std::chrono::nanoseconds at, const Dispatch& how,
            std::span<const EnergyAccount> accounts = {}) noexcept;

 private:
  using Nanoseconds = std::chrono::nanoseconds;

  // A decision whether an entity is due. Its group and its nearest receiver are found once.
  struct Decision {
    OwnedEntity& entity;
    const Pass& pass;
    Nanoseconds at;
    aoim::RoutedPosition position = to_position(entity.truth().position);
    std::optional<const aoim::Channel*> nearest = {};
  };

  /// The outermost tier that requests it.
  [[nodiscard]] std::optional<std::size_t> asked_tier(const Decision& decision) const noexcept;
  [[nodiscard]] bool is_asked_in(std::size_t tier, const Decision& decision) const noexcept;
  bool note_asked(const Decision& decision) const noexcept;
  void look_for_listeners(const Decision& decision) const noexcept;
  [[nodiscard]] bool is_out_of_step(const Decision& decision, std::size_t audience) const noexcept;
  [[nodiscard]] Dispatch choose(Decision& decision, deadreckon::SendReason inmost,
                                bool in_company) noexcept;
  [[nodiscard]] Dispatch choose_audience(Decision& decision, deadreckon::SendReason inmost,
                                         bool in_company) noexcept;
  [[nodiscard]] const aoim::Channel* nearest_channel(Decision& decision) const noexcept;
  [[nodiscard]] const aoim::Channel* channel_of(Decision& decision,
                                                std::size_t audience) const noexcept;
  [[nodiscard]] bool may_wait(Decision& decision, std::size_t audience,
                              deadreckon::SendReason reason) noexcept;
  [[nodiscard]] deadreckon::SendReason unless_waiting(Decision& decision, std::size_t audience,
                                                      deadreckon::SendReason reason) noexcept;
  void hold(OwnedEntity& entity, Nanoseconds until) noexcept;
  bool send(Decision& decision, const Dispatch& how,
            std::span<const EnergyAccount> accounts) noexcept;
  void reroute(const OwnedEntity& entity, aoim::RoutedPosition& position) const noexcept;
  std::size_t send_departure(const aoim::RoutedPosition& position, aoim::GroupIndex former,
                             std::span<const std::byte> records,
                             const aoim::BundleTerms& terms) noexcept;
  std::size_t send_at_once(std::size_t tier, const aoim::RoutedPosition& position,
                           std::span<const std::byte> records, Nanoseconds now) noexcept;
  std::size_t send_to_row(OwnedEntity& entity, const aoim::RoutedPosition& position,
                          std::span<const std::byte> records, const aoim::BundleTerms& terms,
                          std::size_t audience, Nanoseconds now) noexcept;
  struct Written {
    std::size_t octets;
    bool needs_key;  ///< depends on a key state that a newcomer lacks
  };
  Written send_to_all(OwnedEntity& entity, const aoim::RoutedPosition& position,
                      std::span<const std::byte> records, const aoim::BundleTerms& terms,
                      bool is_event, Nanoseconds now) noexcept;

  const NetworkConfig& network_;
  aoim::AreaOfInterestManager& aoim_;
  const TimeKeeper& time_;
  const HookList& hooks_;
  SendCounters counters_;
  EntityUpdate update_;
};

}  // namespace reckon::peer
