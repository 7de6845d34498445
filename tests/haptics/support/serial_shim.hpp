// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// A board behind a serial line below SerialPort: the test program answers SerialPort's calls to the
// kernel. The linker leads them here first (--wrap, reckon_shim_serial() of tests/CMakeLists.txt);
// calls for other files go on to the C library. If the program waits, only the board's time passes.
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <functional>
#include <random>
#include <span>
#include <string>
#include <vector>

#include "reckon/haptics/serial/serial_frames.hpp"
#include "reckon/tests/haptics/support/line_way.hpp"
#include "reckon/tests/haptics/support/serial_board.hpp"

namespace reckon::test {

/// The board that replaces the true one.
enum class FalseBoard : std::uint8_t {
  none,
  newer,   ///< uses another version of the protocol
  silent,  ///< has no program for this line
  noisy,   ///< sends no valid frames
  weaker,  ///< holds less force than is requested
};

/// One at a time, on one thread.
class SerialShim {
 public:
  /// @param board outlives it  @param out, in latency of the way to the board and back
  SerialShim(SerialBoard& board, std::string path, std::chrono::nanoseconds out,
             std::chrono::nanoseconds in);
  ~SerialShim();
  SerialShim(const SerialShim&) = delete;
  SerialShim& operator=(const SerialShim&) = delete;

  void pass(std::chrono::nanoseconds time);
  /// Called every 50 us of its time, whoever advances it.
  void beside(std::function<void(std::chrono::nanoseconds)> call) { beside_ = std::move(call); }
  /// Called at each call to the kernel for the line, before it is answered.
  void at_each_call(std::function<void()> call) { at_call_ = std::move(call); }

  /// Hangs up the open line for good.
  void unplug();
  void plug(FalseBoard board = FalseBoard::none);
  [[nodiscard]] bool is_plugged() const { return plugged_; }
  [[nodiscard]] int open_files() const { return files_; }
  /// Number of attempts to open it.
  [[nodiscard]] unsigned tries() const { return tries_; }

  // Faults from now on.
  void deny(int error) { denied_ = error; }       ///< errno of opening it; 0: none
  void fail(unsigned calls) { errors_ = calls; }  ///< reads and writes, with EIO
  /// nothing goes out
  void hang(std::chrono::nanoseconds time) { hangs_until_ = board_.now() + time; }
  /// nothing comes in
  void mute(std::chrono::nanoseconds time) { mute_until_ = board_.now() + time; }
  void damage(unsigned frames) { damaged_in_ = damaged_out_ = frames; }  ///< a bit of each
  /// Octets in both directions. @param of_thousand that are lost
  void lose(unsigned of_thousand, std::chrono::nanoseconds time);
  /// Input waits for the next multiple of a time. @param every > 0
  void bunch(std::chrono::nanoseconds every, std::chrono::nanoseconds time);
  void piece(bool on) { pieces_ = on; }  ///< a read gives at most a few octets
  void restart();                        ///< the board's program, which prints something

  // For the calls.
  static SerialShim* that_is_there();
  [[nodiscard]] bool is_its(const char* path) const { return path_ == path; }
  [[nodiscard]] bool is_its(int file) const { return file >= 0 && file == file_; }
  int open();
  int close();
  int control(unsigned long request, void* argument);
  /// @return its pending events of poll()
  short poll(short wanted, std::chrono::nanoseconds longest);
  std::ptrdiff_t read(std::span<std::uint8_t> octets);
  std::ptrdiff_t write(std::span<const std::uint8_t> octets);

 private:
  static constexpr std::size_t kRoom = 4'096;  // octets that the kernel keeps, in each direction

  [[nodiscard]] bool is_readable() const { return !to_host_.empty(); }
  [[nodiscard]] std::size_t waiting() const;
  [[nodiscard]] bool happens(unsigned of_thousand) { return random_() % 1'000 < of_thousand; }
  [[nodiscard]] bool fails();
  void bring(std::vector<std::uint8_t> frame);
  void flip(std::vector<std::uint8_t>& octets);
  void send_out();
  void take_in();

  SerialBoard& board_;
  std::string path_;
  std::chrono::nanoseconds out_latency_, in_latency_;
  std::mt19937 random_{1};
  std::function<void(std::chrono::nanoseconds)> beside_;
  std::function<void()> at_call_;
  LineWay in_, out_;
  std::deque<std::uint8_t> to_board_, to_host_, held_;
  int file_ = -1, files_ = 0;
  unsigned tries_ = 0;
  bool plugged_ = true, hung_up_ = false, pieces_ = false;
  FalseBoard false_ = FalseBoard::none;
  haptics::SerialFrameParser parser_;
  int denied_ = 0;
  unsigned errors_ = 0, damaged_in_ = 0, damaged_out_ = 0, lost_ = 0;
  std::chrono::nanoseconds hangs_until_{0}, mute_until_{0}, lost_until_{0}, bunched_until_{0};
  std::chrono::nanoseconds bunch_{1};
};

}  // namespace reckon::test
