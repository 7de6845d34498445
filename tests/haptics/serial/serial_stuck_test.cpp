// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// A line that takes no octets any more, with the real loop and port; a model of the line answers
// the kernel's calls. All time is the board's.
#include <gtest/gtest.h>

#include <chrono>
#include <functional>
#include <string>
#include <vector>

#include "reckon/haptics/serial/serial_loop.hpp"
#include "reckon/haptics/usb/usb_device.hpp"
#include "reckon/tests/haptics/support/serial_board.hpp"
#include "reckon/tests/haptics/support/serial_shim.hpp"

namespace reckon::haptics::serial_stuck_test {
namespace {

using Eigen::Vector3d;
using std::chrono::microseconds;
using std::chrono::milliseconds;
using std::chrono::nanoseconds;

constexpr const char* kPort = "/dev/the-board";

DeviceLimits limits() {
  UsbSettings settings;
  settings.damping = 2.0;
  settings.max_force = 5.0;
  settings.resolution = 20e-6;
  return usb_limits(serial_facts(), settings);
}

/// A servo that requests one force.
class Shimmed {
 public:
  Shimmed() {
    shim.beside([this](nanoseconds now) {
      if (beside) beside();
      if (now < next_step_) return;
      next_step_ += milliseconds(1);
      static_cast<void>(device.read(now));
      device.write({1, 0, 0}, now);
    });
  }
  ~Shimmed() { beside = nullptr; }

  /// @return whether it became true
  bool run_until(const std::function<bool()>& what) {
    for (const nanoseconds end = board.now() + std::chrono::seconds(2); board.now() < end;) {
      if (what()) return true;
      loop.step(milliseconds(1));
    }
    return false;
  }

  test::SerialBoard board{{}, [](double) { return Vector3d(0.01, 0.02, 0.03); }};
  test::SerialShim shim{board, kPort, microseconds(200), microseconds(200)};
  UsbExchange exchange;
  UsbDevice device{exchange, limits()};
  std::function<void()> beside;
  SerialLoop loop{exchange, limits(), SerialPlace{kPort}, [this] { return board.now(); }};

 private:
  nanoseconds next_step_{0};
};

TEST(SerialStuck, BlockedLineIsClosedAndDropsOldForces) {
  Shimmed shimmed;
  ASSERT_TRUE(shimmed.run_until([&] { return shimmed.board.will_hold(); }));
  const nanoseconds stuck = shimmed.board.now();
  const auto time = [&] { return shimmed.board.now() - stuck; };
  shimmed.shim.hang(milliseconds(100));
  bool is_told = false;  // a force, by the pending octets
  shimmed.beside = [&] {
    const bool is_let_go = time() > milliseconds(20) && time() < milliseconds(150);
    is_told = is_told || (is_let_go && shimmed.board.will_hold() &&
                          shimmed.loop.stage() != SerialStage::running);
  };
  EXPECT_TRUE(shimmed.run_until([&] { return !shimmed.loop.stage(); }));
  EXPECT_LT(time(), milliseconds(12));
  EXPECT_TRUE(shimmed.run_until([&] { return time() > milliseconds(150); }));
  EXPECT_FALSE(is_told);
  EXPECT_TRUE(shimmed.run_until([&] { return shimmed.board.will_hold(); })) << "it goes on";
}

}  // namespace
}  // namespace reckon::haptics::serial_stuck_test
