// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The thread of a serial board over a real tty, on the clock of this host. A busy host may miss the
// board's 10 ms: then the thread recovers, and the awaited events come later.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "reckon/haptics/serial/serial_session.hpp"
#include "reckon/haptics/usb/usb_limits.hpp"
#include "reckon/peer/clocks/clock.hpp"
#include "reckon/peer/drivers/serial.hpp"
#include "reckon/tests/haptics/support/far_end.hpp"
#include "reckon/tests/haptics/support/serial_board.hpp"

namespace reckon::peer::serial_thread_test {
namespace {

using Eigen::Vector3d;
using std::chrono::milliseconds;
using std::chrono::nanoseconds;
using std::chrono::seconds;
using ::testing::HasSubstr;

TEST(SerialThread, ForcesAndFinalZeroReachTheBoard) {
  haptics::UsbSettings settings;
  settings.max_force = 5.0;
  settings.resolution = 20e-6;
  const SteadyClock clock;
  std::optional<test::FarEnd> far(std::in_place);
  const auto real = serial_device(clock, haptics::usb_limits(haptics::serial_facts(), settings),
                                  {far->name(), haptics::SerialPlace::kBaud});
  test::SerialBoard board({}, [](double) { return Vector3d(0.01, 0.02, 0.03); });
  const nanoseconds begin = clock.now();
  const Vector3d force(1, 2, -3);
  bool is_held = false, is_read = false;
  while (!(is_held && is_read) && clock.now() - begin < seconds(60)) {
    while (board.now() < clock.now() - begin) {
      for (const auto& frame : board.pass()) far->send(frame);
    }
    for (const std::uint8_t octet : far->fetch()) board.take(octet);
    is_read = is_read || real->device().read(clock.now()).ok;
    real->device().write(force, clock.now());
    is_held = is_held || (board.force() - force).norm() < 1e-9;
    std::this_thread::sleep_for(milliseconds(1));
  }
  EXPECT_TRUE(is_held);
  EXPECT_TRUE(is_read);

  far.reset();
  std::string told;
  while (told.find("was unplugged") == std::string::npos && clock.now() - begin < seconds(60)) {
    for (const std::string& notice : real->take_notices()) told += notice + "\n";
    std::this_thread::sleep_for(milliseconds(1));
  }
  EXPECT_THAT(told, HasSubstr("Board is ready: forces are active"));
  EXPECT_THAT(told, HasSubstr("was unplugged: its force is zero"));
}

}  // namespace
}  // namespace reckon::peer::serial_thread_test
