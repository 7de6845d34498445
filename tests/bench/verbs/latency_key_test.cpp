// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>
#include <sys/stat.h>

#include <string>

#include "reckon/tests/bench/support/bench_console.hpp"
#include "reckon/tests/support/scratch_folder.hpp"

namespace reckon::bench {
namespace {

TEST(BenchLatency, RefusesAKeyReadableByOthers) {
  const test::ScratchFolder folder;
  const std::string key = folder.file("group.key");
  ASSERT_EQ(test::run_reckon({"key", "new", key}).status, 0);
  ASSERT_EQ(::chmod(key.c_str(), 0644), 0);
  const auto refused = test::run_bench({"bench", "latency", "--for", "4s", "--key", key});
  EXPECT_EQ(refused.status, 2);
  EXPECT_THAT(refused.err, testing::HasSubstr("chmod 600 " + key));
}

}  // namespace
}  // namespace reckon::bench
