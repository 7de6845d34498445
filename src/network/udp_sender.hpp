// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The sending part of a UdpMulticast: one socket, many datagrams in one system call, and no more
// than the wire takes. Private to the network.
#pragma once

#include <array>
#include <atomic>
#include <cstddef>
#include <span>

#include "reckon/peer/clocks/clock.hpp"
#include "reckon/peer/network/echo_watch.hpp"
#include "reckon/peer/network/link_counters.hpp"
#include "reckon/peer/network/link_tap.hpp"
#include "reckon/peer/network/send_pace.hpp"
#include "reckon/peer/network/udp_send_batch.hpp"

namespace reckon::peer {

/// Output of a UdpSender.
struct UdpOutput {
  int socket{-1};               ///< descriptor, whose number never changes
  unsigned interface_index{0};  ///< scope of link-local IPv6
  std::size_t max_payload{0};   ///< [octets] that are sent unfragmented
  int segment_refusal{0};       ///< errno of the refusal to cut runs (UDP_SEGMENT); 0: they are cut
};

/// For the writing thread, unless noted. No allocation.
class UdpSender {
 public:
  /// References outlive this.
  UdpSender(const UdpOutput& output, const Clock& clock, LinkTap& tap, EchoWatch& echo,
            LinkCounters& counts);

  /// Sends one datagram by the shorter path; false if it is held back or the kernel refuses it.
  bool send(const OutgoingDatagram& datagram) noexcept;
  /// Sends all in their order; held back and refused ones are omitted and counted.
  SentBatch send_batch(std::span<const OutgoingDatagram> batch) noexcept;

  [[nodiscard]] std::size_t max_payload() const noexcept { return max_payload_; }
  /// errno with which the kernel refused to cut runs, 0: it cuts them. Any thread.
  [[nodiscard]] int segment_refusal() const noexcept {
    return segment_refusal_.load(std::memory_order_relaxed);
  }
  /// Of a new socket with that number; any thread.
  void set_segment_refusal(int error) noexcept { segment_refusal_ = error; }
  /// Sets another index of the interface; any thread.
  void set_interface(unsigned index) noexcept {
    interface_index_.store(index, std::memory_order_relaxed);
  }

 private:
  [[nodiscard]] std::size_t queued() const noexcept;
  void count_sent(const OutgoingDatagram& datagram) noexcept;
  void count_refused(std::span<const OutgoingDatagram> datagrams, int error) noexcept;
  bool send_alone(const OutgoingDatagram& datagram) noexcept;
  std::size_t choose_going(std::span<const OutgoingDatagram> batch, std::size_t waiting) noexcept;
  SentBatch send_going(std::size_t count) noexcept;
  void send_uncut(std::span<const OutgoingDatagram> run, int why, SentBatch& sent) noexcept;

  int socket_;
  std::size_t max_payload_;
  std::atomic<unsigned> interface_index_;
  std::atomic<int> segment_refusal_;
  const Clock& clock_;
  LinkTap& tap_;
  EchoWatch& echo_;
  LinkCounters& counts_;
  SendPace pace_;
  UdpSendBatch outgoing_;
  std::array<OutgoingDatagram, kMaxBatch> going_{};
};

}  // namespace reckon::peer
