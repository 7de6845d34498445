// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Transport of octets between peers: groups, datagrams, and the Link that carries them.
// UdpMulticast is the real link, SimulatedNetwork has links inside a process, ImpairedLink wraps
// any link.
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
  /// True if no address is set (0.0.0.0 or ::).
  [[nodiscard]] bool is_unspecified() const noexcept;

  /// Reads "239.192.1.0", "239.192.1.0:3000", "ff15::1", "[ff15::1]:3000"; without a port it uses
  /// `default_port`. Nothing if the text has another form.
  [[nodiscard]] static std::optional<IpEndpoint> parse(std::string_view text,
                                                       std::uint16_t default_port = 0);
  /// From a host-order IPv4 address.
  [[nodiscard]] static IpEndpoint v4(std::uint32_t address, std::uint16_t port) noexcept;

  /// "239.192.1.0" or "ff15::1".
  [[nodiscard]] std::string address_text() const;
  /// "239.192.1.0:3000" or "[ff15::1]:3000".
  [[nodiscard]] std::string text() const;
};

/// An endpoint whose address is a multicast group, or all of the LAN if multicast is disabled.
using GroupAddress = IpEndpoint;

/// The groups of one world: a base group for presence and `size` groups behind it for the cells.
class GroupPool {
 public:
  static constexpr std::uint16_t kDefaultPort = 3000;
  static constexpr std::size_t kDefaultSize = 256;

  /// 239.192.1.0:3000 and 256 groups after it (239.192.1.1 to 239.192.2.0).
  [[nodiscard]] static GroupPool ipv4_default() noexcept;
  /// [ff15::c0:100]:3000 and 256 groups after it; with c0:100, no Ethernet address of the pool is
  /// one that every switch floods (33:33:00:00:00:xx).
  [[nodiscard]] static GroupPool ipv6_default() noexcept;

  /// The broadcast address has no further groups, regardless of `size`: only its base is used.
  /// @throws std::invalid_argument if base is neither a multicast group nor the broadcast address,
  /// its port is 0, size is 0 or above 65535, or the last group would leave the multicast range.
  GroupPool(const GroupAddress& base, std::size_t size);

  /// The group of presence announcements.
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

/// Longest payload that peers send or accept [octets]: above the 8192 of a DIS bundle.
inline constexpr std::size_t kMaxDatagram = 9216;

/// One datagram as received. `bytes` stays valid until the next receive() of the same link.
struct Datagram {
  GroupAddress group;                 ///< destination; the link's own endpoint if unicast
  IpEndpoint sender;                  ///< the unicast endpoint for replies
  std::span<const std::byte> bytes;   ///< UDP payload
  std::chrono::nanoseconds received;  ///< arrival by the link's clock, steady (kernel time if real)
  std::uint64_t boot{0};              ///< proven sender (SealedLink); 0: none
};

/// One datagram of a batch to send. `bytes` must be valid until send_batch() returns.
struct OutgoingDatagram {
  IpEndpoint to;
  std::span<const std::byte> bytes;
};

/// Result of a batch: datagrams that were not sent are counted by reason.
struct SentBatch {
  std::size_t datagrams{0}, octets{0};
};

/// Headers of UDP and IPv4 [octets], which links and peers do not count with the payload.
inline constexpr std::size_t kUdpIpv4Headers = 28;

/// Counts of a link since its construction; kernel_drops is loss by a full receive buffer. A run
/// that the kernel held as one counts once there, see docs/transport.md.
struct LinkStatistics {
  std::uint64_t sent{0}, sent_bytes{0};
  std::uint64_t send_errors{0};  ///< refused by the kernel for any reason
  std::uint64_t too_big{0};      ///< of these: above the MTU (never fragmented)
  std::uint64_t send_calls{0};   ///< system calls that sent
  std::uint64_t held_back{0};    ///< not sent, because they would have waited too long for the wire
  std::uint64_t received{0}, received_bytes{0};
  std::uint64_t own{0};           ///< own datagrams looped back, not delivered
  std::uint64_t truncated{0};     ///< longer than a receive buffer, not delivered
  std::uint64_t kernel_drops{0};  ///< SO_RXQ_OVFL
  std::uint64_t receive_errors{0};
  std::uint64_t joins{0}, leaves{0}, join_errors{0};
  std::uint64_t interface_losses{0};  ///< times that the interface was gone, down or bare
  std::uint64_t recoveries{0};        ///< times that all groups were joined again
  std::uint64_t lost_by_law{0}, duplicated_by_law{0};  ///< impairment: as configured
  std::uint64_t queue_overflows{0};                    ///< impairment: bounded queue was full
  int last_send_error{0}, last_join_error{0};          ///< errno, no counts; 0: none yet

  /// Calls visit(name, meaning, value) for each count; both texts are literals.
  void for_each(auto&& visit) const;
};

/// An event of a link that it repairs by itself, as a sentence for the user.
struct LinkEvent {
  std::array<char, 240> text{};  ///< NUL at the end; longer text is cut
};

/// Transports datagrams. Two threads may use one link: the reader (receive, wait, join, leave) and
/// the writer (send). wake() and statistics() are for any thread. Only join and leave allocate.
class Link {
 public:
  virtual ~Link() = default;

  /// Sends one datagram to a group or to a peer's unicast endpoint. False if the kernel refused it,
  /// which is counted; the caller continues (the next update repairs it).
  virtual bool send(const IpEndpoint& to, std::span<const std::byte> bytes) noexcept = 0;

  /// Sends datagrams in their order, with the effect of send() for each. A link may hand many to
  /// the kernel at once. Any number; no allocation.
  virtual SentBatch send_batch(std::span<const OutgoingDatagram> batch) noexcept;

  /// Takes arrived datagrams, at most out.size(), without blocking; returns their number.
  virtual std::size_t receive(std::span<Datagram> out) noexcept = 0;

  /// Joins a group; joining twice is no error. Errors are returned and counted, see advice().
  virtual std::error_code join(const GroupAddress& group) noexcept = 0;
  /// Leaves a group; no error if it was not joined.
  virtual void leave(const GroupAddress& group) noexcept = 0;

  /// Blocks until a datagram can be received, wake() is called or `timeout` is over; true in the
  /// first two cases. A simulated link never blocks. Zero only polls.
  virtual bool wait(std::chrono::nanoseconds timeout) noexcept = 0;
  /// Ends the present wait(), or the next one if there is none. Safe in a signal handler.
  virtual void wake() noexcept = 0;

  /// The own unicast endpoint: the source of all sent datagrams.
  [[nodiscard]] virtual IpEndpoint local_endpoint() const noexcept = 0;
  /// Largest payload [octets] that is sent unfragmented.
  [[nodiscard]] virtual std::size_t max_payload() const noexcept = 0;
  [[nodiscard]] virtual LinkStatistics statistics() const noexcept = 0;
  /// Whether send() reaches a peer's unicast endpoint, as well as groups.
  [[nodiscard]] virtual bool reaches_hosts() const noexcept { return true; }

  /// Takes the events of the link since the last call, oldest first; false if there are none. One
  /// thread, any; no allocation. A link around another one forwards the events of the inner link.
  virtual bool take_event(LinkEvent&) noexcept { return false; }

  /// For the end of reception: counts the datagrams that the kernel has dropped since the last one,
  /// and reports unread datagrams to a tap. By the thread of receive(), or after its end.
  virtual void settle() noexcept {}
};

/// A link around another one: what it does not override is the inner link's. A batch is sent one by
/// one by its own send(), unless it overrides send_batch() too.
class LinkAround : public Link {
 public:
  /// @param inner outlives this
  explicit LinkAround(Link& inner) noexcept : around_(inner) {}

  bool send(const IpEndpoint& to, std::span<const std::byte> bytes) noexcept override {
    return around_.send(to, bytes);
  }
  std::error_code join(const GroupAddress& group) noexcept override { return around_.join(group); }
  void leave(const GroupAddress& group) noexcept override { around_.leave(group); }
  bool wait(std::chrono::nanoseconds timeout) noexcept override { return around_.wait(timeout); }
  void wake() noexcept override { around_.wake(); }
  [[nodiscard]] IpEndpoint local_endpoint() const noexcept override {
    return around_.local_endpoint();
  }
  [[nodiscard]] LinkStatistics statistics() const noexcept override { return around_.statistics(); }
  [[nodiscard]] bool reaches_hosts() const noexcept override { return around_.reaches_hosts(); }
  bool take_event(LinkEvent& event) noexcept override { return around_.take_event(event); }
  void settle() noexcept override { around_.settle(); }

 private:
  Link& around_;
};

/// Remedy for an error of a join or of a send; empty if none is known. No allocation.
[[nodiscard]] std::string_view join_remedy(const std::error_code& error) noexcept;
[[nodiscard]] std::string_view send_remedy(const std::error_code& error) noexcept;

/// A sentence for the user: the error of a join and its remedy (the sysctl, the limit).
[[nodiscard]] std::string advice(const std::error_code& error, const GroupAddress& group);

void LinkStatistics::for_each(auto&& visit) const {
  visit("sent", "datagrams sent", sent);
  visit("sent_bytes", "octets of UDP payload sent", sent_bytes);
  visit("send_errors", "datagrams refused by the kernel for any reason", send_errors);
  visit("too_big", "of these, datagrams above the MTU", too_big);
  visit("send_calls", "system calls that sent", send_calls);
  visit("held_back",
        "datagrams not sent, because they would have waited too long for the interface", held_back);
  visit("received", "datagrams received", received);
  visit("received_bytes", "octets of UDP payload received", received_bytes);
  visit("own", "own datagrams looped back, not delivered", own);
  visit("truncated", "datagrams longer than a receive buffer, not delivered", truncated);
  visit("kernel_drops", "datagrams lost because the receive buffer was full", kernel_drops);
  visit("receive_errors", "errors of receiving", receive_errors);
  visit("joins", "groups joined", joins);
  visit("leaves", "groups left", leaves);
  visit("join_errors", "groups that could not be joined", join_errors);
  visit("interface_losses", "times that the interface was missing, down or without an address",
        interface_losses);
  visit("recoveries", "times that all groups were joined again", recoveries);
  visit("lost_by_law", "datagrams lost by the configured impairment", lost_by_law);
  visit("duplicated_by_law", "datagrams duplicated by the configured impairment",
        duplicated_by_law);
  visit("queue_overflows", "datagrams dropped because the queue of the impairment was full",
        queue_overflows);
}

}  // namespace reckon::peer

/// Makes endpoints usable as keys of unordered containers.
template <>
struct std::hash<reckon::peer::IpEndpoint> {
  std::size_t operator()(const reckon::peer::IpEndpoint& endpoint) const noexcept;
};
