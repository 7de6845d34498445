// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/aoim/cells/over_delivery.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <random>
#include <vector>

namespace reckon::aoim {
namespace {

TEST(OverDelivery, DividesReceivedByWantedDeliveries) {
  const CellGrid squares({CellScheme::square, 100.0, 256});
  // Two that want each other. A third is in the cell of the second, but out of reach of both.
  const std::vector<Demand> three = {
      {{95, 50, 0}, 20.0, 0}, {{110, 50, 0}, 20.0, 0}, {{190, 50, 0}, 20.0, 0}};
  // The first receives two, the second two, the third only the second.
  EXPECT_DOUBLE_EQ(over_delivery(squares, three), 5.0 / 2.0);
  EXPECT_EQ(over_delivery(squares, {}), 0.0);
  std::vector<Demand> apart = three;
  for (std::uint32_t i = 0; i < apart.size(); ++i) apart[i].instant = i;
  EXPECT_EQ(over_delivery(squares, apart), 0.0) << "nobody is there with another";
  apart = three;
  apart.push_back({{std::numeric_limits<double>::quiet_NaN(), 0, 0}, 20.0, 0});
  EXPECT_DOUBLE_EQ(over_delivery(squares, apart), 5.0 / 2.0);
}

TEST(OverDelivery, IsMaximalForASingleCell) {
  std::mt19937_64 random(3);
  std::uniform_real_distribution<double> along(-100.0, 100.0);
  std::vector<Demand> demands;
  for (int i = 0; i < 200; ++i) demands.push_back({{along(random), along(random), 0}, 30.0, 7});
  double wanted = 0.0;
  for (const Demand& one : demands)
    for (const Demand& other : demands)
      wanted += &one != &other && distance(one.position, other.position) <= 30.0 ? 1.0 : 0.0;
  EXPECT_DOUBLE_EQ(over_delivery(QuadTree(QuadTreeConfig{}), demands), 200.0 * 199.0 / wanted);
}

}  // namespace
}  // namespace reckon::aoim
