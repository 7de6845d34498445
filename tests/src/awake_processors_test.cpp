// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/peer/awake_processors.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

namespace reckon::peer {
namespace {

using namespace std::chrono_literals;

// A file in the place of the kernel's: what is asked of it, in turn [us].
class Requests {
 public:
  Requests() {
    std::string name = std::filesystem::temp_directory_path() / "reckon_requests_XXXXXX";
    close(mkstemp(name.data()));
    path_ = name;
  }
  ~Requests() { std::filesystem::remove(path_); }
  Requests(const Requests&) = delete;
  Requests& operator=(const Requests&) = delete;

  [[nodiscard]] const char* path() const { return path_.c_str(); }
  [[nodiscard]] std::vector<std::int32_t> made() const {
    std::ifstream file(path_, std::ios::binary);
    std::vector<std::int32_t> all;
    for (std::int32_t one = 0; file.read(reinterpret_cast<char*>(&one), sizeof one);)
      all.push_back(one);
    return all;
  }

 private:
  std::filesystem::path path_;
};

TEST(AwakeProcessors, AreAskedForWhileNeededAndForASecondMore) {
  const Requests requests;
  AwakeProcessors awake(requests.path());
  awake.keep(false, 1ms);
  EXPECT_TRUE(requests.made().empty()) << "before anything is needed";
  for (auto now = 1ms; now < 500ms; now += 1ms) awake.keep(true, now);
  EXPECT_EQ(requests.made(), std::vector<std::int32_t>{0});
  awake.keep(false, 1400ms);
  EXPECT_EQ(requests.made(), std::vector<std::int32_t>{0}) << "it may be needed again soon";
  awake.keep(false, 1500ms);
  EXPECT_EQ(requests.made(), (std::vector<std::int32_t>{0, 2'000'000'000}));
  awake.keep(true, 1501ms);
  EXPECT_EQ(requests.made(), (std::vector<std::int32_t>{0, 2'000'000'000, 0}));
  awake.keep(false, std::chrono::nanoseconds::max());
  EXPECT_EQ(requests.made().back(), 2'000'000'000) << "nobody is left who could need it";
}

TEST(AwakeProcessors, AreLeftAloneWhereNobodyMayAsk) {
  AwakeProcessors nowhere("/nonexistent/cpu_dma_latency");
  nowhere.keep(true, 1ms);
  nowhere.keep(false, 2s);
  AwakeProcessors full("/dev/full");  // takes no request
  full.keep(true, 1ms);
  full.keep(true, 2ms);
}

}  // namespace
}  // namespace reckon::peer
