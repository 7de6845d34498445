// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Exit of datagrams from the model loop into the writer's ring. Reports each to the tap.
#pragma once

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <span>

#include "reckon/aoim/groups/group_index.hpp"
#include "reckon/pdu/seconds.hpp"
#include "reckon/peer/loops/model_counters.hpp"
#include "reckon/peer/loops/model_wiring.hpp"

namespace reckon::peer {

/// Limits the send rate to the rate that others read from one sender (SenderBudget), even for many
/// new entities: kRate datagrams a second and kBurst at once. Updates share
/// datagrams, so a pass may send kAhead updates for each allowed datagram; if it sends too many
/// datagrams, later passes send fewer. One thread; no allocation.
class DatagramOutlet {
 public:
  /// References outlive this.
  DatagramOutlet(const ModelWiring& wiring, ModelCounters& counted) noexcept
      : pool_(wiring.pool),
        link_(wiring.link),
        ring_(wiring.outbound),
        tap_(wiring.tap),
        counted_(counted) {}

  static constexpr double kRate = 9000.0, kBurst = 100.0;
  static constexpr std::size_t kAhead = 4;

  /// Begins a pass.
  void begin(std::chrono::nanoseconds now) noexcept {
    const double passed = pdu::to_seconds(now - filled_);
    filled_ = now;
    tokens_ = std::min(kBurst, tokens_ + kRate * std::max(0.0, passed));
  }
  /// The endpoint from which this peer sends.
  [[nodiscard]] IpEndpoint source() const noexcept { return link_.local_endpoint(); }
  /// Whether push() can reach single hosts.
  [[nodiscard]] bool reaches_hosts() const noexcept { return link_.reaches_hosts(); }
  /// Datagrams that the ring has room for.
  [[nodiscard]] std::size_t room() const noexcept { return ring_.room(); }
  /// Updates that may be sent in this pass.
  [[nodiscard]] std::size_t paced_room() const noexcept {
    const auto paced = static_cast<std::size_t>(std::max(0.0, tokens_)) * kAhead;
    return std::min(room(), paced);
  }
  /// Sends to a group of the pool; counted and dropped if the writer lags.
  void push(aoim::GroupIndex group, std::span<const std::byte> octets) noexcept {
    push(address_of(group), octets);
  }
  /// Sends to one host.
  void push(const IpEndpoint& host, std::span<const std::byte> octets) noexcept {
    tokens_ -= 1.0;
    const bool fits = ring_.push(host, std::chrono::nanoseconds(0), octets);
    if (!fits) counted_.write_overflow.add();
    note(host, octets, fits ? DatagramFate::numbered : DatagramFate::write_overflow);
  }
  /// Does not send a datagram that a mechanism refused.
  void withhold(aoim::GroupIndex group, std::span<const std::byte> octets) noexcept {
    note(address_of(group), octets, DatagramFate::withheld);
  }
  /// Drops a stale datagram instead of sending it.
  void drop_stale(aoim::GroupIndex group, std::span<const std::byte> octets) noexcept {
    counted_.stale_unsent.add();
    note(address_of(group), octets, DatagramFate::stale_unsent);
  }

 private:
  void note(const IpEndpoint& to, std::span<const std::byte> octets, DatagramFate more) noexcept {
    // Reports to the tap that the datagram has a number, and an immediate fate if any.
    if (tap_ == nullptr) return;
    tap_->note(DatagramTap::Loop::model, DatagramFate::numbered, to, octets);
    if (more != DatagramFate::numbered) tap_->note(DatagramTap::Loop::model, more, to, octets);
  }
  [[nodiscard]] GroupAddress address_of(aoim::GroupIndex group) const noexcept {
    return group == aoim::kBaseGroup ? pool_.base() : pool_.address(group.value - 1u);
  }

  const GroupPool& pool_;
  const Link& link_;
  DatagramRing& ring_;
  DatagramTap* tap_;
  ModelCounters& counted_;
  double tokens_ = kBurst;  // datagrams that may be sent now; below 0: too many were sent
  std::chrono::nanoseconds filled_{0};
};

}  // namespace reckon::peer
