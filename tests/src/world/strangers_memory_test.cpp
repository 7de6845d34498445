// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Limits for forged entities: they use no more memory than configured, replace no member's
// entities, and leave nothing allocated when they are gone.
#include <gtest/gtest.h>
#include <malloc.h>

#include <algorithm>
#include <ostream>

#include "reckon/tests/src/support/incoming_half.hpp"

namespace reckon::peer {
namespace {

using Eigen::Vector3d;
using std::chrono::milliseconds;
using std::chrono::nanoseconds;
using std::chrono::seconds;

constexpr std::size_t kMiB = std::size_t{1} << 20;

// Octets allocated in this process. How much is resident depends on the allocator and the machine.
std::size_t allocated_octets() {
  const struct mallinfo2 heap = mallinfo2();
  return heap.uordblks + heap.hblkhd;
}

aoim::SourceAddress at_host(std::size_t number) {
  return {{0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0xFF, 0xFF, 10, 77, 0, static_cast<std::uint8_t>(number)},
          static_cast<std::uint16_t>(4000 + number)};
}

struct Invented {
  std::size_t memory, count, hosts;
  double far_share;  ///< share of entities outside the radius
  bool haptic;
  const char* prediction;
  friend std::ostream& operator<<(std::ostream& out, const Invented& flood) {
    return out << flood.memory << " octets, " << flood.count << " of " << flood.hosts << " hosts, "
               << flood.far_share << " far";
  }
};

class StrangersMemory : public testing::TestWithParam<Invented> {
 protected:
  explicit StrangersMemory(std::size_t memory = 4 * kMiB, const std::string& text = "")
      : half_("[aoim]\nradius = \"1 km\"\ncell = \"1 km\"\n" + text,
              [memory](const SceneFile& scene) {
                RemoteSettings settings = remote_settings(scene);
                settings.strangers_memory = memory;
                settings.record_changes = false;
                return settings;
              }) {}

  void hear(std::size_t number, std::size_t host, std::uint32_t epoch, bool far = false,
            bool haptic = false) {
    Inbound update;
    deadreckon::KinematicState state;
    state.position = {far ? 5000.0 : 3.0, static_cast<double>(number % 100), 0};
    update.has_model = haptic;
    update.model.k1 = 100;
    update.state.entity_type = {pdu::EntityKind::platform, pdu::EntityDomain::air};
    const auto site = static_cast<std::uint16_t>((epoch == 0 ? 100 : 20'000) + number / 60'000);
    half_.put_state(
        update,
        {site, static_cast<std::uint16_t>(host), static_cast<std::uint16_t>(1 + number % 60'000)},
        state, now_);
    half_.remote.take(
        update, {now_, test::IncomingHalf::kUtc + now_, now_, epoch, {}, at_host(host)}, {});
    now_ += milliseconds(1) / 20;
  }
  void invent(const Invented& flood) {
    for (std::size_t i = 0; i < flood.count; ++i) {
      const bool far = static_cast<double>(i % 10) < 10.0 * flood.far_share;
      hear(i, 1 + i % flood.hosts, 0, far, flood.haptic);
      ASSERT_LE(half_.remote.strangers_octets(), flood.memory);
    }
  }
  [[nodiscard]] std::size_t rows_of(std::size_t host) const {
    return static_cast<std::size_t>(std::ranges::count_if(
        half_.remote.rows(), [host](const RemoteEntity& row) { return row.id.application == host; }));
  }
  void pass(nanoseconds length) {
    for (const nanoseconds end = now_ + length; now_ < end; now_ += milliseconds(100)) {
      half_.remote.expire(now_);
      half_.remote.look_shown(now_);
      half_.remote.look_outside(now_);
    }
  }

  nanoseconds now_ = seconds(10);
  test::IncomingHalf half_;
};

class StrangersThatInvent : public StrangersMemory {
 protected:
  StrangersThatInvent() : StrangersMemory(GetParam().memory, GetParam().prediction) {}
};

TEST_P(StrangersThatInvent, AreBoundedEvictNoMemberAndFreeAll) {
  constexpr std::size_t kMembers = 200, kMemberHost = 99;
  for (std::size_t i = 0; i < kMembers; ++i)
    hear(i, kMemberHost, 7000 + static_cast<std::uint32_t>(i % 3), i % 2 == 0);
  const std::size_t near = rows_of(kMemberHost), before = allocated_octets();
  ASSERT_EQ(near, kMembers / 2);
  ASSERT_NO_FATAL_FAILURE(invent(GetParam()));
  EXPECT_EQ(rows_of(kMemberHost), near);
  EXPECT_GE(half_.remote.strangers_octets(), GetParam().memory / 2) << "they may use it";
  EXPECT_LE(allocated_octets(), before + GetParam().memory);
  pass(seconds(200));
  EXPECT_EQ(half_.remote.strangers_octets(), 0u);
  EXPECT_LE(allocated_octets(), before + GetParam().memory / 8);
}

INSTANTIATE_TEST_SUITE_P(
    Floods, StrangersThatInvent,
    testing::Values(
        Invented{4 * kMiB, 30'000, 1, 0.0, false, ""}, Invented{16 * kMiB, 60'000, 3, 0.5, true, ""},
        Invented{16 * kMiB, 90'000, 1, 1.0, false, ""},
        Invented{32 * kMiB, 120'000, 40, 0.3, true, "[convergence]\nprediction = \"adaptive\"\n"}));

class BesideInventors : public StrangersMemory {};

TEST_F(BesideInventors, AnotherHostsEntitiesAreShown) {
  ASSERT_NO_FATAL_FAILURE(invent({4 * kMiB, 20'000, 1, 0.3, false, ""}));
  for (std::size_t i = 0; i < 500; ++i) hear(i, 50, 0);
  EXPECT_EQ(rows_of(50), 500u);
  ASSERT_NO_FATAL_FAILURE(invent({4 * kMiB, 20'000, 1, 0.3, false, ""}));
  EXPECT_EQ(rows_of(50), 500u);
  EXPECT_EQ(half_.remote.last_evicted(), at_host(1));
  EXPECT_EQ(half_.remote.last_stranger(), at_host(1)) << "who has no room is told by his address";
}

TEST_F(BesideInventors, DistantEntitiesOfOthersAppearWhenNear) {
  ASSERT_NO_FATAL_FAILURE(invent({4 * kMiB, 20'000, 1, 1.0, false, ""}));
  for (std::size_t i = 0; i < 300; ++i) hear(i, 50, 0, true);
  ASSERT_NO_FATAL_FAILURE(invent({4 * kMiB, 20'000, 1, 1.0, false, ""}));
  half_.stand_at({5000, 0, 0}, now_);
  pass(seconds(2));
  EXPECT_EQ(rows_of(50), 300u);
}

TEST_F(BesideInventors, ShownEntitiesReplaceHiddenOnes) {
  ASSERT_NO_FATAL_FAILURE(invent({4 * kMiB, 20'000, 1, 1.0, false, ""}));
  for (std::size_t i = 0; i < 1000; ++i) hear(i, 50, 0);
  EXPECT_EQ(rows_of(50), 1000u);
}

TEST_F(BesideInventors, ThatSpeakAgainstEachOtherKeepEqualShares) {
  for (std::size_t i = 0; i < 20'000; ++i) hear(i, 1 + i % 4, 0);
  const auto rows = [this](std::size_t host) { return static_cast<double>(rows_of(host)); };
  const double first = rows(1);
  for (std::size_t host = 1; host <= 4; ++host) EXPECT_NEAR(rows(host), first, 1 + first / 20);
  for (std::size_t i = 0; i < 20'000; ++i) hear(i, 5, 0);
  EXPECT_NEAR(rows(5), first * 4 / 5, 1 + first / 10);
}

}  // namespace
}  // namespace reckon::peer
