// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// [network.bundle] and its classes.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "reckon/peer/notation/entity_type_text.hpp"
#include "reckon/peer/scene/scene_file.hpp"

namespace reckon::peer {
namespace {

using std::chrono::milliseconds;
using testing::HasSubstr;

constexpr std::string_view kClasses = R"(
[network.bundle]
hold = "5 ms"
updates = 6
[[network.bundle.class]]
type = "1.1.225"
hold = "20 ms"
[[network.bundle.class]]
type = "Platform Land"
updates = 3
)";

const BundlePolicy& policy_of(const SceneFile& file, std::string_view type) {
  return bundle_policy_of(file.network, parse_entity_type(type).type);
}

TEST(BundleSection, GivesEachTypeItsFirstMatchingClass) {
  const SceneFile file = parse_scene_file(kClasses, "x.toml");
  EXPECT_EQ(policy_of(file, "1.1.225.4.2").hold, milliseconds(20));
  EXPECT_EQ(policy_of(file, "1.1.225.4.2").updates, 0u);
  EXPECT_EQ(policy_of(file, "1.1.224.4.2").updates, 3u);
  EXPECT_EQ(policy_of(file, "1.1.224.4.2").hold, milliseconds(0));
  EXPECT_EQ(policy_of(file, "1.3.225").hold, milliseconds(5)) << "ships are of no class";
  EXPECT_EQ(policy_of(file, "1.3.225").updates, 6u);
}

TEST(BundleSection, RefusesAMissingAndAnUnknownType) {
  const auto refusal = [](std::string_view text) -> std::string {
    try {
      (void)parse_scene_file(text, "x.toml");
      return {};
    } catch (const SceneFileError& error) {
      return error.what();
    }
  };
  EXPECT_THAT(refusal("[[network.bundle.class]]\nhold = \"1 ms\"\n"), HasSubstr("type"));
  EXPECT_THAT(refusal("[[network.bundle.class]]\ntype = \"Platfrom\"\n"), HasSubstr("Platform"));
  EXPECT_THAT(refusal("[network.bundle]\nhold = \"2 s\"\n"), HasSubstr("1 s"));
}

}  // namespace
}  // namespace reckon::peer
