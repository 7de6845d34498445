// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// A link that loses one datagram, identified by its index among the counted ones.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "reckon/peer/network/link.hpp"

namespace reckon::test {

/// The datagrams that a link counts, and the one it loses.
struct OneLost {
  enum class Way { received, sent } way = Way::received;
  std::optional<peer::IpEndpoint> from;  ///< of received ones: only from this one
  std::size_t place = 0;                 ///< the first is 0
};

/// Forwards everything to `link`, except one datagram.
class LosingLink final : public peer::Link {
 public:
  explicit LosingLink(peer::Link& link) : link_(link) {}

  /// Counts from now on, and loses the given one.
  void lose(const OneLost& lost) {
    lost_ = lost;
    counted_ = 0;
  }
  [[nodiscard]] std::size_t counted() const noexcept { return counted_; }

  bool send(const peer::IpEndpoint& to, std::span<const std::byte> bytes) noexcept override {
    if (lost_ && lost_->way == OneLost::Way::sent && counted_++ == lost_->place) return true;
    return link_.send(to, bytes);
  }
  std::size_t receive(std::span<peer::Datagram> out) noexcept override {
    const std::size_t count = link_.receive(out);
    std::size_t kept = 0;
    for (std::size_t i = 0; i < count; ++i) {
      if (!is_lost(out[i])) out[kept++] = out[i];
    }
    return kept;
  }
  std::error_code join(const peer::GroupAddress& group) noexcept override {
    return link_.join(group);
  }
  void leave(const peer::GroupAddress& group) noexcept override { link_.leave(group); }
  bool wait(std::chrono::nanoseconds timeout) noexcept override { return link_.wait(timeout); }
  void wake() noexcept override { link_.wake(); }
  [[nodiscard]] peer::IpEndpoint local_endpoint() const noexcept override {
    return link_.local_endpoint();
  }
  [[nodiscard]] std::size_t max_payload() const noexcept override { return link_.max_payload(); }
  [[nodiscard]] peer::LinkStatistics statistics() const noexcept override {
    return link_.statistics();
  }

 private:
  bool is_lost(const peer::Datagram& datagram) noexcept {
    if (!lost_ || lost_->way != OneLost::Way::received) return false;
    if (lost_->from && *lost_->from != datagram.sender) return false;
    return counted_++ == lost_->place;
  }

  peer::Link& link_;
  std::optional<OneLost> lost_;
  std::size_t counted_ = 0;
};

}  // namespace reckon::test
