// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The sketch that is shipped with Reckon, on substitutes for Arduino's calls.
#include <gmock/gmock.h>

#include <cstdint>
#include <deque>
#include <map>
#include <vector>

#include "reckon/haptics/serial/serial_frames.hpp"
#include "reckon/haptics/serial/serial_packets.hpp"
#include "reckon/tests/haptics/serial/arduino_stub.h"

namespace {

// The sketch's view of its board.
struct Board {
  std::deque<std::uint8_t> to_sketch;
  std::vector<std::uint8_t> from_sketch;
  std::map<int, int> levels, duties;
  void (*on_edge)() = nullptr;
  unsigned long now = 0xFFFFFFFF;  // [us], wraps at once
  unsigned long baud = 0;
};
Board board;

}  // namespace

SerialStub Serial;
void pinMode(int, int) {}
int digitalRead(int pin) { return board.levels[pin]; }
void digitalWrite(int pin, int level) { board.levels[pin] = level; }
void analogWrite(int pin, int duty) { board.duties[pin] = duty; }
int digitalPinToInterrupt(int pin) { return pin; }
void attachInterrupt(int, void (*call)(), int) { board.on_edge = call; }
void noInterrupts() {}
void interrupts() {}
unsigned long micros() { return board.now & 0xFFFFFFFF; }
void SerialStub::begin(unsigned long baud) { board.baud = baud; }
int SerialStub::available() { return static_cast<int>(board.to_sketch.size()); }
int SerialStub::read() {
  const int octet = board.to_sketch.front();
  board.to_sketch.pop_front();
  return octet;
}
size_t SerialStub::write(const uint8_t* octets, size_t length) {
  board.from_sketch.insert(board.from_sketch.end(), octets, octets + length);
  return length;
}

namespace reckon::haptics::paddle_test {
namespace {

constexpr int kForward = 7, kBackward = 8, kPulse = 9;

void tell(const SerialFrame& frame) {
  board.to_sketch.insert(board.to_sketch.end(), frame.span().begin(), frame.span().end());
}

// Its output of a millisecond, frame by frame.
std::vector<std::vector<std::uint8_t>> tick() {
  board.now += 1'000;
  board.from_sketch.clear();
  loop();
  std::vector<std::vector<std::uint8_t>> frames;
  SerialFrameParser parser;
  for (const std::uint8_t octet : board.from_sketch) {
    const auto carried = parser.take(octet);
    if (!carried.empty()) frames.emplace_back(carried.begin(), carried.end());
  }
  return frames;
}

// Quarter periods of the two channels, forwards.
void turn(int steps) {
  static int at = 0;
  const int way = steps > 0 ? 1 : -1;
  for (; steps != 0; steps -= way) {
    at = (at + way) & 3;
    board.levels[2] = at == 2 || at == 3;
    board.levels[3] = at == 1 || at == 2;
    board.on_edge();
  }
}

TEST(Paddle, SketchGreetsReportsAndHoldsItsForce) {
  setup();
  EXPECT_EQ(board.baud, 1'000'000U);
  EXPECT_TRUE(tick().empty()) << "nobody asked";

  tell(ask_frame(77));
  auto frames = tick();
  ASSERT_EQ(frames.size(), 2U);
  const auto greeting = serial_greeting(frames[0]);
  ASSERT_TRUE(greeting);
  EXPECT_EQ(greeting->answers, 77);
  EXPECT_STREQ(greeting->name.data(), "Paddle");
  EXPECT_EQ(greeting->axis[0], (SerialAxis{0, 14'700, 3'000}));
  EXPECT_EQ(refusal_of(*greeting, 3.0, 14.7e-6), "");
  EXPECT_EQ(serial_report(frames[1], 1)->from, std::nullopt);

  tell(frame_of({5, {1'500, 0, 0}}, 1));
  turn(-7);
  frames = tick();
  ASSERT_EQ(frames.size(), 1U);
  auto report = serial_report(frames[0], 1);
  ASSERT_TRUE(report);
  EXPECT_EQ(report->counts[0], -7);
  EXPECT_EQ(report->until, std::nullopt);
  EXPECT_EQ(report->from, 5);
  EXPECT_EQ(board.duties[kPulse], 127) << "half of 255";
  EXPECT_TRUE(board.levels[kForward]);
  EXPECT_FALSE(board.levels[kBackward]);

  tell(frame_of({6, {-3'000, 0, 0}}, 1));
  turn(9);
  report = serial_report(tick().at(0), 1);
  EXPECT_EQ(report->counts[0], 2);
  EXPECT_EQ(report->until, 5);
  EXPECT_EQ(report->from, 6);
  EXPECT_EQ(board.duties[kPulse], 255);
  EXPECT_FALSE(board.levels[kForward]);
  EXPECT_TRUE(board.levels[kBackward]);
}

TEST(Paddle, ReleasesAfter10MsAndGoesSilent) {
  setup();
  tell(ask_frame(1));
  tick();
  tell(frame_of({5, {1'500, 0, 0}}, 1));
  const int let_go = serial_report(tick().at(0), 1)->force_drops;
  for (int i = 0; i < 9; ++i) {
    EXPECT_EQ(serial_report(tick().at(0), 1)->from, 5) << i;
    EXPECT_EQ(board.duties[kPulse], 127);
  }
  const auto report = serial_report(tick().at(0), 1);
  EXPECT_EQ(report->until, 5);
  EXPECT_EQ(report->from, std::nullopt);
  EXPECT_EQ(report->force_drops, let_go + 1);
  EXPECT_EQ(board.duties[kPulse], 0);
  for (int i = 0; i < 1'100; ++i) tick();
  EXPECT_TRUE(tick().empty());
}

}  // namespace
}  // namespace reckon::haptics::paddle_test
