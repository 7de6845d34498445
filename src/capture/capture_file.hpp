// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Captures of libpcap: files (pcap, pcapng), stdin and interfaces, and the way from a captured
// frame to its UDP payload.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>

#include "reckon/peer/capture/datagram_source.hpp"

namespace reckon::peer {

/// Opens a pcap or pcapng file, plain or compressed by zstd; "-" is stdin. Link types: Ethernet
/// (with VLAN tags), raw IP, Linux cooked 1 and 2, BSD loopback. @throws std::runtime_error with
/// path and reason where it is none. `follow`: the file, a plain one, may be growing, so its end,
/// or a frame that is not whole yet, is no end: the source is live and gives nothing_yet there.
/// Stdin is followed anyway.
[[nodiscard]] std::unique_ptr<DatagramSource> open_capture(const std::string& path,
                                                           bool follow = false);

/// Captures the UDP frames of an interface. @throws std::runtime_error with the remedy
/// (CAP_NET_RAW).
[[nodiscard]] std::unique_ptr<DatagramSource> open_interface_capture(const std::string& name);

/// How a frame begins.
enum class LinkLayer : std::uint8_t {
  ethernet,
  raw_ip,
  linux_cooked,
  linux_cooked_2,
  bsd_loopback
};

/// What a frame holds.
enum class FrameContent : std::uint8_t { udp, not_udp, malformed };

/// Finds the UDP payload of one frame; `on_wire` is its length before the capture cut it [octets].
/// Fills all of `out` but frame and time. Reads inside `frame` only, whatever its octets say.
[[nodiscard]] FrameContent parse_frame(LinkLayer layer, std::span<const std::byte> frame,
                                       std::size_t on_wire, SourceDatagram& out) noexcept;

}  // namespace reckon::peer
