// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The real link: UDP multicast over IPv4 or IPv6. One socket per joined group, bound to the group's
// address, so that the kernel hands over nothing that was not joined.
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "reckon/peer/clocks/clock.hpp"
#include "reckon/peer/network/interface_choice.hpp"
#include "reckon/peer/network/link.hpp"

namespace reckon::peer {

class DatagramTap;

/// For so long a peer's reader may stand still without a loss.
inline constexpr std::chrono::nanoseconds kLongestStall = std::chrono::milliseconds(50);

/// SO_RCVBUF [octets] that loses nothing while the reader stands still for `stall` and so many
/// datagrams of up to `payload` octets come each second. The kernel charges a buffer not for the
/// octets but for the memory that they lie in: the next power of two above them, their headers and
/// its own book-keeping; and it takes twice what is asked for. Measured, see docs/transport.md.
[[nodiscard]] std::size_t receive_room(double datagrams_per_second, std::chrono::nanoseconds stall,
                                       std::size_t payload) noexcept;

/// How a link is opened.
struct UdpMulticastOptions {
  std::string interface;          ///< name, address or index; empty = chosen by rule
  bool ipv6{false};               ///< the address family of all groups
  std::uint16_t unicast_port{0};  ///< own port; 0 = one that is free
  int ttl{1};                     ///< hops, 0 to 255; 1 stays on the LAN
  bool broadcast{false};    ///< allow sends to broadcast addresses, and joining 255.255.255.255
  bool deliver_own{false};  ///< hand over own datagrams looped back (self-test)
  /// SO_RCVBUF asked for each group [octets], see receive_room().
  std::size_t receive_buffer{std::size_t{1} << 20};
  std::size_t max_datagram{kMaxDatagram};  ///< longest payload taken; longer counts as truncated
  std::size_t batch{32};                   ///< messages taken per system call, 1 to 64
  /// Let the kernel cut runs of datagrams (UDP_SEGMENT) and hand them over whole (UDP_GRO), where
  /// it can; off: each datagram goes and comes by itself.
  bool offload{true};
  std::size_t max_groups{1024};  ///< room for joins, made at set-up
  DatagramTap* tap{nullptr};     ///< of what becomes of each datagram; outlives the link
  /// Around it is a FanOutLink of this pool: a tap receives the group that a datagram says in
  /// front, and of all after that.
  std::optional<GroupPool> framed{};
  /// Groups behind the base of this pool are read before each turn of any other group, up to half
  /// of what is read at a time; none: all are read in turn.
  std::optional<GroupPool> read_first{};
};

/// What the kernel does for many datagrams at once.
struct UdpOffload {
  bool segments{false};   ///< send_batch() hands it runs of one length to one group as one message
  bool coalesces{false};  ///< what came as one message is read as one
  int refusal{0};         ///< errno by which it refused to cut; 0: it did not, or was not asked to
};

/// UDP multicast on one interface. Send and receive allocate nothing.
///
/// It outlives its interface: the kernel notifies wait() when interfaces or addresses change, and
/// takes the interface anew (the same name or the address asked for; another one, after five
/// seconds, only where it was chosen by rule): the own port stays where it can, the groups are
/// joined again. What own datagrams to the first group that was joined no longer bring back is
/// reported as well, and joined again once. All that comes as take_event().
class UdpMulticast final : public Link {
 public:
  /// Opens the sending socket, which is also where unicast arrives. @throws std::system_error or
  /// std::runtime_error with the value and the remedy. `clock` must outlive the link.
  UdpMulticast(const UdpMulticastOptions& options, const Clock& clock);
  ~UdpMulticast() override;

  bool send(const IpEndpoint& to, std::span<const std::byte> bytes) noexcept override;
  /// At most two system calls for 64 datagrams, one of them for what waits in the kernel; one more
  /// where the wire takes less than is sent. Runs are cut by the kernel; where it refuses, each
  /// goes alone, from then on too, and take_event() reports that.
  SentBatch send_batch(std::span<const OutgoingDatagram> batch) noexcept override;
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

  /// The interface used at construction and why.
  [[nodiscard]] const InterfaceChoice& choice() const noexcept;
  /// Path MTU of the base of the interface [octets], by IP_MTU.
  [[nodiscard]] std::size_t mtu() const noexcept;
  /// What the kernel really gave for SO_RCVBUF [octets], in the unit in which it is asked for.
  [[nodiscard]] std::size_t receive_buffer() const noexcept;
  /// What is in use; any thread.
  [[nodiscard]] UdpOffload offload() const noexcept;
  /// Sentences about what is less than asked for; empty where all is well.
  [[nodiscard]] const std::vector<std::string>& warnings() const noexcept;

 private:
  struct Sockets;
  std::unique_ptr<Sockets> sockets_;
};

}  // namespace reckon::peer
