// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Many datagrams in one system call: runs of one length to one group become one message that the
// kernel cuts (UDP_SEGMENT); the rest is sent as it is. Private to the peer library.
#pragma once

#include <netinet/in.h>
#include <sys/socket.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "reckon/peer/network/link.hpp"

namespace reckon::peer {

/// Most datagrams of one system call.
inline constexpr std::size_t kMaxBatch = 64;

/// Limits of UDP_SEGMENT: segments (kernels before 6.9), and octets of one IPv4 packet.
inline constexpr std::size_t kMostSegments = 64, kMostSegmented = 65507;

/// Number of datagrams at the front of `batch`, not empty, that the kernel can cut from one
/// message. They go to one endpoint and have one length that is neither 0 nor above `max_payload`;
/// the last one may be shorter. 1 if the first one has to be sent alone.
[[nodiscard]] std::size_t segment_run(std::span<const OutgoingDatagram> batch,
                                      std::size_t max_payload) noexcept;

/// Messages for sendmmsg, with the datagrams of each. One thread; no allocation.
class UdpSendBatch {
 public:
  /// Plans a new batch.  @param batch up to kMaxBatch, valid until they are sent
  /// @param max_payload of a segment; 0: none are made
  void plan(std::span<const OutgoingDatagram> batch, std::size_t max_payload,
            unsigned interface_index) noexcept;

  [[nodiscard]] std::span<mmsghdr> messages() noexcept {
    return std::span(messages_).first(count_);
  }
  [[nodiscard]] std::span<const OutgoingDatagram> carried(std::size_t message) const noexcept {
    return batch_.subspan(first_[message], first_[message + 1] - first_[message]);
  }

 private:
  void add(std::size_t first, std::size_t count, unsigned interface_index) noexcept;

  struct alignas(cmsghdr) Control {
    std::array<std::byte, CMSG_SPACE(sizeof(std::uint16_t))> bytes;
  };

  std::span<const OutgoingDatagram> batch_;
  std::size_t count_ = 0;
  std::array<std::size_t, kMaxBatch + 1> first_{};
  std::array<mmsghdr, kMaxBatch> messages_{};
  std::array<iovec, kMaxBatch> vectors_{};
  std::array<sockaddr_storage, kMaxBatch> addresses_{};
  std::array<Control, kMaxBatch> controls_{};
};

}  // namespace reckon::peer
