// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// What the thread of a Falcon does: finds it, sets it up, exchanges forces and readings, and finds
// it again.
#pragma once

#include <atomic>
#include <chrono>
#include <cstdint>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "reckon/haptics/falcon/falcon_exchange.hpp"
#include "reckon/haptics/falcon/falcon_session.hpp"
#include "reckon/haptics/falcon/usb_line.hpp"

namespace reckon::haptics {

inline constexpr std::uint16_t kFalconVendor = 0x0403;   ///< FTDI
inline constexpr std::uint16_t kFalconProduct = 0xCB48;  ///< as Novint has it

/// The program that a Falcon runs. It belongs to its maker and is not part of Reckon; the device
/// forgets it without power.
struct FalconFirmware {
  static constexpr std::size_t kLeast = 1'000;   ///< octets
  static constexpr std::size_t kMost = 262'144;  ///< octets

  std::vector<std::uint8_t> octets;

  /// @throws std::runtime_error for a file that cannot be read or has no size of a firmware; the
  /// text has the file and the remedy. No checksum is known: the device's echo is compared.
  [[nodiscard]] static FalconFirmware load(const std::string& file);
};

/// How a FalconLoop finds its device.
struct FalconLoopOptions {
  FalconFirmware firmware;                          ///< empty: none is loaded
  std::function<std::chrono::nanoseconds()> clock;  ///< steady, that of the servo's writes
  UsbOpener open;                                   ///< empty: the first that is attached
  bool discover = true;                             ///< see UsbContext
};

/// One Falcon. Its thread calls step() over and over; any thread may take the notices.
///
/// Whatever fails, the force is zero here within 10 ms, one sentence says so, and the device is set
/// up again by itself as soon as it can be.
class FalconLoop {
 public:
  static constexpr std::chrono::milliseconds kRetry{200};  ///< between attempts

  /// @param exchange outlives it @throws std::runtime_error where the host has no USB
  FalconLoop(FalconExchange& exchange, FalconLoopOptions options);
  /// Tells the device a zero; waits 10 ms for it at most.
  ~FalconLoop();
  FalconLoop(const FalconLoop&) = delete;
  FalconLoop& operator=(const FalconLoop&) = delete;

  /// Waits for the device so long at most, except while setting it up, and does what is due.
  void step(std::chrono::microseconds longest);
  /// Sentences since the last call, each once. Any thread.
  [[nodiscard]] std::vector<std::string> take_notices();
  /// How far it is; nothing while no device is set up. The thread of step().
  [[nodiscard]] std::optional<FalconStage> stage() const noexcept;
  /// Any thread: ends an attempt to set the device up.
  void stop() noexcept { stopped_.store(true, std::memory_order_relaxed); }

 private:
  void attach();
  [[nodiscard]] std::string set_up();
  [[nodiscard]] bool set_line(bool for_firmware);
  [[nodiscard]] bool answers();
  [[nodiscard]] std::string load_firmware();
  [[nodiscard]] bool hears(std::span<const std::uint8_t> wanted, std::chrono::nanoseconds longest);
  [[nodiscard]] bool sends(std::span<const std::uint8_t> octets);
  void detach(const std::string& why);
  void tell_stage();
  void tell(std::string sentence);

  FalconExchange& exchange_;
  FalconLoopOptions options_;
  UsbContext context_;
  std::optional<UsbLine> line_;
  std::optional<FalconSession> session_;
  std::uint32_t run_ = 1;
  std::chrono::nanoseconds next_try_{0};
  std::string problem_;  // told already
  std::optional<FalconStage> told_;
  bool timed_ = false;  // and told so
  std::atomic<bool> stopped_{false};
  std::mutex telling_;  // never taken by the servo
  std::vector<std::string> notices_;
};

}  // namespace reckon::haptics
