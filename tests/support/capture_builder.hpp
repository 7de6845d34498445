// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Captures made by a test: datagrams with sender and time, written as a pcap file with Ethernet.
#pragma once

#include <unistd.h>

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <span>
#include <string>
#include <vector>

#include "reckon/pdu/codec/codec.hpp"

namespace reckon::test {

using Octets = std::vector<std::byte>;

/// Appends the octets of a PDU to a datagram.
template <pdu::Pdu T>
void append_pdu(Octets& datagram, const T& pdu) {
  const std::size_t begin = datagram.size();
  datagram.resize(begin + wire_size(pdu));
  (void)encode(pdu, std::span(datagram).subspan(begin));
}

/// The sender of a captured datagram.
struct Sender {
  std::uint8_t host = 1;  ///< 10.0.0.host
  std::uint16_t port = 3000;
  std::uint16_t fragment = 0;  ///< IP fragment field
};

/// A pcap file with nanosecond times to 239.1.2.3:3000; removed at the end of its scope.
class CaptureBuilder {
 public:
  CaptureBuilder()
      : path_(std::filesystem::temp_directory_path() /
              ("reckon-capture-" + std::to_string(getpid()) + "-" + std::to_string(++number_))) {
    put32(0xA1B23C4DU);
    put16(2);
    put16(4);
    put32(0);
    put32(0);
    put32(65535);
    put32(1);
  }
  ~CaptureBuilder() { std::filesystem::remove(path_); }
  CaptureBuilder(const CaptureBuilder&) = delete;
  CaptureBuilder& operator=(const CaptureBuilder&) = delete;

  void add(const Octets& datagram, std::chrono::nanoseconds time, Sender sender = {}) {
    const auto payload = static_cast<std::uint32_t>(datagram.size());
    put32(static_cast<std::uint32_t>(time.count() / 1'000'000'000));
    put32(static_cast<std::uint32_t>(time.count() % 1'000'000'000));
    put32(payload + 42);
    put32(payload + 42);
    for (int i = 0; i < 12; ++i) put8(0);
    put16(0x0800);
    put8(0x45);
    put8(0);
    put16(static_cast<std::uint16_t>(payload + 28));
    put16(1);
    put16(sender.fragment);
    put8(1);
    put8(17);
    put16(0);
    for (const int octet : {10, 0, 0, int{sender.host}, 239, 1, 2, 3})
      put8(static_cast<std::uint8_t>(octet));
    put16(sender.port);
    put16(3000);
    put16(static_cast<std::uint16_t>(payload + 8));
    put16(0);
    file_.insert(file_.end(), datagram.begin(), datagram.end());
  }

  /// Writes the file and returns its path.
  [[nodiscard]] std::string path() const {
    std::ofstream file(path_, std::ios::binary);
    file.write(reinterpret_cast<const char*>(file_.data()),
               static_cast<std::streamsize>(file_.size()));
    return path_.string();
  }

 private:
  // Big endian, including the file's own header.
  void put8(std::uint8_t value) { file_.push_back(static_cast<std::byte>(value)); }
  void put16(std::uint16_t value) {
    put8(static_cast<std::uint8_t>(value >> 8));
    put8(static_cast<std::uint8_t>(value & 0xFFU));
  }
  void put32(std::uint32_t value) {
    put16(static_cast<std::uint16_t>(value >> 16));
    put16(static_cast<std::uint16_t>(value & 0xFFFFU));
  }

  static inline int number_ = 0;
  std::filesystem::path path_;
  Octets file_;
};

}  // namespace reckon::test
