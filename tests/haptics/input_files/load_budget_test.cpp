// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Files named by a scene: which are opened, their total cost, and the reports.
#include "reckon/haptics/input_files/load_budget.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <array>
#include <chrono>
#include <fstream>
#include <string>
#include <vector>

#include "reckon/haptics/input_files/input_file.hpp"
#include "reckon/haptics/input_files/load_progress.hpp"
#include "reckon/tests/support/scratch_folder.hpp"

namespace reckon::haptics {
namespace {

using namespace std::chrono_literals;
using testing::ElementsAre;
using testing::HasSubstr;

std::string refusal(const std::filesystem::path& file, std::size_t most = 100) {
  try {
    (void)read_input_file(file, most);
    return {};
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
}

TEST(InputFile, ReadsOnlyRegularFiles) {
  const test::ScratchFolder folder;
  std::ofstream(folder.file("text")) << "a b\n";
  EXPECT_EQ(read_input_file(folder.file("text"), 4), "a b\n");
  ASSERT_EQ(::mkfifo(folder.file("pipe").c_str(), 0600), 0);
  EXPECT_THAT(refusal(folder.file("pipe")), HasSubstr("a pipe"));
  EXPECT_THAT(refusal("/dev/zero"), HasSubstr("is a device"));
  EXPECT_THAT(refusal(folder.file("")), HasSubstr("is a folder"));
  EXPECT_THAT(refusal(folder.file("none")), HasSubstr("No such file"));
}

TEST(InputFile, EndsAtItsReportedSize) {
  InputFile file("/proc/self/status", 1 << 20);
  std::array<char, 16> room{};
  EXPECT_EQ(file.read(room), 0u) << "of size 0, with content";
}

TEST(InputFile, RefusesMoreOctetsThanAllowed) {
  const test::ScratchFolder folder;
  std::ofstream(folder.file("text")) << std::string(2 << 20, 'x');
  EXPECT_THAT(refusal(folder.file("text"), 1 << 20), HasSubstr("more than 1 MiB"));
}

TEST(LoadBudget, SumsOverAllFilesOfItsScope) {
  const std::size_t most = LoadBudget::limit(LoadWork::rows);
  {
    const LoadBudget scene;
    LoadBudget::take(LoadWork::rows, most - 1);
    const LoadBudget file;
    LoadBudget::take(LoadWork::rows, 1);
    EXPECT_THROW(LoadBudget::take(LoadWork::rows, 1), LoadLimitError);
    EXPECT_NO_THROW(LoadBudget::take(LoadWork::pixels, 1)) << "each kind has its own bound";
  }
  const LoadBudget next;
  EXPECT_NO_THROW(LoadBudget::take(LoadWork::rows, most));
}

TEST(LoadBudget, BoundsSingleCallsOutsideAnyScope) {
  const std::size_t most = LoadBudget::limit(LoadWork::triangles);
  for (int i = 0; i < 2; ++i) EXPECT_NO_THROW(LoadBudget::take(LoadWork::triangles, most));
  EXPECT_THROW(LoadBudget::take(LoadWork::triangles, most + 1), LoadLimitError);
}

TEST(LoadProgress, ReportsSlowFileOnceASecond) {
  std::chrono::nanoseconds now = 5s;
  std::vector<std::string> said;
  const LoadProgress progress([&] { return now; },
                              [&](const std::filesystem::path& file, std::chrono::seconds since) {
                                said.push_back(file.string() + " " + std::to_string(since.count()));
                              });
  LoadProgress::look_now();
  LoadProgress::begin("a.obj");
  for (const auto step : {999ms, 0ms, 1ms, 500ms, 600ms}) {
    now += step;
    LoadProgress::look_now();
  }
  LoadProgress::begin("b.csv");
  now += 1s;
  LoadProgress::look_now();
  now += 12s;
  for (int i = 0; i < 100; ++i) LoadBudget::take(LoadWork::rows, 1);
  EXPECT_THAT(said, ElementsAre("a.obj 1", "a.obj 2", "b.csv 1", "b.csv 13"));
}

}  // namespace
}  // namespace reckon::haptics
