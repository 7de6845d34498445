// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/peer/threads/awake_processors.hpp"

#include <gtest/gtest.h>

#include <cstdint>
#include <fstream>
#include <string>
#include <vector>

#include "reckon/tests/support/scratch_folder.hpp"

namespace reckon::peer {
namespace {

using namespace std::chrono_literals;

// The requests [us] in a file that replaces the kernel's, in order.
std::vector<std::int32_t> requests_in(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  std::vector<std::int32_t> all;
  for (std::int32_t one = 0; file.read(reinterpret_cast<char*>(&one), sizeof one);)
    all.push_back(one);
  return all;
}

TEST(AwakeProcessors, AreRequestedWhileNeededAndOneSecondLonger) {
  const test::ScratchFolder folder;
  const std::string path = folder.file("requests");
  std::ofstream{path};
  const auto made = [&] { return requests_in(path); };
  AwakeProcessors awake(path.c_str());
  awake.keep(false, 1ms);
  EXPECT_TRUE(made().empty()) << "before anything is needed";
  for (auto now = 1ms; now < 500ms; now += 1ms) awake.keep(true, now);
  EXPECT_EQ(made(), std::vector<std::int32_t>{0});
  awake.keep(false, 1400ms);
  EXPECT_EQ(made(), std::vector<std::int32_t>{0}) << "it may be needed again soon";
  awake.keep(false, 1500ms);
  EXPECT_EQ(made(), (std::vector<std::int32_t>{0, 2'000'000'000}));
  awake.keep(true, 1501ms);
  EXPECT_EQ(made(), (std::vector<std::int32_t>{0, 2'000'000'000, 0}));
  awake.keep(false, std::chrono::nanoseconds::max());
  EXPECT_EQ(made().back(), 2'000'000'000) << "nobody is left who could need it";
}

TEST(AwakeProcessors, AreLeftAloneWhereNobodyMayAsk) {
  AwakeProcessors nowhere("/nonexistent/cpu_dma_latency");
  nowhere.keep(true, 1ms);
  nowhere.keep(false, 2s);
  AwakeProcessors full("/dev/full");  // accepts no request
  full.keep(true, 1ms);
  full.keep(true, 2ms);
}

}  // namespace
}  // namespace reckon::peer
