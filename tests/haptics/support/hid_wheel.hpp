// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// A PidWheel below the calls that carry its reports, and the hand that holds it. All time is its
// own: a call that waits for the device advances it.
#pragma once

#include <array>
#include <chrono>
#include <cstdint>
#include <deque>
#include <functional>
#include <map>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "reckon/haptics/evdev/evdev_device.hpp"
#include "reckon/haptics/evdev/event_calls.hpp"
#include "reckon/haptics/hid/hid_calls.hpp"
#include "reckon/tests/haptics/support/pid_wheel.hpp"

namespace reckon::test {

struct HidWheelOptions {
  PidWheelOptions wheel{.axes = 2, .hand_speed = 0.7};
  std::chrono::microseconds takes{1000};    ///< time that it takes for a report of the host
  std::chrono::microseconds answers{500};   ///< time of a feature report, in either direction
  std::chrono::microseconds reports{1000};  ///< between its own
  bool says_where = true;                   ///< its position, on request
  bool tells_interval = true;
};

/// The true facts of it, as in a scene, with a delay that it keeps.
haptics::EvdevSettings settings_for(const HidWheelOptions& options);

class HidWheel final : public haptics::HidCalls {
 public:
  using Places = std::array<double, 2>;  // [m]
  static constexpr const char* kPath = "/dev/hidraw3";
  static constexpr const char* kName = "Reckon FFBoard model";

  /// @param hand the hand's goal for the handle [m] at a time [s]
  HidWheel(const HidWheelOptions& options, std::function<Places(double)> hand);

  [[nodiscard]] std::chrono::nanoseconds now() const { return now_; }
  /// Called every 100 us of its time: the code that runs beside the device's thread.
  void beside(std::function<void(std::chrono::nanoseconds)> call) { beside_ = std::move(call); }
  void pass(std::chrono::nanoseconds time);

  // Faults.
  void plug(bool in);
  enum class Call : std::uint8_t { write, set_feature, get_feature };
  /// The next calls of that kind; 0 ends the fault.
  void fail(Call call, int error, unsigned count = ~0U) { failing_[call] = {error, count}; }
  void fail_reads(unsigned count) { failing_reads_ = count; }
  /// The next writes return later by this time than the device has the report.
  void slow_down(std::chrono::microseconds each, unsigned count) { slow_ = {each, count}; }
  std::function<void()> at_each_call = [] {};
  int opening = 0;        ///< result of open() if negative
  bool is_taken = false;  ///< by another program
  haptics::HidSeen seen;  ///< the kernel's facts of it

  PidWheel wheel;
  [[nodiscard]] bool is_plugged() const { return plugged_; }
  [[nodiscard]] unsigned tries() const { return tries_; }  ///< to open it
  [[nodiscard]] int open_files() const { return open_; }
  [[nodiscard]] std::chrono::nanoseconds longest_call() const { return longest_call_; }

  std::vector<std::string> paths() override;
  haptics::HidSeen look(const std::string& path) override;
  haptics::ReportIntervals report_intervals(const std::string& path) override;
  int open(const std::string& path) override;
  void close(int file) noexcept override;
  int take(int file) noexcept override;
  bool is_there(int file) noexcept override;
  int read(int file, std::span<std::uint8_t> report) noexcept override;
  int write(int file, std::span<const std::uint8_t> report) noexcept override;
  int set_feature(int file, std::span<const std::uint8_t> report) noexcept override;
  int get_feature(int file, std::span<std::uint8_t> report) noexcept override;
  int get_input(int file, std::span<std::uint8_t> report) noexcept override;
  void wait(int file, std::chrono::microseconds longest) noexcept override;

 private:
  [[nodiscard]] int made(Call call, std::chrono::microseconds time) noexcept;

  HidWheelOptions options_;
  std::function<Places(double)> hand_;
  std::function<void(std::chrono::nanoseconds)> beside_;
  std::chrono::nanoseconds now_{0}, next_report_{0}, longest_call_{0};
  std::deque<std::vector<std::uint8_t>> reports_;
  std::vector<std::uint8_t> sent_;
  struct Failure {
    int error = 0;
    unsigned left = 0;
  };
  struct Slowness {
    std::chrono::microseconds each{0};
    unsigned left = 0;
  };
  std::map<Call, Failure> failing_;
  Slowness slow_;
  unsigned failing_reads_ = 0;
  bool plugged_ = true, is_dead_ = false;
  int open_ = 0;
  unsigned tries_ = 0;
};

/// The wheel is the only force feedback device of its host, and outlives the calls.
std::unique_ptr<haptics::EventCalls> calls_of(HidWheel& wheel);

}  // namespace reckon::test
