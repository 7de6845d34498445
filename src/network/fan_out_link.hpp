// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Groups where the network carries no multicast, as in clouds: each datagram goes to each address
// of a list, and says in front to which group it was said. Whoever has not joined that drops it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "reckon/peer/network/link.hpp"

namespace reckon::peer {

class DatagramTap;

/// What stands in front of a datagram that went to an address of a list.
struct SaidInFront {
  std::optional<std::size_t> place;  ///< 0: the base group, n: the n-th of the pool; else beyond it
  GroupAddress group;                ///< of that place
  std::span<const std::byte> bytes;  ///< what is behind it
};
/// A datagram with nothing in front is plain DIS, of the base group. 5 ns.
[[nodiscard]] SaidInFront said_in_front(std::span<const std::byte> datagram,
                                        const GroupPool& pool) noexcept;

/// To whom.
struct FanOutOptions {
  std::vector<IpEndpoint> peers;  ///< the own address may be among them; it is left out
  std::uint8_t exercise = 1;      ///< of what is put in front
  /// Plain DIS: nothing is put in front, and what comes without it is of the base group.
  bool plain = false;
  DatagramTap* tap = nullptr;  ///< of what becomes of each datagram; outlives the link
};

/// Around a link whose own endpoint the others know. One copy to each address, those to one address
/// in one run, so that the kernel can cut it; cost: that of the inner link times the addresses, and
/// one copy of the octets. Nothing is joined. Threads as any Link; sending allocates nothing.
class FanOutLink final : public Link {
 public:
  /// @param inner outlives this
  FanOutLink(Link& inner, const GroupPool& pool, const FanOutOptions& options);
  ~FanOutLink() override;

  bool send(const IpEndpoint& to, std::span<const std::byte> bytes) noexcept override;
  /// Counts as sent what went to all of them.
  SentBatch send_batch(std::span<const OutgoingDatagram> batch) noexcept override;
  /// What was said to groups that are joined; the rest is dropped here, and counted by
  /// not_listened().
  std::size_t receive(std::span<Datagram> out) noexcept override;
  std::error_code join(const GroupAddress& group) noexcept override;
  void leave(const GroupAddress& group) noexcept override;
  bool wait(std::chrono::nanoseconds timeout) noexcept override;
  void wake() noexcept override;
  [[nodiscard]] IpEndpoint local_endpoint() const noexcept override;
  [[nodiscard]] std::size_t max_payload() const noexcept override;
  [[nodiscard]] LinkStatistics statistics() const noexcept override;
  bool take_event(LinkEvent& event) noexcept override;
  void settle() noexcept override;

  /// Datagrams that came for groups that are not joined. Any thread.
  [[nodiscard]] std::uint64_t not_listened() const noexcept;
  /// To how many each datagram goes.
  [[nodiscard]] std::size_t peers() const noexcept;

 private:
  struct UnicastGroups;
  std::unique_ptr<UnicastGroups> groups_;
};

}  // namespace reckon::peer
