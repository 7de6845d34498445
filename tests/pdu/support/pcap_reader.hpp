// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Reads just the format of the reference captures: little-endian pcap, Ethernet, IPv4, UDP.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <stdexcept>
#include <string>
#include <vector>

namespace reckon::test {

inline std::vector<std::byte> file_octets(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  if (!file) throw std::runtime_error("cannot read " + path.string());
  const std::string text{std::istreambuf_iterator<char>(file), {}};
  std::vector<std::byte> octets(text.size());
  std::memcpy(octets.data(), text.data(), text.size());
  return octets;
}

/// The UDP payloads of a capture, in order.
inline std::vector<std::vector<std::byte>> udp_payloads(const std::filesystem::path& path) {
  constexpr std::size_t kFileHeader = 24;
  constexpr std::size_t kPacketHeader = 16;
  constexpr std::size_t kEthernetIpUdp = 14 + 20 + 8;
  const auto octets = file_octets(path);
  std::uint32_t magic = 0;
  std::memcpy(&magic, octets.data(), sizeof magic);
  if (magic != 0xA1B2C3D4 && magic != 0xA1B23C4D) throw std::runtime_error("not a plain pcap file");

  std::vector<std::vector<std::byte>> payloads;
  for (std::size_t at = kFileHeader; at + kPacketHeader <= octets.size();) {
    std::uint32_t captured = 0;
    std::memcpy(&captured, octets.data() + at + 8, sizeof captured);
    at += kPacketHeader;
    if (at + captured > octets.size() || captured < kEthernetIpUdp)
      throw std::runtime_error("a packet of " + path.string() + " is cut");
    const auto* udp = octets.data() + at;
    payloads.emplace_back(udp + kEthernetIpUdp, udp + captured);
    at += captured;
  }
  return payloads;
}

}  // namespace reckon::test
