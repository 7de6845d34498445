// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Any octets from the line of a serial board, in pieces, while time passes and a servo writes.
// Every accepted frame is valid for any reader; a damaged frame costs itself and at most the next
// one. After the greeting no input allocates heap, and readings keep their order.
#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <chrono>
#include <cstdint>
#include <span>
#include <vector>

#include "reckon/haptics/serial/serial_frames.hpp"
#include "reckon/haptics/serial/serial_packets.hpp"
#include "reckon/haptics/serial/serial_session.hpp"
#include "reckon/tests/fuzz/fuzz_target.hpp"

namespace reckon::fuzz {
namespace {

using haptics::SerialFrameParser;
using haptics::SerialSession;
using haptics::SerialStage;
using Input = std::span<const std::uint8_t>;
using std::chrono::microseconds;
using std::chrono::nanoseconds;

bool is_same(Input one, Input other) { return std::ranges::equal(one, other); }

// The octets of an accepted frame encode to the same frame again.
void check_frames(Input input) {
  SerialFrameParser parser;
  for (const std::uint8_t octet : input) {
    const Input carried = parser.take(octet);
    if (carried.empty()) continue;
    require(carried.size() <= haptics::kSerialMost, "a frame that is too long");
    const haptics::SerialFrame again = haptics::serial_frame(carried);
    require(std::ranges::count(again.span(), 0) == 2, "a zero within a frame");
    SerialFrameParser other;
    for (std::size_t i = 0; i + 1 < again.length; ++i)
      require(other.take(again.octets[i]).empty(), "a frame that ends too early");
    require(is_same(other.take(0), carried), "a frame is not what it carries");
    for (std::size_t axes = 1; axes <= 3; ++axes)
      static_cast<void>(haptics::serial_report(carried, axes));
  }
}

// After any octets and a damaged frame, the frame after it is read.
void check_recovery(Input input) {
  SerialFrameParser parser;
  for (const std::uint8_t octet : input) static_cast<void>(parser.take(octet));
  const std::array<std::uint8_t, 3> carried{7, 0, 9};
  const haptics::SerialFrame frame = haptics::serial_frame(carried);
  Input read;
  for (const std::uint8_t octet : frame.span()) read = parser.take(octet);
  require(is_same(read, carried), "a whole frame is not read");
}

haptics::SerialFrame greeting_to(Input question) {
  SerialFrameParser parser;
  Input asked;
  for (const std::uint8_t octet : question) asked = parser.take(octet);
  require(asked.size() == 4, "a question of another length");
  // Three axes of 20 um a count and 2 N, a watchdog of 10 ms, a report each millisecond.
  std::array<std::uint8_t, 30> octets{0x81, 1, asked[2], asked[3], 3, 10, 0xE8, 3};
  for (std::uint8_t i = 0; i < 3; ++i) {
    const std::array<std::uint8_t, 7> axis{i, 0x20, 0x4E, 0, 0, 0xD0, 7};
    std::copy(axis.begin(), axis.end(), octets.begin() + 8 + 7 * i);
  }
  octets[29] = 'b';
  return haptics::serial_frame(octets);
}

// The first octet of each piece gives its length, the time that passes, and whether it consists of
// whole frames: its octets are then the content of a frame.
void check_session(Input input) {
  haptics::UsbExchange exchange;
  haptics::DeviceLimits limits;
  limits.max_force = 2.0;
  limits.resolution = 20e-6;
  nanoseconds now{0};
  SerialSession session(exchange, limits, 1, 5, now);
  const auto question = session.next(now);
  require(question.has_value(), "nothing is asked");
  session.take(greeting_to(question->span()).span(), now);
  require(session.stage() == SerialStage::greeted, "a greeting is not taken");

  std::int64_t written = 0, after = 0;
  std::uint32_t run = 0;
  while (!input.empty()) {
    const HeapMeter heap;
    const unsigned head = input[0];
    const Input piece = input.subspan(1, std::min<std::size_t>(head & 0x1F, input.size() - 1));
    input = input.subspan(1 + piece.size());
    now += microseconds((head & 0x20) != 0 ? 500 : 3'000);
    if ((head & 0x40) != 0) {
      haptics::UsbForce& force = exchange.force.write_slot();
      force = {Eigen::Vector3d(0.5, -2.0, 1e300), ++written, now};
      exchange.force.publish();
    }
    if ((head & 0x80) != 0 && !piece.empty())
      session.take(haptics::serial_frame(piece).span(), now);
    else
      session.take(piece, now);
    if (const auto frame = session.next(now))
      require(frame->length == 3 + 6 + 5, "a force of another length");
    haptics::UsbReading reading;
    while (exchange.readings.pop(reading)) {
      require(reading.position.allFinite(), "a place that is none");
      require(reading.after <= written, "a force that was never written");
      require(reading.run != run || (reading.before >= after && reading.before <= reading.after),
              "forces out of their order");
      require(reading.run >= run, "a run that is over");
      run = reading.run;
      after = reading.after;
    }
    require(heap.allocations() == 0, "the talk took heap");
  }
}

}  // namespace

void check(std::span<const std::byte> data) {
  const Input input = numbers_of(data);
  {
    const HeapMeter heap;
    check_frames(input);
    check_recovery(input);
    require(heap.allocations() == 0, "reading took heap");
  }
  if (const auto greeting = haptics::serial_greeting(input))
    static_cast<void>(haptics::refusal_of(*greeting, 2.0, 20e-6));
  check_session(input);
}

}  // namespace reckon::fuzz
