// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// A real tty with a board on its other end that runs the example's program. Octets pass through the
// kernel, which takes its time: tests wait for events without limit, and assert no times.
#include "reckon/haptics/serial/serial_loop.hpp"

#include <fcntl.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <termios.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cstdint>
#include <cstdio>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "reckon/haptics/usb/usb_device.hpp"
#include "reckon/tests/haptics/support/far_end.hpp"
#include "reckon/tests/haptics/support/serial_board.hpp"
#include "reckon/tests/support/scratch_folder.hpp"

namespace reckon::haptics::serial_loop_test {
namespace {

using Eigen::Vector3d;
using std::chrono::microseconds;
using std::chrono::milliseconds;
using std::chrono::nanoseconds;
using std::chrono::seconds;
using test::FarEnd;
using test::SerialBoard;
using test::SerialBoardOptions;
using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

constexpr seconds kLongest{60};

DeviceLimits limits() {
  UsbSettings settings;
  settings.damping = 2.0;
  settings.max_force = 5.0;
  settings.resolution = 20e-6;
  return usb_limits(serial_facts(), settings);
}

/// A board behind a tty that is always found under the same name, its loop, and the servo's part.
/// The loop's clock is the board's: it advances while a test waits.
class Plugged {
 public:
  explicit Plugged(const SerialBoardOptions& options = {})
      : board(options, [](double) { return Vector3d(0.01, 0.02, 0.03); }),
        device(exchange, limits()) {
    loop.emplace(exchange, limits(), SerialPlace{port()}, [this] { return board.now(); });
  }

  [[nodiscard]] std::string port() const { return folder_.file("board"); }
  void plug() {
    board.forget();
    far.emplace();
    static_cast<void>(std::remove(port().c_str()));
    ASSERT_EQ(symlink(far->name().c_str(), port().c_str()), 0);
  }
  void unplug() {
    far.reset();
    static_cast<void>(std::remove(port().c_str()));
  }

  /// @return whether it became true
  [[nodiscard]] bool wait_for(const std::function<bool()>& what) {
    const auto end = std::chrono::steady_clock::now() + kLongest;
    for (;;) {
      if (what()) return true;
      if (std::chrono::steady_clock::now() > end) return false;
      step();
    }
  }
  [[nodiscard]] bool is_told(const std::string& what) {
    return wait_for([&] {
      return std::ranges::any_of(
          notices, [&](const std::string& one) { return one.find(what) != std::string::npos; });
    });
  }

  SerialBoard board;
  UsbExchange exchange;
  UsbDevice device;
  std::optional<FarEnd> far;
  std::optional<SerialLoop> loop;
  std::vector<std::string> notices;
  DeviceSample sample;
  Vector3d force{1, 2, -3};

 private:
  // The kernel delivers octets at any time: each poll takes half a millisecond of the board's time.
  void step() {
    for (int i = 0; i < 10; ++i) {
      for (const std::vector<std::uint8_t>& frame : board.pass()) {
        if (far) far->send(frame);
      }
    }
    if (far) {
      for (const std::uint8_t octet : far->fetch()) board.take(octet);
    }
    if (board.now() >= next_step_) {
      next_step_ += milliseconds(1);
      sample = device.read(board.now());
      device.write(force, board.now());
    }
    if (!loop) return;
    loop->step(microseconds(100));
    for (std::string& notice : loop->take_notices()) notices.push_back(std::move(notice));
  }

  test::ScratchFolder folder_;
  nanoseconds next_step_{0};
};

TEST(SerialLoop, ForcesAndPositionsPassARealTty) {
  Plugged serial;
  serial.plug();
  ASSERT_TRUE(serial.wait_for([&] { return serial.sample.ok; }));
  EXPECT_TRUE(serial.wait_for([&] { return (serial.board.force() - serial.force).norm() < 1e-9; }));
  EXPECT_TRUE(serial.wait_for([&] {
    return serial.sample.ok && (serial.sample.position - serial.board.position()).norm() < 1e-3;
  }));
  EXPECT_THAT(serial.notices, Contains(serial.port() + ": Board is ready: forces are active"));
}

TEST(SerialLoop, RecoversAfterAnUnplug) {
  Plugged serial;
  ASSERT_TRUE(serial.is_told("there is no"));
  EXPECT_THAT(serial.notices, ElementsAre(HasSubstr("plug it in"))) << "once";
  for (int round = 0; round < 3; ++round) {
    serial.notices.clear();
    serial.plug();
    ASSERT_TRUE(serial.wait_for([&] { return !serial.board.force().isZero(0); })) << round;
    serial.notices.clear();
    serial.unplug();
    ASSERT_TRUE(serial.is_told("was unplugged")) << round;
    EXPECT_FALSE(serial.loop->stage());
    ASSERT_TRUE(serial.wait_for([&] { return serial.board.force().isZero(0); }));
    EXPECT_TRUE(serial.wait_for([&] { return !serial.sample.ok; }));
  }
}

TEST(SerialLoop, ResetBoardIsAskedAgain) {
  Plugged serial;
  serial.plug();
  ASSERT_TRUE(serial.wait_for([&] { return !serial.board.force().isZero(0); }));
  serial.board.forget();
  ASSERT_TRUE(serial.is_told("stopped answering"));
  EXPECT_TRUE(serial.wait_for([&] { return !serial.board.force().isZero(0); }));
}

TEST(SerialLoop, BlockedLineIsReopened) {
  Plugged serial;
  serial.plug();
  // Before it is opened exclusively.
  const int line = open(serial.far->name().c_str(), O_RDWR | O_NOCTTY | O_NONBLOCK);
  ASSERT_GE(line, 0);
  ASSERT_TRUE(serial.wait_for([&] { return !serial.board.force().isZero(0); }));
  ASSERT_EQ(tcflow(line, TCOOFF), 0);
  EXPECT_TRUE(serial.is_told("has accepted no octets"));
  ASSERT_EQ(tcflow(line, TCOON), 0);
  EXPECT_TRUE(serial.wait_for([&] { return !serial.board.force().isZero(0); }));
  close(line);
}

TEST(SerialLoop, EndOfTheProgramSendsAZero) {
  Plugged serial;
  serial.plug();
  ASSERT_TRUE(serial.wait_for([&] { return !serial.board.force().isZero(0); }));
  serial.loop.reset();
  // The watchdog's time does not pass: only a frame can release the force.
  bool is_zero = false;
  const auto end = std::chrono::steady_clock::now() + kLongest;
  while (!is_zero && std::chrono::steady_clock::now() < end) {
    for (const std::uint8_t octet : serial.far->fetch()) serial.board.take(octet);
    is_zero = serial.board.program.has_next != 0 && serial.board.program.next_force[0] == 0;
  }
  EXPECT_TRUE(is_zero);
}

TEST(SerialLoop, RefusedBoardIsNamedWithTheReason) {
  SerialBoardOptions options;
  options.watchdog = 50;
  Plugged serial(options);
  serial.plug();
  ASSERT_TRUE(serial.is_told("Board cannot be used: its watchdog drops the force after 50 ms"));
  EXPECT_TRUE(serial.board.force().isZero(0));
}

TEST(SerialPort, ReportsUnopenableLinesWithTheRemedy) {
  const test::ScratchFolder folder;
  EXPECT_THAT(SerialPort::open(folder.file("none"), 115'200).problem, HasSubstr("there is no"));
  const SerialOpening file = SerialPort::open("/dev/null", 115'200);
  EXPECT_THAT(file.problem, HasSubstr("/dev/null is not a serial port"));
  EXPECT_FALSE(file.port);
}

TEST(SerialPort, IsOpenedExclusively) {
  const FarEnd far;
  SerialOpening first = SerialPort::open(far.name(), 1'000'000);
  ASSERT_TRUE(first.port) << first.problem;
  const SerialOpening second = SerialPort::open(far.name(), 1'000'000);
  EXPECT_FALSE(second.port);
  EXPECT_THAT(second.problem, HasSubstr("another program uses"));
  first.port.reset();
  EXPECT_TRUE(SerialPort::open(far.name(), 1'000'000).port);
}

// Including zeros, carriage returns, and octets that would end a program or stop the line.
TEST(SerialPort, EachOctetPassesUnchangedInBothDirections) {
  const FarEnd far;
  const SerialOpening opening = SerialPort::open(far.name(), 250'000);
  ASSERT_TRUE(opening.port) << opening.problem;
  termios mode{};
  ASSERT_EQ(tcgetattr(far.descriptor(), &mode), 0);
  EXPECT_EQ(mode.c_cflag & (CSIZE | PARENB | CSTOPB), static_cast<tcflag_t>(CS8));
  std::vector<std::uint8_t> all(256);
  for (std::size_t i = 0; i < all.size(); ++i) all[i] = static_cast<std::uint8_t>(i);
  far.send(all);
  std::vector<std::uint8_t> come, gone;
  const auto end = std::chrono::steady_clock::now() + kLongest;
  while (come.size() < 256 && std::chrono::steady_clock::now() < end) {
    opening.port->wait(milliseconds(1));
    const auto octets = opening.port->read();
    come.insert(come.end(), octets.begin(), octets.end());
  }
  EXPECT_EQ(come, all);
  for (const std::size_t from : {0, 128}) opening.port->send(std::span(all).subspan(from, 128));
  while (gone.size() < 256 && std::chrono::steady_clock::now() < end) {
    const auto octets = far.fetch();
    gone.insert(gone.end(), octets.begin(), octets.end());
  }
  EXPECT_EQ(gone, all);
  EXPECT_FALSE(opening.port->is_gone());
}

TEST(SerialPort, IsGoneWhenItsOtherEndIsClosed) {
  std::optional<FarEnd> far(std::in_place);
  const SerialOpening opening = SerialPort::open(far->name(), 1'000'000);
  ASSERT_TRUE(opening.port) << opening.problem;
  opening.port->wait(microseconds(0));
  EXPECT_FALSE(opening.port->is_gone());
  far.reset();
  opening.port->wait(milliseconds(1));
  static_cast<void>(opening.port->read());
  EXPECT_TRUE(opening.port->is_gone());
  const std::array<std::uint8_t, 3> octets{};
  opening.port->send(octets);
  EXPECT_TRUE(opening.port->read().empty());
}

}  // namespace
}  // namespace reckon::haptics::serial_loop_test
