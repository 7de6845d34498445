// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Captures by libpcap: files (pcap, pcapng), stdin and interfaces, and the parsing of a captured
// frame down to its UDP payload.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>

#include "reckon/peer/capture/datagram_source.hpp"

namespace reckon::peer {

/// Opens a pcap or pcapng file, plain or compressed by zstd; "-" is stdin. Link types: Ethernet
/// (with VLAN tags), raw IP, Linux cooked 1 and 2, BSD loopback.
/// @param follow whether the file, a plain one, may be growing: its end, or an incomplete frame, is
/// then no end, and the source is live and returns nothing_yet there. Stdin is always followed.
/// @throws std::runtime_error with path and reason if it is no capture.
[[nodiscard]] std::unique_ptr<DatagramSource> open_capture(const std::string& path,
                                                           bool follow = false);

/// Captures the UDP frames of an interface. @throws std::runtime_error with the remedy
/// (CAP_NET_RAW).
[[nodiscard]] std::unique_ptr<DatagramSource> open_interface_capture(const std::string& name);

/// First layer of a frame.
enum class LinkLayer : std::uint8_t {
  ethernet,
  raw_ip,
  linux_cooked,
  linux_cooked_2,
  bsd_loopback
};

/// Content of a frame.
enum class FrameContent : std::uint8_t { udp, not_udp, malformed };

/// Finds the UDP payload of one frame; `on_wire` is its length before the capture truncated it
/// [octets]. Fills all of `out` except frame and time. Reads only inside `frame`, whatever its
/// octets are.
[[nodiscard]] FrameContent parse_frame(LinkLayer layer, std::span<const std::byte> frame,
                                       std::size_t on_wire, SourceDatagram& out) noexcept;

}  // namespace reckon::peer
