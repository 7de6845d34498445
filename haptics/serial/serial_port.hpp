// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// A serial line of this host: octets both ways, as they are.
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

/// What came of opening one.
struct SerialOpening {
  std::unique_ptr<SerialPort> port;  ///< null: see `problem`
  std::string problem;               ///< why it cannot be used, as a sentence
  std::string remedy;                ///< of that; may be empty
};

/// Opened for this program alone, without any line discipline. One thread. From construction on it
/// allocates nothing, and only wait() waits.
class SerialPort {
 public:
  /// @param path such as /dev/ttyACM0  @param baud > 0, any that the line can do; a board on USB
  /// without a chip of its own for that is as fast as USB
  [[nodiscard]] static SerialOpening open(const std::string& path, unsigned baud);
  ~SerialPort();
  SerialPort(const SerialPort&) = delete;
  SerialPort& operator=(const SerialPort&) = delete;

  /// Until octets have come, room is there for those that wait, or so long at most.
  void wait(std::chrono::microseconds longest) noexcept;
  /// What has come. @return empty: nothing more
  [[nodiscard]] std::span<const std::uint8_t> read() noexcept;
  /// Where octets are on their way still, the newest have to wait.
  [[nodiscard]] bool is_sending() noexcept;
  /// Call while it is not sending. @param octets at most kMostOut
  void send(std::span<const std::uint8_t> octets) noexcept;
  /// Hung up, unplugged, or otherwise of no use any more.
  [[nodiscard]] bool is_gone() const noexcept { return gone_; }

  static constexpr std::size_t kMostOut = 128;

 private:
  explicit SerialPort(int descriptor) noexcept : descriptor_(descriptor) {}
  void write_on() noexcept;

  int descriptor_;
  bool gone_ = false;
  std::array<std::uint8_t, 1024> in_{};
  std::array<std::uint8_t, kMostOut> out_{};
  std::size_t out_begin_ = 0, out_end_ = 0;  // not written yet
};

/// Sleeps while there is no line.
void wait_without_line(std::chrono::microseconds longest) noexcept;

}  // namespace reckon::haptics
