// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Captures by libpcap: files (pcap, pcapng), stdin and interfaces.
#pragma once

#include <memory>
#include <string>

#include "reckon/peer/capture/datagram_source.hpp"

namespace reckon::peer {

/// Opens a pcap or pcapng file, plain or compressed by zstd, gzip, bzip2, xz or lz4; "-" is stdin.
/// Link types, also several in one pcapng file: Ethernet, raw IP, Linux cooked 1 and 2 (with VLAN
/// tags), BSD loopback. IP fragments are reassembled.
/// @param follow whether the plain file may be growing: its end, or an incomplete frame, is then
/// not the end; the source is live and returns nothing_yet there. Stdin is always followed.
/// @throws std::runtime_error with path and reason if it is no capture.
[[nodiscard]] std::unique_ptr<DatagramSource> open_capture(const std::string& path,
                                                           bool follow = false);

/// Captures the UDP frames of an interface. @throws std::runtime_error with the remedy
/// (CAP_NET_RAW).
[[nodiscard]] std::unique_ptr<DatagramSource> open_interface_capture(const std::string& name);

}  // namespace reckon::peer
