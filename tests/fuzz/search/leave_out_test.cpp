// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/tests/fuzz/search/leave_out.hpp"

#include <gtest/gtest.h>

#include <optional>
#include <string>

namespace reckon::fuzz {
namespace {

std::optional<std::string> without_letter(std::string fewer, std::size_t letter) {
  if (fewer[letter] == ' ') return {};
  fewer.erase(letter, 1);
  return fewer;
}

TEST(LeaveOut, KeepsOnlyNeededParts) {
  const auto fails = [](const std::string& fewer) {
    return fewer.find('a') != std::string::npos && fewer.find('z') != std::string::npos;
  };
  EXPECT_EQ(leave_out(std::string("bazaar zoo"), 10, without_letter, fails), "az ");
}

TEST(LeaveOut, SkipsMissingParts) {
  int asked = 0;
  const auto fails = [&asked](const std::string&) { return ++asked > 0; };
  EXPECT_EQ(leave_out(std::string("a  b"), 4, without_letter, fails), "  ");
  EXPECT_EQ(asked, 2);
}

}  // namespace
}  // namespace reckon::fuzz
