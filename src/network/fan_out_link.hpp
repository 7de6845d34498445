// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Groups on networks without multicast, such as clouds. Each datagram goes to each address of a
// list, with a frame that names its group. Receivers that have not joined that group drop it.
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

/// The frame before a datagram to an address of a list.
struct GroupFrame {
  std::optional<std::size_t> place;  ///< 0: the base group, n: the n-th of the pool; else beyond it
  GroupAddress group;                ///< of that place
  std::span<const std::byte> bytes;  ///< the datagram behind the frame
};
/// A datagram without a frame is plain DIS, of the base group. 5 ns.
[[nodiscard]] GroupFrame group_frame_of(std::span<const std::byte> datagram,
                                        const GroupPool& pool) noexcept;

/// The list of recipients, and the frame.
struct FanOutOptions {
  std::vector<IpEndpoint> peers;  ///< may contain the own address, which is left out
  std::uint8_t exercise = 1;      ///< in the frame
  /// Plain DIS: no frames are sent, and datagrams without one are of the base group.
  bool plain = false;
  DatagramTap* tap = nullptr;  ///< receives the fate of each datagram; outlives the link
};

/// A link around another one whose own endpoint the other hosts know. It sends one copy to each
/// address, and all copies to one address in one run, so that the kernel can cut it. Cost: the cost
/// of the inner link multiplied by the number of addresses, and one copy of the octets. Nothing is
/// joined. Threads as for any Link; sending allocates nothing.
class FanOutLink final : public LinkAround {
 public:
  /// @param inner outlives this
  FanOutLink(Link& inner, const GroupPool& pool, const FanOutOptions& options);
  ~FanOutLink() override;

  bool send(const IpEndpoint& to, std::span<const std::byte> bytes) noexcept override;
  /// Counts the datagrams that were sent to all addresses.
  SentBatch send_batch(std::span<const OutgoingDatagram> batch) noexcept override;
  /// Returns datagrams to joined groups; the others are dropped here and counted by not_listened().
  std::size_t receive(std::span<Datagram> out) noexcept override;
  std::error_code join(const GroupAddress& group) noexcept override;
  void leave(const GroupAddress& group) noexcept override;
  [[nodiscard]] std::size_t max_payload() const noexcept override;
  [[nodiscard]] LinkStatistics statistics() const noexcept override;
  /// Each datagram is for all addresses.
  [[nodiscard]] bool reaches_hosts() const noexcept override { return false; }

  /// Datagrams received for groups that are not joined. Any thread.
  [[nodiscard]] std::uint64_t not_listened() const noexcept;
  /// Number of recipients of each datagram.
  [[nodiscard]] std::size_t peers() const noexcept;

 private:
  struct UnicastGroups;
  std::unique_ptr<UnicastGroups> groups_;
};

}  // namespace reckon::peer
