// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The receiving part of a UdpMulticast: messages of the kernel become datagrams. Private to the
// network.
#pragma once

#include <netinet/in.h>
#include <sys/socket.h>

#include <array>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <ctime>
#include <memory>
#include <span>

#include "reckon/peer/clocks/clock.hpp"
#include "reckon/peer/network/echo_watch.hpp"
#include "reckon/peer/network/link_counters.hpp"
#include "reckon/peer/network/link_tap.hpp"
#include "reckon/peer/network/local_endpoint.hpp"
#include "reckon/peer/network/udp_multicast.hpp"
#include "reckon/peer/network/udp_readiness.hpp"
#include "reckon/peer/network/udp_slot.hpp"

namespace reckon::peer {

/// Buffers into which messages are read, and from which they are cut into datagrams. Returned
/// datagrams are valid until recycle(). For the reading thread; only reserve() allocates.
class UdpReceiver {
 public:
  using nanoseconds = std::chrono::nanoseconds;

  /// References outlive this; of the options, batch, max_datagram and deliver_own are used.
  UdpReceiver(const UdpMulticastOptions& options, const Clock& clock, const UdpReadiness& ready,
              const LocalEndpoint& local, LinkTap& tap, EchoWatch& echo, LinkCounters& counts);

  /// Allocates the buffers; before the first read.
  /// @param coalesces messages may be runs of datagrams
  void reserve(bool coalesces);

  /// A turn of one socket: reads `most` messages or the limit of one turn, and appends their
  /// datagrams to the `delivered` ones in `out`. @returns their new number
  std::size_t take_turn(UdpSlot& slot, std::span<Datagram> out, std::size_t delivered,
                        std::size_t most) noexcept;
  /// Returns datagrams that were read; @returns as take_turn().
  std::size_t hand_over(std::span<Datagram> out, std::size_t delivered) noexcept;
  /// Frees the buffers if all their datagrams were returned.
  void recycle() noexcept {
    if (next_arrived_ == arrived_count_) arrived_count_ = next_arrived_ = 0;
  }
  /// Messages read since the buffers were free.
  [[nodiscard]] std::size_t messages() const noexcept { return arrived_count_; }
  [[nodiscard]] bool is_full() const noexcept { return arrived_count_ == batch_; }
  /// Whether the last turn left nothing in its socket.
  [[nodiscard]] bool has_emptied() const noexcept { return emptied_; }
  /// Whether there are datagrams that were read and not returned.
  [[nodiscard]] bool has_arrived() const noexcept;

  /// Index of the interface over which a datagram of this receiver came, as long as it is valid; 0
  /// if its socket does not report it.
  [[nodiscard]] unsigned interface_of(const Datagram& datagram) const noexcept;

  /// Discards the unreturned datagrams of a group that was left.
  void forget(const GroupAddress& group) noexcept;
  /// The last read of a socket: counts the kernel's drops after the last datagram, and for a tap
  /// the datagrams pending in it, which are not read any more. Does nothing if it is closed.
  void settle(UdpSlot& slot) noexcept;

 private:
  /// A datagram in a buffer, or several that came as one (UDP_GRO), of which some may already be
  /// returned.
  struct Arrived {
    GroupAddress group;
    IpEndpoint sender;
    nanoseconds received{0};
    std::size_t length{0}, segment{0};  // [octets] of all, and of each but the last
    std::size_t taken{0};               // [octets] returned
    std::size_t left{0};                // datagrams still to be returned
    unsigned interface = 0;             // its index, if the socket reports it
  };
  /// Arrival stamp (timespec), drop count (u32), length of a segment and interface (the longer of
  /// the two forms), each with its header.
  static constexpr std::size_t kControlBytes =
      CMSG_SPACE(sizeof(timespec)) + CMSG_SPACE(sizeof(std::uint32_t)) + CMSG_SPACE(sizeof(int)) +
      CMSG_SPACE(sizeof(in6_pktinfo));
  struct alignas(cmsghdr) Control {
    std::array<std::byte, kControlBytes> bytes;
  };

  void take(UdpSlot& slot, std::size_t count) noexcept;
  void accept(UdpSlot& slot, std::size_t buffer, nanoseconds now, nanoseconds utc) noexcept;
  void read_control(UdpSlot& slot, const msghdr& header, nanoseconds utc, Arrived& out) noexcept;
  void count_drops(UdpSlot& slot, std::uint32_t drops) noexcept;
  void pass_over(Arrived& run, const std::byte* start, DatagramFate fate) noexcept;
  [[nodiscard]] const std::byte* start_of(std::size_t buffer) const noexcept {
    return buffers_.get() + buffer * buffer_size_;
  }

  std::size_t batch_, max_datagram_;
  bool emptied_ = true;
  bool deliver_own_;
  const Clock& clock_;
  const UdpReadiness& ready_;
  const LocalEndpoint& local_;
  LinkTap& tap_;
  EchoWatch& echo_;
  LinkCounters& counts_;

  std::size_t buffer_size_ = 0;           // [octets] of each; room for a run if there may be any
  std::unique_ptr<std::byte[]> buffers_;  // pages are taken as they are used
  std::array<Arrived, kMaxBatch> arrived_{};  // content of each buffer
  std::size_t arrived_count_ = 0, next_arrived_ = 0;
  std::array<mmsghdr, kMaxBatch> messages_{};
  std::array<iovec, kMaxBatch> vectors_{};
  std::array<sockaddr_storage, kMaxBatch> senders_{};
  std::array<Control, kMaxBatch> controls_{};
};

}  // namespace reckon::peer
