// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/peer/settings/touch_rule.hpp"

#include <gmock/gmock.h>

#include <string>

#include "reckon/peer/scene/scene_file.hpp"

namespace reckon::peer {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

TouchRule touch_rule(std::string_view text) {
  const auto parsed = TouchRule::parse(text);
  EXPECT_TRUE(parsed) << text;
  return parsed.value_or(TouchRule());
}

std::string touch_problem(const std::string& network) {
  try {
    static_cast<void>(parse_scene_file("[network]\n" + network, "x"));
  } catch (const SceneFileError& error) {
    return error.what();
  }
  return "none";
}

TouchRule rule_of(const std::string& network) {
  return parse_scene_file("[network]\n" + network, "x").network.touch_rule();
}

TEST(TouchRule, AdmitsThePeersOfTheSceneByDefault) {
  EXPECT_EQ(rule_of("").text(), "scene");
  EXPECT_TRUE(rule_of("").allows({1, 2}, true));
  EXPECT_FALSE(rule_of("").allows({1, 2}, false));
}

TEST(TouchRule, AdmitsAllByDefaultInAnInteropExercise) {
  EXPECT_EQ(rule_of("interop = true\n").text(), "all");
  EXPECT_TRUE(rule_of("interop = true\n").allows({1, 2}, false));
  EXPECT_THAT(touch_problem("interop = true\ntouch = \"scene\"\n"),
              HasSubstr("peers do not announce themselves in an 'interop' exercise"));
}

TEST(TouchRule, BindsNamesToLivingPeersAlone) {
  EXPECT_TRUE(touch_rule("1:2, 40:1").allows({40, 1}, true));
  EXPECT_FALSE(touch_rule("1:2, 40:1").allows({40, 1}, false));
  EXPECT_FALSE(touch_rule("1:2, 40:1").allows({40, 2}, true));
  EXPECT_TRUE(touch_rule("members").allows({1, 2}, true));
  EXPECT_FALSE(touch_rule("members").allows({1, 2}, false));
}

TEST(TouchRule, IsWrittenAsItIsRead) {
  for (const char* text : {"all", "scene", "members", "1:2", "1:2, 40:1"})
    EXPECT_EQ(touch_rule(text).text(), text);
  for (const char* text : {"", "nobody", "1", "1:", "0:1", "1:65535", "1:2,"})
    EXPECT_FALSE(TouchRule::parse(text)) << text;
}

TEST(TouchRule, IsAListOrTextInAScene) {
  const auto of = [](const std::string& text) { return rule_of(text).text(); };
  EXPECT_EQ(of("touch = [\"1:2\", \"40:1\"]\n"), "1:2, 40:1");
  EXPECT_EQ(of("touch = \"1:2\"\n"), "1:2");
  EXPECT_EQ(of("touch = \"all\"\n"), "all");
  EXPECT_THAT(touch_problem("touch = \"friends\"\n"), HasSubstr("write scene, all, members, or"));
  EXPECT_THAT(touch_problem("touch = []\n"), HasSubstr("write scene, all, members, or"));
  EXPECT_THAT(touch_problem("touch = 7\n"), HasSubstr("x:2:"));
}

TEST(TouchRule, WantsAKeyForMembers) {
  EXPECT_THAT(touch_problem("touch = \"members\"\n"), HasSubstr("which requires a key"));
  EXPECT_THAT(touch_problem("touch = \"members\"\nkey = \"x.key\"\n"),
              Not(HasSubstr("'touch'")));  // the only fault is the missing file
}

}  // namespace
}  // namespace reckon::peer
