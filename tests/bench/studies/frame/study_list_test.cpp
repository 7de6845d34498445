// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The list of studies: each study in a folder has its row in verbs/bench.cpp, or is a verb.
#include <gmock/gmock.h>

#include <filesystem>
#include <fstream>
#include <regex>
#include <sstream>
#include <string>
#include <vector>

#include "reckon/tests/bench/support/bench_console.hpp"
#include "reckon/tests/support/places.hpp"

namespace reckon::bench::study_list_test {
namespace {

/// The names of all functions that make a study.
std::vector<std::string> studies_in_folders() {
  static const std::regex kMakes(R"(std::unique_ptr<Study> (\w+)_study\(\) \{)");
  std::vector<std::string> names;
  for (const auto& entry :
       std::filesystem::recursive_directory_iterator(test::source_dir() + "/bench/studies")) {
    if (entry.path().extension() != ".cpp") continue;
    std::ifstream file(entry.path());
    std::stringstream text;
    text << file.rdbuf();
    const std::string source = text.str();
    for (std::sregex_iterator made(source.begin(), source.end(), kMakes), end; made != end; ++made)
      names.push_back((*made)[1]);
  }
  return names;
}

TEST(StudyList, HasARowForEachStudy) {
  const auto names = studies_in_folders();
  EXPECT_GE(names.size(), 6U);
  for (const std::string& name : names) {
    const auto of_verb = test::run_bench({name, "--help"});
    const auto help = of_verb.status == 0 ? of_verb : test::run_bench({"bench", name, "--help"});
    EXPECT_EQ(help.status, 0) << name;
    EXPECT_THAT(help.out, testing::ContainsRegex("reckon (bench )?" + name)) << name;
  }
}

}  // namespace
}  // namespace reckon::bench::study_list_test
