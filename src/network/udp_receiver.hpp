// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// How a UdpMulticast receives: messages of the kernel become datagrams. Private to the network.
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

/// Buffers that messages are read into, and cut into datagrams. What is handed up stays as it is
/// until recycle(). The reading thread's; allocates in reserve() alone.
class UdpReceiver {
 public:
  using nanoseconds = std::chrono::nanoseconds;

  /// References outlive this; of the options batch, max_datagram and deliver_own are used.
  UdpReceiver(const UdpMulticastOptions& options, const Clock& clock, const UdpReadiness& ready,
              const LocalEndpoint& local, LinkTap& tap, EchoWatch& echo, LinkCounters& counts);

  /// Makes the buffers; before the first read. @param coalesces messages may be runs of datagrams
  void reserve(bool coalesces);

  /// A turn of one socket: reads `most` messages or what one turn allows, and hands their datagrams
  /// up behind the `delivered` that `out` has. @returns how many it has then
  std::size_t take_turn(UdpSlot& slot, std::span<Datagram> out, std::size_t delivered,
                        std::size_t most) noexcept;
  /// Hands up what has been read; @returns as take_turn().
  std::size_t hand_over(std::span<Datagram> out, std::size_t delivered) noexcept;
  /// Gives the buffers free, where all that is in them was handed up.
  void recycle() noexcept {
    if (next_arrived_ == arrived_count_) arrived_count_ = next_arrived_ = 0;
  }
  /// Messages that have been read since the buffers were free.
  [[nodiscard]] std::size_t messages() const noexcept { return arrived_count_; }
  [[nodiscard]] bool is_full() const noexcept { return arrived_count_ == batch_; }
  /// Whether there are datagrams that were read and not handed up.
  [[nodiscard]] bool has_arrived() const noexcept;

  /// What a group that is left still has waiting here is not handed up.
  void forget(const GroupAddress& group) noexcept;
  /// The last look at a socket: what the kernel dropped behind the last datagram, and, for a tap,
  /// what waits in it, which is not read any more. Nothing where it is closed.
  void settle(UdpSlot& slot) noexcept;

 private:
  /// A datagram in a buffer, or several that came as one (UDP_GRO), of which some may have been
  /// handed up.
  struct Arrived {
    GroupAddress group;
    IpEndpoint sender;
    nanoseconds received{0};
    std::size_t length{0}, segment{0};  // [octets] of all, and of each but the last
    std::size_t taken{0};               // [octets] handed up
    std::size_t left{0};                // datagrams still to be handed up
  };
  /// Arrival stamp (timespec), drop count (u32) and length of a segment, each with its header.
  static constexpr std::size_t kControlBytes =
      CMSG_SPACE(sizeof(timespec)) + CMSG_SPACE(sizeof(std::uint32_t)) + CMSG_SPACE(sizeof(int));
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
  bool deliver_own_;
  const Clock& clock_;
  const UdpReadiness& ready_;
  const LocalEndpoint& local_;
  LinkTap& tap_;
  EchoWatch& echo_;
  LinkCounters& counts_;

  std::size_t buffer_size_ = 0;           // [octets] of each; room for a run where those may come
  std::unique_ptr<std::byte[]> buffers_;  // pages are taken as they are used
  std::array<Arrived, kMaxBatch> arrived_{};  // what is in each buffer
  std::size_t arrived_count_ = 0, next_arrived_ = 0;
  std::array<mmsghdr, kMaxBatch> messages_{};
  std::array<iovec, kMaxBatch> vectors_{};
  std::array<sockaddr_storage, kMaxBatch> senders_{};
  std::array<Control, kMaxBatch> controls_{};
};

}  // namespace reckon::peer
