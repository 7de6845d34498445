// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The real link: UDP multicast over IPv4 or IPv6. One socket per joined group, bound to the group's
// address, so that the kernel hands over no other datagrams.
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

/// Longest pause of a peer's reader without a loss.
inline constexpr std::chrono::nanoseconds kLongestStall = std::chrono::milliseconds(50);

/// SO_RCVBUF [octets] that loses nothing if the reader pauses for `stall` at this rate of datagrams
/// with up to `payload` octets. The kernel charges a buffer not by the octets but by their
/// memory: the next power of two above the octets, their headers and its own data; and it takes
/// twice the requested size. Measured, see docs/transport.md.
[[nodiscard]] std::size_t receive_room(double datagrams_per_second, std::chrono::nanoseconds stall,
                                       std::size_t payload) noexcept;

/// Options of a link.
struct UdpMulticastOptions {
  std::string interface;          ///< name, address or index; empty = chosen by rule
  bool ipv6{false};               ///< the address family of all groups
  std::uint16_t unicast_port{0};  ///< own port; 0 = a free one
  int ttl{1};                     ///< hops, 0 to 255; 1 stays on the LAN
  bool broadcast{false};    ///< allow sends to broadcast addresses, and joining 255.255.255.255
  bool fragments{false};    ///< datagrams above the MTU go out in fragments, instead of not at all
  bool deliver_own{false};  ///< hand over own datagrams looped back (self-test)
  /// SO_RCVBUF requested for each group [octets], see receive_room().
  std::size_t receive_buffer{std::size_t{1} << 20};
  std::size_t max_datagram{kMaxDatagram};  ///< longest accepted payload; longer ones are truncated
  std::size_t batch{32};                   ///< messages taken per system call, 1 to 64
  /// Lets the kernel cut runs of datagrams (UDP_SEGMENT) and hand them over as one (UDP_GRO), if it
  /// can; off: each datagram is sent and received alone.
  bool offload{true};
  std::size_t max_groups{1024};  ///< room for joins, allocated at set-up
  DatagramTap* tap{nullptr};     ///< receives the fate of each datagram; outlives the link
  /// Pool of a FanOutLink around this link: a tap then receives the group that is named in a
  /// datagram's frame, and the datagram behind the frame.
  std::optional<GroupPool> framed{};
  /// Groups of this pool, except its base, are read before each turn of any other group, up to half
  /// of the datagrams read in one turn; none: all groups are read in turn.
  std::optional<GroupPool> read_first{};
};

/// Offload functions of the kernel for many datagrams at once.
struct UdpOffload {
  bool segments{false};   ///< send_batch() passes runs of one length to one group as one message
  bool coalesces{false};  ///< datagrams that came as one message are read as one
  int refusal{0};         ///< errno with which it refused to cut; 0: it did not, or was not asked
};

/// UDP multicast on one interface. Send and receive allocate nothing.
///
/// The link continues to work when its interface disappears. The kernel wakes wait() when
/// interfaces or addresses change, and the link opens the interface again: the one with the same
/// name or the requested address. After five seconds it uses another one, if the interface was
/// chosen by rule. The link keeps its own port if possible, and joins the groups again. If own
/// datagrams to the first joined group no longer come back, it also reports this and joins the
/// group once more. take_event() returns all of these reports.
class UdpMulticast final : public Link {
 public:
  /// Opens the sending socket, which also receives unicast.
  /// @throws std::system_error or std::runtime_error with the value and the remedy.
  /// @param clock must outlive the link.
  UdpMulticast(const UdpMulticastOptions& options, const Clock& clock);
  ~UdpMulticast() override;

  bool send(const IpEndpoint& to, std::span<const std::byte> bytes) noexcept override;
  /// At most two system calls for 64 datagrams, one of them for the octets pending in the kernel;
  /// one more if the wire is slower than the sender. The kernel cuts runs. If it refuses, each
  /// datagram is sent individually from then on, and take_event() reports that.
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

  /// The interface chosen at construction, with the reason.
  [[nodiscard]] const InterfaceChoice& choice() const noexcept;
  /// Path MTU of the base of the interface [octets], by IP_MTU.
  [[nodiscard]] std::size_t mtu() const noexcept;
  /// SO_RCVBUF that the kernel granted [octets], in the unit of the request.
  [[nodiscard]] std::size_t receive_buffer() const noexcept;
  /// Functions in use; any thread.
  [[nodiscard]] UdpOffload offload() const noexcept;
  /// Sentences about what falls short of the request; empty if nothing does.
  [[nodiscard]] const std::vector<std::string>& warnings() const noexcept;

 private:
  struct Sockets;
  std::unique_ptr<Sockets> sockets_;
};

}  // namespace reckon::peer
