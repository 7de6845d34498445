// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// A serial line of this host: raw octets both ways.
#pragma once

#include <array>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>

namespace reckon::haptics {

class SerialPort;

/// Result of opening a port.
struct SerialOpening {
  std::unique_ptr<SerialPort> port;  ///< null: see `problem`
  std::string problem;               ///< why it cannot be used, as a sentence
  std::string remedy;                ///< remedy of the problem; may be empty
};

/// A port in exclusive, raw mode. One thread. After construction it allocates nothing, and only
/// wait() blocks.
class SerialPort {
 public:
  /// @param path such as /dev/ttyACM0 @param baud > 0, any rate that the line supports; a board
  /// with native USB ignores it and is as fast as USB
  [[nodiscard]] static SerialOpening open(const std::string& path, unsigned baud);
  ~SerialPort();
  SerialPort(const SerialPort&) = delete;
  SerialPort& operator=(const SerialPort&) = delete;

  /// Waits until data arrives, output space is free for pending octets, or the time-out.
  void wait(std::chrono::microseconds longest) noexcept;
  /// Received octets, valid until the next call. @return empty: no more
  [[nodiscard]] std::span<const std::uint8_t> read() noexcept;
  /// Whether octets of the last send() are still pending. Do not send() meanwhile.
  [[nodiscard]] bool is_sending() noexcept;
  /// Call only while is_sending() is false. @param octets at most kMostOut
  void send(std::span<const std::uint8_t> octets) noexcept;
  /// Hung up, unplugged, or otherwise failed.
  [[nodiscard]] bool is_gone() const noexcept { return gone_; }

  static constexpr std::size_t kMostOut = 128;

 private:
  explicit SerialPort(int descriptor) noexcept : descriptor_(descriptor) {}
  void write_on() noexcept;

  int descriptor_;
  bool gone_ = false;
  std::array<std::uint8_t, 1024> in_{};
  std::array<std::uint8_t, kMostOut> out_{};
  std::size_t out_begin_ = 0, out_end_ = 0;  // octets not written yet
};

/// Sleeps, for use without an open port.
void wait_without_line(std::chrono::microseconds longest) noexcept;

}  // namespace reckon::haptics
