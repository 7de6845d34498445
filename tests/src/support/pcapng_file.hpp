// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// A pcapng file that a test writes block by block.
#pragma once

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <fstream>
#include <string>

#include "reckon/peer/capture/capture_file.hpp"
#include "reckon/tests/src/support/capture_samples.hpp"
#include "reckon/tests/support/scratch_folder.hpp"

namespace reckon::peer::blocks {

using namespace frames;

inline constexpr std::uint16_t kEthernet = 1, kCooked = 113, kCooked2 = 276, kUsb = 220;

/// A pcapng file, block by block, in either order of octets.
class PcapngFile {
 public:
  explicit PcapngFile(bool is_swapped = false) : is_swapped_(is_swapped) { section(); }

  void section() {
    block(0x0a0d0d0a, number<std::uint32_t>(0x1a2b3c4d) + number<std::uint16_t>(1) +
                          number<std::uint16_t>(0) + Bytes(8, 0xff));
  }
  void swap_order() { is_swapped_ = !is_swapped_; }
  void interface(std::uint16_t link_type, std::uint32_t snap_length, const Bytes& options = {}) {
    block(1, number(link_type) + number<std::uint16_t>(0) + number(snap_length) + options);
  }
  Bytes option(std::uint16_t code, const Bytes& value) const {
    return number(code) + number(static_cast<std::uint16_t>(value.size())) + value +
           Bytes((4 - value.size() % 4) % 4, 0);
  }
  void packet(std::uint32_t interface, std::uint64_t stamp, const Bytes& frame) {
    const auto size = static_cast<std::uint32_t>(frame.size());
    block(6, number(interface) + number(static_cast<std::uint32_t>(stamp >> 32)) +
                 number(static_cast<std::uint32_t>(stamp)) + number(size) + number(size) + frame);
  }
  void block(std::uint32_t type, Bytes body) {
    body.resize((body.size() + 3) / 4 * 4);
    const auto length = static_cast<std::uint32_t>(body.size() + 12);
    octets_ = octets_ + number(type) + number(length) + body + number(length);
  }
  template <typename T>
  [[nodiscard]] Bytes number(T value) const {
    Bytes out(sizeof value);
    std::memcpy(out.data(), &value, sizeof value);
    if (is_swapped_) std::reverse(out.begin(), out.end());
    return out;
  }
  [[nodiscard]] Bytes& octets() { return octets_; }

  const std::string& write(const std::string& path) const {
    std::ofstream(path, std::ios::binary)
        .write(reinterpret_cast<const char*>(octets_.data()),
               static_cast<std::streamsize>(octets_.size()));
    return path;
  }

 private:
  bool is_swapped_;
  Bytes octets_;
};

}  // namespace reckon::peer::blocks
