// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// A Novint Falcon as a device of a peer: the device, and the thread that talks with it.
#pragma once

#include <atomic>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "reckon/haptics/falcon/falcon_device.hpp"
#include "reckon/haptics/falcon/falcon_exchange.hpp"
#include "reckon/haptics/falcon/falcon_loop.hpp"
#include "reckon/peer/clocks/clock.hpp"
#include "reckon/peer/real_time_priority.hpp"

namespace reckon::peer {

/// The thread has SCHED_FIFO where the host grants it, below the servo: a report waits for it. It
/// sleeps until the device has sent something, 1 ms at most.
///
///     SteadyClock clock;
///     FalconThread falcon(clock, settings, FalconFirmware::load("falcon.bin"));
///     options.devices = {{&falcon.device()}};
class FalconThread {
 public:
  static constexpr int kPriority = 45;  ///< of SCHED_FIFO

  /// @param clock that of the servo; outlives this  @param firmware empty: none is loaded
  /// @throws std::runtime_error where the host has no USB, std::invalid_argument for settings out
  /// of their range, std::system_error if no thread can be made
  FalconThread(const Clock& clock, const haptics::FalconSettings& settings,
               haptics::FalconFirmware firmware);
  ~FalconThread();
  FalconThread(const FalconThread&) = delete;
  FalconThread& operator=(const FalconThread&) = delete;

  /// For the servo; its reading fails while no Falcon is there.
  [[nodiscard]] haptics::FalconDevice& device() noexcept { return device_; }
  /// Sentences for the user since the last call. Any thread.
  [[nodiscard]] std::vector<std::string> take_notices() { return loop_.take_notices(); }

 private:
  void run() noexcept;

  const Clock& clock_;
  haptics::FalconExchange exchange_;
  haptics::FalconDevice device_;
  haptics::FalconLoop loop_;
  OrdinaryPulse pulse_;
  std::atomic<bool> stop_{false};
  std::thread thread_;
};

}  // namespace reckon::peer
