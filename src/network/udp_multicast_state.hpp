// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// What a UdpMulticast holds. Private to the network: udp_multicast.cpp opens it,
// udp_sending.cpp and udp_receiving.cpp do the two threads' parts of it, udp_recovery.cpp keeps it
// alive when the host changes.
#pragma once

#include <netinet/in.h>
#include <sys/epoll.h>
#include <sys/eventfd.h>
#include <sys/socket.h>

#include <array>
#include <asio/io_context.hpp>
#include <asio/ip/udp.hpp>
#include <atomic>
#include <ctime>
#include <memory>
#include <mutex>
#include <string>
#include <string_view>
#include <vector>

#include "reckon/haptics/exchange/spsc_ring.hpp"
#include "reckon/peer/network/datagram_tap.hpp"
#include "reckon/peer/network/descriptor.hpp"
#include "reckon/peer/network/echo_watch.hpp"
#include "reckon/peer/network/fan_out_link.hpp"
#include "reckon/peer/network/interface_watch.hpp"
#include "reckon/peer/network/link_counters.hpp"
#include "reckon/peer/network/send_pace.hpp"
#include "reckon/peer/network/udp_multicast.hpp"
#include "reckon/peer/network/udp_send_batch.hpp"
#include "reckon/peer/network/udp_socket.hpp"

namespace reckon::peer {

/// One open socket: slot 0 sends and takes unicast, the others are groups.
struct Slot {
  asio::ip::udp::socket socket;
  GroupAddress group;
  std::uint32_t drops_seen{0};
  std::chrono::nanoseconds empty{0};  ///< when nothing waited in it last
  bool brings_runs{false};            ///< its last message was several datagrams in one
  bool first{false};                  ///< it is read before the others
};

/// A datagram in a buffer, or several that came as one (UDP_GRO), of which some may have been
/// handed up.
struct Arrived {
  GroupAddress group;
  IpEndpoint sender;
  std::chrono::nanoseconds received{0};
  std::size_t length{0}, segment{0};  ///< [octets] of all, and of each but the last
  std::size_t taken{0};               ///< [octets] handed up
  std::size_t left{0};                ///< datagrams still to be handed up
};

/// All of it belongs to the reading thread, except what says otherwise. The writing thread sends by
/// the descriptor of slot 0, whose number never changes.
struct UdpMulticast::State {
  using nanoseconds = std::chrono::nanoseconds;
  /// Arrival stamp (timespec), drop count (u32) and length of a segment, each with its header.
  static constexpr std::size_t kControlBytes =
      CMSG_SPACE(sizeof(timespec)) + CMSG_SPACE(sizeof(std::uint32_t)) + CMSG_SPACE(sizeof(int));

  State(const UdpMulticastOptions& asked, const Clock& steady);

  bool watch(const Descriptor& where, int descriptor, std::uint32_t tag) noexcept;
  bool watch(std::size_t slot) noexcept;
  void poll(nanoseconds timeout) noexcept;
  bool drain_wake() noexcept;
  Slot* find(const GroupAddress& group) noexcept;
  std::error_code open(const GroupAddress& group) noexcept;
  /// Tells the tap that a group is joined or left: the kernel was asked to, and had done so.
  void tell_membership(DatagramFate change, const GroupAddress& group, nanoseconds asked,
                       nanoseconds done) noexcept;
  std::error_code adopt(asio::ip::udp::socket socket, const GroupAddress& group);
  void take_local_endpoint();
  void warn(const UdpMulticastOptions& asked);
  void measure_payload() noexcept;

  /// Tells the tap, where there is one.
  void note(DatagramTap::Loop loop, DatagramFate fate, const IpEndpoint& place,
            std::span<const std::byte> bytes) noexcept {
    if (options.tap == nullptr) return;
    if (!options.framed) return options.tap->note(loop, fate, place, bytes);
    const SaidInFront said = said_in_front(bytes, *options.framed);
    options.tap->note(loop, fate, said.place ? said.group : place, said.bytes);
  }

  // The reading thread: udp_receiving.cpp.
  void take(std::size_t slot, std::size_t count) noexcept;
  void accept(Slot& slot, std::size_t buffer, nanoseconds now, nanoseconds utc) noexcept;
  void read_control(Slot& slot, const msghdr& header, nanoseconds utc, Arrived& out) noexcept;
  [[nodiscard]] bool reads_first(const GroupAddress& group) const noexcept {
    return options.read_first && options.read_first->index(group).has_value();
  }
  std::size_t take_first(std::span<Datagram> out, std::size_t delivered, std::size_t most) noexcept;
  std::size_t take_turn(std::size_t slot, std::span<Datagram> out, std::size_t delivered,
                        std::size_t most) noexcept;
  std::size_t hand_over(std::span<Datagram> out, std::size_t delivered) noexcept;
  void count_drops(Slot& slot, std::uint32_t drops) noexcept;
  void settle(Slot& slot) noexcept;
  void close(Slot& slot) noexcept;
  void pass_over(Arrived& run, const std::byte* start, DatagramFate fate) noexcept;
  void forget(const GroupAddress& group) noexcept;
  [[nodiscard]] const std::byte* start_of(std::size_t buffer) const noexcept {
    return buffers.get() + buffer * buffer_size;
  }
  [[nodiscard]] bool has_arrived() const noexcept;

  // The writing thread: udp_sending.cpp.
  std::size_t queued() noexcept;
  void count_sent(const OutgoingDatagram& datagram) noexcept;
  void count_refused(std::span<const OutgoingDatagram> datagrams, int error) noexcept;
  bool send_alone(const OutgoingDatagram& datagram) noexcept;
  std::size_t choose_going(std::span<const OutgoingDatagram> batch, std::size_t waiting) noexcept;
  SentBatch send_going(std::size_t count) noexcept;
  void send_uncut(std::span<const OutgoingDatagram> run, int why, SentBatch& sent) noexcept;

  // The host changes: udp_recovery.cpp.
  void recover() noexcept;
  void look_at_host(nanoseconds now);
  void follow(const NetworkInterface& found);
  std::error_code reopen_sender(const IpEndpoint& address);
  void rejoin();
  void retry_groups();
  void lose(const InterfaceStanding& standing, nanoseconds now);
  void look_for_echo(nanoseconds now);
  void tell(std::string_view sentence) noexcept;
  void tell_of_offload();
  void tell_hindrance(const char* what) noexcept;
  [[nodiscard]] std::string groups_text() const;

  UdpMulticastOptions options;
  const Clock& clock;
  InterfaceChoice choice;
  UdpSocketOptions socket_options;
  std::atomic<unsigned> interface_index;  ///< any thread reads
  asio::io_context context{1};  // owns the sockets; its own loop never runs, see docs/transport.md
  std::vector<Slot> slots;
  mutable std::mutex naming;  ///< held to write `local`, and by other threads to read it
  IpEndpoint local;
  std::size_t mtu{0};
  std::size_t receive_buffer{0};
  std::vector<std::string> warnings;
  LinkCounters counts;
  /// errno by which the kernel refused to cut, 0: it does. The writing thread sets it.
  std::atomic<int> segment_refusal{0};
  bool segment_told{false};  ///< that it refused
  std::size_t max_payload{0};

  SendPace pace;  ///< the writing thread's, like the next two
  UdpSendBatch outgoing;
  std::array<OutgoingDatagram, kMaxBatch> going{};

  Descriptor epoll{epoll_create1(EPOLL_CLOEXEC), "epoll_create1"};
  /// Of the sockets that are read before the others; one of those of `epoll`.
  Descriptor first_epoll{epoll_create1(EPOLL_CLOEXEC), "epoll_create1"};
  bool first_ready{false};  ///< when `epoll` was looked at last
  Descriptor wake{eventfd(0, EFD_NONBLOCK | EFD_CLOEXEC), "eventfd"};
  std::array<epoll_event, kMaxBatch> events{};
  std::size_t event_count{0};
  std::size_t next_event{0};
  bool woken{false};
  nanoseconds all_empty{0};  ///< when nothing waited in any socket last

  NetworkInterface used{choice.interface};
  InterfaceWatch host;
  bool told_by_kernel{false};  ///< else it is looked at each second
  bool host_changed{false};
  bool away{false};      ///< the interface carries nothing
  bool hindered{false};  ///< the last look at the host failed, and that is reported
  nanoseconds away_since{0};
  nanoseconds next_look{0};
  std::vector<GroupAddress> unjoined;  ///< lost with the interface and not back yet
  EchoWatch echo;
  haptics::SpscRing<LinkEvent> link_events{32};

  std::size_t buffer_size{0};            ///< [octets] of each; room for a run where those may come
  std::unique_ptr<std::byte[]> buffers;  ///< `batch` of them; pages are taken as they are used
  std::array<Arrived, kMaxBatch> arrived{};  ///< what is in each buffer
  std::size_t arrived_count{0};
  std::size_t next_arrived{0};
  std::array<mmsghdr, kMaxBatch> messages{};
  std::array<iovec, kMaxBatch> vectors{};
  std::array<sockaddr_storage, kMaxBatch> senders{};
  struct alignas(cmsghdr) Control {
    std::array<std::byte, kControlBytes> bytes;
  };
  std::array<Control, kMaxBatch> controls{};
};

}  // namespace reckon::peer
