// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/bench/studies/tracks/track_file.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <fstream>

namespace reckon::bench {
namespace {

/// Whether the file starts with the octets of a pcap, a pcapng or a zstd frame. False if it cannot
/// be read.
bool begins_as_capture(const std::filesystem::path& path) {
  constexpr std::array<std::uint32_t, 6> kMagic{0xA1B2C3D4, 0xD4C3B2A1, 0xA1B23C4D,
                                                0x4D3CB2A1, 0x0A0D0D0A, 0x28B52FFD};
  std::ifstream file(path, std::ios::binary);
  std::uint32_t begin = 0;
  for (int i = 0; i < 4; ++i) begin = begin << 8 | static_cast<std::uint32_t>(file.get() & 0xFF);
  return file.good() && std::find(kMagic.begin(), kMagic.end(), begin) != kMagic.end();
}

}  // namespace

TrackFile read_track_file(const std::filesystem::path& path) {
  const std::string name = path.string();
  const bool is_capture = name == "-" || name.starts_with("raw:") || name.starts_with("udp:") ||
                          name.starts_with("iface:") || begins_as_capture(path);
  return is_capture ? read_track_capture(path) : read_track_table(path);
}

}  // namespace reckon::bench
