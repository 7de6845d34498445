// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The way octets travel between peers: groups, datagrams, and the Link that carries them.
// UdpMulticast is the real one, SimulatedNetwork gives them in process, ImpairedLink wraps any.
#pragma once

#include <array>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <system_error>

namespace reckon::peer {

/// An IPv4 or IPv6 address with a UDP port. A value: copy, compare, hash. IPv4 uses octets[0..3].
struct IpEndpoint {
  std::array<std::uint8_t, 16> octets{};
  bool is_v6{false};
  std::uint16_t port{0};

  auto operator<=>(const IpEndpoint&) const = default;

  [[nodiscard]] bool is_multicast() const noexcept;
  /// True for 255.255.255.255, which reaches all of the LAN without a group.
  [[nodiscard]] bool is_broadcast() const noexcept;
  [[nodiscard]] bool is_loopback() const noexcept;
  /// True where no address is set (0.0.0.0 or ::).
  [[nodiscard]] bool is_unspecified() const noexcept;

  /// Reads "239.192.1.0", "239.192.1.0:3000", "ff15::1", "[ff15::1]:3000"; without a port,
  /// `default_port`. Nothing where the text is none of these.
  [[nodiscard]] static std::optional<IpEndpoint> parse(std::string_view text,
                                                       std::uint16_t default_port = 0);
  /// From a host-order IPv4 address.
  [[nodiscard]] static IpEndpoint v4(std::uint32_t address, std::uint16_t port) noexcept;

  /// "239.192.1.0" or "ff15::1".
  [[nodiscard]] std::string address_text() const;
  /// "239.192.1.0:3000" or "[ff15::1]:3000".
  [[nodiscard]] std::string text() const;
};

/// An endpoint whose address is a multicast group, or all of the LAN where multicast is disabled.
using GroupAddress = IpEndpoint;

/// The groups of one world: a base group for presence and `size` groups behind it for the cells.
class GroupPool {
 public:
  static constexpr std::uint16_t kDefaultPort = 3000;
  static constexpr std::size_t kDefaultSize = 256;

  /// 239.192.1.0:3000 and 256 groups after it (239.192.1.1 to 239.192.2.0).
  [[nodiscard]] static GroupPool ipv4_default() noexcept;
  /// [ff15::c0:100]:3000 and 256 groups after it; c0:100 so that no Ethernet address of the pool
  /// is one of those that every switch floods (33:33:00:00:00:xx).
  [[nodiscard]] static GroupPool ipv6_default() noexcept;

  /// The broadcast address has no groups behind it, whatever `size` says: its base alone is used.
  /// @throws std::invalid_argument where base is neither a multicast group nor the broadcast
  /// address, its port is 0, size is 0 or above 65535, or the last group would leave the multicast
  /// range.
  GroupPool(const GroupAddress& base, std::size_t size);

  /// Where presence is announced.
  [[nodiscard]] const GroupAddress& base() const noexcept { return base_; }
  [[nodiscard]] std::size_t size() const noexcept { return size_; }
  /// Group `index`, 0 <= index < size() (assert): base + 1 + index.
  [[nodiscard]] GroupAddress address(std::size_t index) const noexcept;
  /// The inverse of address(); nothing for the base group and for foreign groups.
  [[nodiscard]] std::optional<std::size_t> index(const GroupAddress& group) const noexcept;

 private:
  GroupAddress base_;
  std::size_t size_;
};

/// Longest payload that peers send or take [octets]: above the 8192 of a DIS bundle.
inline constexpr std::size_t kMaxDatagram = 9216;

/// One datagram as received. `bytes` stays valid until the next receive() of the same link.
struct Datagram {
  GroupAddress group;                 ///< where it was sent to; the link's own endpoint if unicast
  IpEndpoint sender;                  ///< the unicast endpoint that a reply reaches
  std::span<const std::byte> bytes;   ///< UDP payload
  std::chrono::nanoseconds received;  ///< arrival by the link's clock, steady (kernel time if real)
  std::uint64_t boot{0};  ///< who has proved to have sent it (SealedLink); 0: nobody
};

/// One datagram of a batch that is to be sent. `bytes` have to stay until send_batch() returns.
struct OutgoingDatagram {
  IpEndpoint to;
  std::span<const std::byte> bytes;
};

/// What became of a batch: the rest was refused, and is counted by its reason.
struct SentBatch {
  std::size_t datagrams{0}, octets{0};
};

/// What a datagram takes on the wire beyond its payload, which alone links and peers count: headers
/// of UDP and IPv4 [octets].
inline constexpr std::size_t kUdpIpv4Headers = 28;

/// What a link has counted since it was made; kernel_drops is loss by a full receive buffer.
/// A run that the kernel held as one counts once there, see docs/transport.md.
struct LinkStatistics {
  std::uint64_t sent{0}, sent_bytes{0};
  std::uint64_t send_errors{0};  ///< refused by the kernel, for whatever reason
  std::uint64_t too_big{0};      ///< of these: above the MTU (never fragmented)
  std::uint64_t send_calls{0};   ///< system calls that sent
  std::uint64_t held_back{0};    ///< not sent, for they would have waited too long for the wire
  std::uint64_t received{0}, received_bytes{0};
  std::uint64_t own{0};           ///< own datagrams looped back, not delivered
  std::uint64_t truncated{0};     ///< longer than a receive buffer, not delivered
  std::uint64_t kernel_drops{0};  ///< SO_RXQ_OVFL
  std::uint64_t receive_errors{0};
  std::uint64_t joins{0}, leaves{0}, join_errors{0};
  std::uint64_t interface_losses{0};  ///< times that the interface went away, down or bare
  std::uint64_t recoveries{0};        ///< times that all groups were joined again
  std::uint64_t lost_by_law{0}, duplicated_by_law{0};  ///< impairment: as asked for
  std::uint64_t queue_overflows{0};                    ///< impairment: bounded queue was full
  int last_send_error{0}, last_join_error{0};          ///< errno, no counts; 0: none yet

  /// Calls visit(name, value) for each of them.
  template <typename Visit>
  void for_each(Visit&& visit) const;
};

/// Something that befell a link and that it mends by itself, as a sentence for the user.
struct LinkEvent {
  std::array<char, 240> text{};  ///< NUL at the end; cut where it would be longer
};

/// Carries datagrams. Two threads may use one link: the reader (receive, wait, join, leave) and the
/// writer (send). wake() and statistics() are for any thread. Nothing but join and leave allocates.
class Link {
 public:
  virtual ~Link() = default;

  /// Sends one datagram to a group or to a peer's unicast endpoint. False where the kernel refused
  /// it, which is counted; the caller goes on (DIS repairs by the next update).
  virtual bool send(const IpEndpoint& to, std::span<const std::byte> bytes) noexcept = 0;

  /// Sends datagrams in their order, as send() would one after the other. A link that can hands
  /// many to the kernel at once. Any number; no allocation.
  virtual SentBatch send_batch(std::span<const OutgoingDatagram> batch) noexcept;

  /// Takes what has arrived, at most out.size(), without blocking; returns how many.
  virtual std::size_t receive(std::span<Datagram> out) noexcept = 0;

  /// Joins a group; joining twice is no error. Errors are returned and counted, see advice().
  virtual std::error_code join(const GroupAddress& group) noexcept = 0;
  /// Leaves a group; no error where it was not joined.
  virtual void leave(const GroupAddress& group) noexcept = 0;

  /// Blocks until something can be received, wake() is called or `timeout` is over; true in the
  /// first two cases. A simulated link never blocks. Zero only looks.
  virtual bool wait(std::chrono::nanoseconds timeout) noexcept = 0;
  /// Ends a wait() now or, where none is under way, the next one. Safe in a signal handler.
  virtual void wake() noexcept = 0;

  /// The own unicast endpoint: the sender of all that this link sends.
  [[nodiscard]] virtual IpEndpoint local_endpoint() const noexcept = 0;
  /// Largest payload [octets] that goes out unfragmented.
  [[nodiscard]] virtual std::size_t max_payload() const noexcept = 0;
  [[nodiscard]] virtual LinkStatistics statistics() const noexcept = 0;

  /// What befell the link since it was asked last, oldest first; false where there is nothing. One
  /// thread, any; no allocation. A link around another passes on what that one has to tell.
  virtual bool take_event(LinkEvent&) noexcept { return false; }

  /// Nobody will receive any more: counts what the kernel has dropped since the last datagram, and
  /// tells a tap of what was not read. By the thread of receive(), or when that has ended.
  virtual void settle() noexcept {}
};

/// What to do about an error of a join or of a send; empty where nothing is known. No allocation.
[[nodiscard]] std::string_view join_remedy(const std::error_code& error) noexcept;
[[nodiscard]] std::string_view send_remedy(const std::error_code& error) noexcept;

/// A sentence for the user: what went wrong at a join and what to do (the sysctl, the limit).
[[nodiscard]] std::string advice(const std::error_code& error, const GroupAddress& group);

template <typename Visit>
void LinkStatistics::for_each(Visit&& visit) const {
  visit("sent", sent);
  visit("sent_bytes", sent_bytes);
  visit("send_errors", send_errors);
  visit("too_big", too_big);
  visit("send_calls", send_calls);
  visit("held_back", held_back);
  visit("received", received);
  visit("received_bytes", received_bytes);
  visit("own", own);
  visit("truncated", truncated);
  visit("kernel_drops", kernel_drops);
  visit("receive_errors", receive_errors);
  visit("joins", joins);
  visit("leaves", leaves);
  visit("join_errors", join_errors);
  visit("interface_losses", interface_losses);
  visit("recoveries", recoveries);
  visit("lost_by_law", lost_by_law);
  visit("duplicated_by_law", duplicated_by_law);
  visit("queue_overflows", queue_overflows);
}

}  // namespace reckon::peer

/// So that endpoints can be keys of unordered containers.
template <>
struct std::hash<reckon::peer::IpEndpoint> {
  std::size_t operator()(const reckon::peer::IpEndpoint& endpoint) const noexcept;
};
