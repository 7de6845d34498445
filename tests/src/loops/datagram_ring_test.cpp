// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/peer/loops/datagram_ring.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <deque>
#include <random>
#include <thread>
#include <vector>

#include "reckon/tests/support/allocation_guard.hpp"

namespace reckon::peer {
namespace {

using std::chrono::nanoseconds;

constexpr std::size_t kSmall = std::size_t{64} << 10;

std::vector<std::byte> octets_of(std::uint32_t number, std::size_t size) {
  std::vector<std::byte> out(size);
  for (std::size_t i = 0; i < size; ++i) out[i] = static_cast<std::byte>(number * 31 + i);
  return out;
}

GroupAddress group_of(std::uint32_t number) {
  return IpEndpoint::v4(0xefc00100u + number % 200, static_cast<std::uint16_t>(3000 + number % 7));
}

bool push(DatagramRing& ring, std::uint32_t number, std::size_t size) {
  return ring.push(group_of(number), nanoseconds(number), octets_of(number, size));
}

void expect(const QueuedDatagram* found, std::uint32_t number, std::size_t size) {
  ASSERT_NE(found, nullptr) << number;
  EXPECT_EQ(found->group, group_of(number));
  EXPECT_EQ(found->arrival, nanoseconds(number));
  const auto wanted = octets_of(number, size);
  EXPECT_TRUE(std::equal(found->octets.begin(), found->octets.end(), wanted.begin(), wanted.end()))
      << number;
}

TEST(DatagramRing, TakesEmptyToLongestButNothingLonger) {
  DatagramRing ring(kSmall);
  EXPECT_TRUE(ring.empty());
  EXPECT_EQ(ring.front(), nullptr);
  EXPECT_TRUE(push(ring, 1, kMaxDatagram));
  EXPECT_TRUE(push(ring, 2, 0));
  EXPECT_FALSE(push(ring, 3, kMaxDatagram + 1));
  EXPECT_FALSE(ring.empty());
  expect(ring.front(), 1, kMaxDatagram);
  expect(ring.front(), 1, kMaxDatagram);  // front() takes nothing out
  ring.pop();
  expect(ring.front(), 2, 0);
  ring.pop();
  EXPECT_EQ(ring.front(), nullptr);
}

TEST(DatagramRing, HoldsMoreOfTheShortOnes) {
  DatagramRing ring(std::size_t{2} << 20);
  std::uint32_t held = 0;
  while (push(ring, held, 280)) ++held;
  EXPECT_EQ(held, (std::size_t{2} << 20) / 384);
}

// Compared with a reference queue, over many laps and at every fill level.
TEST(DatagramRing, KeepsOrderAndOctetsOfAnyLengths) {
  std::mt19937 random(7);
  DatagramRing ring(kSmall);
  std::deque<std::pair<std::uint32_t, std::size_t>> wanted;
  std::uint32_t number = 0, refused = 0;
  for (int step = 0; step < 40'000; ++step) {
    const bool filling = step / 500 % 2 == 0;
    if (std::uniform_int_distribution(0, 9)(random) < (filling ? 7 : 3)) {
      const std::size_t most = step % 3 == 0 ? kMaxDatagram : 600;
      const std::size_t size = std::uniform_int_distribution<std::size_t>(0, most)(random);
      const bool certain = ring.room() > 0;
      const bool taken = push(ring, number, size);
      ASSERT_TRUE(taken || !certain) << step;
      if (taken) wanted.emplace_back(number++, size);
      refused += taken ? 0 : 1;
    } else if (!wanted.empty()) {
      expect(ring.front(), wanted.front().first, wanted.front().second);
      if (HasFatalFailure()) return;
      ring.pop();
      wanted.pop_front();
    }
    ASSERT_EQ(ring.empty(), wanted.empty());
  }
  EXPECT_GT(refused, 100u);  // it was full many times
}

TEST(DatagramRing, ReadsManyAtOnceAndFreesThemTogether) {
  DatagramRing ring(kSmall);
  std::array<QueuedDatagram, 5> out;
  EXPECT_EQ(ring.front(out), 0u);
  std::uint32_t pushed = 0, read = 0;
  for (int lap = 0; lap < 2000; ++lap) {
    while (pushed - read < 7 && push(ring, pushed, pushed * 37 % 5000)) ++pushed;
    const std::size_t count = ring.front(out);
    ASSERT_EQ(count, std::min<std::size_t>(out.size(), pushed - read));
    for (std::size_t i = 0; i < count; ++i, ++read) expect(&out[i], read, read * 37 % 5000);
    if (HasFatalFailure()) return;
    ring.pop();
  }
  EXPECT_GT(read, 8000u);
}

TEST(DatagramRing, HasRoomForItsDeclaredNumberOfLongest) {
  std::mt19937 random(3);
  DatagramRing ring(kSmall);
  for (int lap = 0; lap < 3000; ++lap) {
    // Any position in the ring, any fill level.
    static_cast<void>(push(ring, 0, std::uniform_int_distribution<std::size_t>(0, 9000)(random)));
    if (lap % 3 != 0 && ring.front() != nullptr) ring.pop();
    const std::size_t room = ring.room();
    for (std::size_t i = 0; i < room; ++i) ASSERT_TRUE(push(ring, 1, kMaxDatagram)) << lap;
    if (lap % 2 == 0) {
      while (ring.front() != nullptr) ring.pop();
    }
  }
}

TEST(DatagramRing, PassesDatagramsBetweenThreadsWithoutAllocating) {
  constexpr std::uint32_t kNumber = 100'000;
  DatagramRing ring(kSmall);
  std::thread writer([&] {
    for (std::uint32_t i = 0; i < kNumber;) {
      const std::array<std::byte, 4> octets{
          std::byte(i), std::byte(i >> 8), std::byte(i >> 16), {}};
      if (ring.push(group_of(i), nanoseconds(i), std::span(octets).first(1 + i % 4))) {
        ++i;
      } else {
        std::this_thread::yield();
      }
    }
  });
  const test::AllocationGuard guard;
  std::uint32_t wrong = 0;
  for (std::uint32_t i = 0; i < kNumber;) {
    const QueuedDatagram* found = ring.front();
    if (found == nullptr) {
      std::this_thread::yield();
      continue;
    }
    const bool right = found->arrival == nanoseconds(i) && found->octets.size() == 1 + i % 4 &&
                       found->octets[0] == std::byte(i);
    wrong += right ? 0 : 1;
    ring.pop();
    ++i;
  }
  EXPECT_EQ(guard.count(), 0u);
  writer.join();
  EXPECT_EQ(wrong, 0u);
}

}  // namespace
}  // namespace reckon::peer
