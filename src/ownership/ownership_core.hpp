// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// What the parts of the ownership protocol share.
#pragma once

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <variant>
#include <vector>

#include "reckon/peer/ownership/act_book.hpp"
#include "reckon/peer/ownership/lease_book.hpp"
#include "reckon/peer/ownership/messages.hpp"
#include "reckon/peer/ownership/tenure_table.hpp"

namespace reckon::peer {

/// Questions of the protocol to the peer that runs it.
class OwnershipUser {
 public:
  virtual ~OwnershipUser() = default;
  /// Whether the scene's `touch` admits this peer as an owner of the object.
  [[nodiscard]] virtual bool may_take(std::size_t object, std::uint32_t epoch) = 0;
  /// Whether a hand of this peer holds or touches the object, so that it stays here.
  [[nodiscard]] virtual bool is_busy(std::size_t object) = 0;
  /// The objects that must change owner together with this one, which is in the set.
  [[nodiscard]] virtual ObjectSet company_of(std::size_t object) = 0;
  /// Whether an object of ours is in motion.
  [[nodiscard]] virtual bool is_any_awake() = 0;
  /// A number that is equal for peers of one host.
  [[nodiscard]] virtual std::uint64_t host_of(std::uint32_t epoch) = 0;
};

/// Identity of the peer and number of objects.
struct OwnershipConfig {
  std::uint32_t epoch = 0;
  std::uint32_t started = 0;  ///< [s], UTC since 1970
  std::size_t objects = 0;    ///< at most kMostOwnable
  bool votes = true;          ///< false: the peer only follows the owners
  /// Founds a world in its first step; else it waits 1.2 s for an older one.
  bool founds_at_once = false;
};

/// A message to send.
struct OutgoingMessage {
  std::uint32_t to = 0;  ///< epoch; 0: all peers
  /// Repeated until each addressee has it, for some seconds; `to` 0: all voters.
  bool is_assured = false;
  OwnershipMessage message;
};

/// A change for the peer that runs the protocol.
struct OwnershipEvent {
  enum class Kind : std::uint8_t {
    gained,  ///< this peer owns the objects
    lost,    ///< it does not any more
    yield,   ///< stop simulating the objects, then call Ownership::yielded()
    merged,  ///< another world replaced ours
  };
  Kind kind = Kind::gained;
  OwnerChange cause = OwnerChange::founded;
  ObjectSet objects;
  std::uint32_t transaction = 0;
  std::uint32_t peer = 0;  ///< epoch of the other side; 0: none
};

struct OwnershipCounts {
  std::uint64_t granted = 0;   ///< objects given to others
  std::uint64_t taken = 0;     ///< objects granted to us
  std::uint64_t adopted = 0;   ///< objects of failed owners
  std::uint64_t refused = 0;   ///< grants and tenures refused, see TenureTable
  std::uint64_t released = 0;  ///< objects whose grant had no answer
  std::uint64_t merged = 0;    ///< worlds left for an older one
};

struct OwnershipCore {
  OwnershipCore(const OwnershipConfig& settings, OwnershipUser& asked)
      : config(settings),
        user(asked),
        to_found{settings.started, settings.epoch},
        table(settings.objects) {
    out.reserve(256);
    events.reserve(64);
  }

  void send(std::uint32_t to, OwnershipMessage message, bool is_assured = false) {
    std::visit([this](auto& sent) { sent.world = world; }, message);
    out.push_back({to, is_assured, std::move(message)});
  }
  void report(const OwnershipEvent& event) { events.push_back(event); }

  /// End of our lease: the majority of each roll that may be in force.
  [[nodiscard]] std::chrono::nanoseconds lease_end(std::chrono::nanoseconds now) const noexcept {
    auto end = leases.lease_end(acts.decided().roll, config.epoch, now);
    if (const Act* pending = acts.pending())
      end = std::min(end, leases.lease_end(pending->roll, config.epoch, now));
    return end;
  }
  /// Whether this peer knows all objects that acts have given. After it missed an act, it neither
  /// owns nor agrees to anything until others have sent their whole tables.
  [[nodiscard]] bool is_informed() const noexcept { return unknown.none(); }
  /// All objects may have been given away.
  void forget_gifts() noexcept {
    for (std::size_t i = 0; i < table.size(); ++i) unknown.set(i);
  }
  [[nodiscard]] bool has_lease(std::chrono::nanoseconds now) const noexcept {
    return acts.exists() && acts.newest().roll.contains(config.epoch) && lease_end(now) > now;
  }

  OwnershipConfig config;
  OwnershipUser& user;
  WorldId world;
  WorldId to_found;  ///< the next one that this peer would found
  ActBook acts;
  LeaseBook leases;
  TenureTable table;
  OwnershipCounts counts;
  std::vector<OutgoingMessage> out;
  std::vector<OwnershipEvent> events;
  ObjectSet unknown;  ///< objects that an act which this peer missed may have given
  bool is_leaving = false;
  bool is_closing = false;  ///< leaves, and gives nothing away any more
};

}  // namespace reckon::peer
