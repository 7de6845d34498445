// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/peer/world/peer_view.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <limits>
#include <numeric>
#include <random>
#include <set>
#include <vector>

#include "reckon/tests/src/support/poses.hpp"

namespace reckon::peer {
namespace {

using Eigen::Vector3d;

// Entities at `places` on a line; their IDs are in another order.
std::vector<RemoteEntity> on_a_line(const std::vector<double>& places) {
  std::vector<RemoteEntity> rows(places.size());
  for (std::size_t i = 0; i < rows.size(); ++i) {
    rows[i].id = {1, 2, static_cast<std::uint16_t>((7919 * (i + 1)) % 65521)};
    rows[i].state = test::last_sent_at(places[i]);
  }
  return rows;
}

std::vector<double> line(std::size_t count) {
  std::vector<double> places(count);
  for (std::size_t i = 0; i < count; ++i) places[i] = 1.0 + static_cast<double>(i);
  return places;
}

std::set<double> places_of(std::span<const std::uint32_t> chosen,
                           const std::vector<RemoteEntity>& rows) {
  std::set<double> places;
  for (const std::uint32_t i : chosen) places.insert(rows[i].state->position.x());
  return places;
}

TEST(EntityView, HasNoRateOnceUpdatesFailToCome) {
  using std::chrono::milliseconds;
  RemoteEntity row;
  row.first_heard = milliseconds(1000);
  row.last_heard = milliseconds(3000);
  const auto rate = [&](std::uint64_t updates, int ms_later) {
    row.updates = updates;
    return view_of(row, {}, row.last_heard + milliseconds(ms_later)).rate_hz;
  };
  EXPECT_DOUBLE_EQ(rate(101, 0), 50.0);
  EXPECT_DOUBLE_EQ(rate(101, 900), 50.0) << "a stall of the network is no end";
  EXPECT_EQ(rate(101, 1100), 0.0);
  EXPECT_DOUBLE_EQ(rate(2, 5000), 0.5) << "one heartbeat in 2 s may be lost";
  EXPECT_EQ(rate(2, 10'100), 0.0);
}

TEST(ViewChoice, HasAllInIdOrderIfRoom) {
  ViewChoice choice;
  EXPECT_TRUE(choice.choose({}, Vector3d::Zero()).empty());
  for (const std::size_t count : {1U, 63U, 64U}) {
    const auto rows = on_a_line(line(count));
    const auto chosen = choice.choose(rows, Vector3d::Zero());
    ASSERT_EQ(chosen.size(), count);
    EXPECT_TRUE(std::is_sorted(chosen.begin(), chosen.end(),
                               [&](auto a, auto b) { return rows[a].id < rows[b].id; }));
    EXPECT_EQ(places_of(chosen, rows).size(), count);
  }
}

TEST(ViewChoice, HasTheNearestInAnyOrder) {
  std::mt19937 random(1);
  for (const std::size_t count : {65U, 200U, 5000U}) {
    std::vector<double> places = line(count);
    std::shuffle(places.begin(), places.end(), random);
    const auto rows = on_a_line(places);
    const auto found = places_of(ViewChoice().choose(rows, Vector3d::Zero()), rows);
    EXPECT_EQ(found.size(), PeerView::kRows);
    EXPECT_EQ(*found.rbegin(), 64.0);
  }
}

// Sixty-five entities on a ring whose radii vary by 5 %: the one left out stays the same.
TEST(ViewChoice, StaysWhereDistancesTremble) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> trembling(0.96, 1.04);
  auto rows = on_a_line(std::vector<double>(65, 100.0));
  ViewChoice choice;
  std::vector<std::uint32_t> first;
  for (int picture = 0; picture < 200; ++picture) {
    for (RemoteEntity& row : rows) row.state = test::last_sent_at(100 * trembling(random));
    const auto chosen = choice.choose(rows, Vector3d::Zero());
    if (picture == 0) first.assign(chosen.begin(), chosen.end());
    ASSERT_TRUE(std::equal(chosen.begin(), chosen.end(), first.begin(), first.end()));
  }
  const std::uint32_t absent = 64 * 65 / 2 - std::accumulate(first.begin(), first.end(), 0U);
  rows[absent].state = test::last_sent_at(80);
  const auto chosen = choice.choose(rows, Vector3d::Zero());
  EXPECT_NE(std::find(chosen.begin(), chosen.end(), absent), chosen.end());
}

// Each picture checks only a part of a large table. The nearest are still found, and so are
// approaching entities.
TEST(ViewChoice, FindsTheNearestWithinAFewPictures) {
  constexpr std::size_t kCount = 100'000;
  std::mt19937 random(1);
  std::vector<double> places = line(kCount);
  std::shuffle(places.begin(), places.end(), random);
  std::vector<RemoteEntity> rows(kCount);
  for (std::size_t i = 0; i < kCount; ++i) {
    rows[i].id = {1, static_cast<std::uint16_t>(1 + i / 60'000),
                  static_cast<std::uint16_t>(i % 60'000)};
    rows[i].state = test::last_sent_at(places[i]);
  }
  ViewChoice choice;
  constexpr std::size_t kPictures = kCount / ViewChoice::kLooks + 1;
  std::set<double> found;
  for (std::size_t i = 0; i < kPictures; ++i) {
    const auto chosen = choice.choose(rows, Vector3d::Zero());
    EXPECT_EQ(chosen.size(), PeerView::kRows);  // full from the first picture on
    found = places_of(chosen, rows);
    EXPECT_EQ(found.size(), PeerView::kRows);  // none twice
  }
  // Within a tenth, because entities of an earlier picture stay.
  EXPECT_LE(*found.rbegin(), 64.0 / 0.9);
  EXPECT_EQ(*found.begin(), 1.0);

  const auto near = std::find(places.begin(), places.end(), 90'000.0) - places.begin();
  rows[static_cast<std::size_t>(near)].state = test::last_sent_at(0.5);
  for (std::size_t i = 0; i < kPictures; ++i)
    found = places_of(choice.choose(rows, Vector3d::Zero()), rows);
  EXPECT_EQ(*found.begin(), 0.5);

  // Removed rows lose their places.
  rows.resize(40);
  EXPECT_EQ(choice.choose(rows, Vector3d::Zero()).size(), 40U);
}

TEST(ViewChoice, IsFullForAnUnknownHandPosition) {
  const auto rows = on_a_line(line(100));
  const Vector3d nowhere = Vector3d::Constant(std::numeric_limits<double>::quiet_NaN());
  EXPECT_EQ(places_of(ViewChoice().choose(rows, nowhere), rows).size(), PeerView::kRows);
}

}  // namespace
}  // namespace reckon::peer
