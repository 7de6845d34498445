// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/peer/settings/management_rule.hpp"

#include <gmock/gmock.h>

#include "reckon/peer/scene/scene_file.hpp"

namespace reckon::peer {
namespace {

using ::testing::HasSubstr;

ManagementRule rule(std::string_view text) {
  const auto parsed = ManagementRule::parse(text);
  EXPECT_TRUE(parsed) << text;
  return parsed.value_or(ManagementRule());
}

TEST(ManagementRule, AllowsNobodyByDefault) {
  EXPECT_FALSE(ManagementRule().allows({1, 2}, true));
  EXPECT_FALSE(parse_scene_file("", "x").network.management.allows({1, 2}, true));
}

TEST(ManagementRule, AllowsThePeersThatItNames) {
  EXPECT_FALSE(rule("nobody").allows({1, 2}, true));
  EXPECT_TRUE(rule("members").allows({1, 2}, true));
  EXPECT_FALSE(rule("members").allows({1, 2}, false));
  EXPECT_TRUE(rule("anyone").allows({1, 2}, false));
  for (const bool member : {false, true}) {
    EXPECT_TRUE(rule("1:2, 40:1").allows({40, 1}, member));
    EXPECT_TRUE(rule("1:2").allows({1, 2}, member));
    EXPECT_FALSE(rule("1:2, 40:1").allows({40, 2}, member));
  }
}

TEST(ManagementRule, IsWrittenAsItIsRead) {
  for (const char* text : {"nobody", "members", "anyone", "1:2", "1:2, 40:1"})
    EXPECT_EQ(rule(text).text(), text);
}

TEST(ManagementRule, RefusesInvalidPeerLists) {
  for (const char* text :
       {"", "all", "1", "1:", ":2", "0:1", "1:65535", "1:2,", "1:2 3:4", "1:70000"})
    EXPECT_FALSE(ManagementRule::parse(text)) << text;
  try {
    static_cast<void>(parse_scene_file("[network]\nallow_management = \"all\"\n", "x"));
    ADD_FAILURE() << "taken";
  } catch (const SceneFileError& error) {
    EXPECT_THAT(error.what(), HasSubstr("x:2:"));
    EXPECT_THAT(error.what(), HasSubstr("write nobody, members, anyone"));
  }
}

}  // namespace
}  // namespace reckon::peer
