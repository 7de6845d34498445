// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// [[object.patch]]: parts of a mesh with another surface; and the contact radius of a hand.
#include <gmock/gmock.h>

#include <string>

#include "reckon/haptics/scene/effect_plan.hpp"
#include "reckon/peer/scene/scene_file.hpp"
#include "reckon/tests/src/support/refusal.hpp"
#include "reckon/tests/support/mesh_text.hpp"

namespace reckon::peer {
namespace {

using testing::HasSubstr;
using testing::IsEmpty;

const char* const kTwoFaces =
    "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nusemtl felt\nf 1 2 3\nusemtl steel\nf 1 3 4\n";

class PatchKeys : public testing::Test {
 protected:
  [[nodiscard]] std::string scene(const std::string& lines) const {
    return "[[object]]\nname = \"pad\"\nmesh = \"" + mesh_.path().string() + "\"\n" + lines;
  }
  [[nodiscard]] SceneFile file(const std::string& lines) const {
    return parse_scene_file(scene(lines), "x.toml");
  }
  [[nodiscard]] std::string refusal(const std::string& lines) const {
    return test::refusal(scene(lines));
  }
  test::TemporaryMesh mesh_{".obj", kTwoFaces};
};

TEST_F(PatchKeys, GiveSiValuesAndInheritFromTheObject) {
  const auto patches =
      file(
          "surface = { stiffness = \"0.6 kN/m\", damping = 0.5 }\n"
          "patch = [{ name = \"felt\", surface = { stiffness = 200 } },\n"
          "         { name = \"steel\", friction = { static = 0.3, kinetic = 0.2 } }]\n")
          .scene.objects.at(0)
          .patches;
  ASSERT_EQ(patches.size(), 2u);
  EXPECT_EQ(patches[0].name, "felt");
  EXPECT_EQ(patches[0].surface.stiffness, 200);
  EXPECT_EQ(patches[0].surface.damping, 0.5);
  EXPECT_FALSE(patches[0].friction);
  EXPECT_EQ(patches[1].surface.stiffness, 600);
  ASSERT_TRUE(patches[1].friction);
  EXPECT_EQ(patches[1].friction->static_coefficient, 0.3);
  EXPECT_EQ(patches[1].friction->kinetic_coefficient, 0.2);
}

TEST_F(PatchKeys, RefuseBadValuesWithPlaceAndRemedy) {
  EXPECT_THAT(refusal("[[object.patch]]\nsurface = { stiffness = 1 }\n"), HasSubstr("'name'"));
  EXPECT_THAT(refusal("patch = [{ name = \"felt\" }, { name = \"felt\" }]\n"),
              HasSubstr("there is another patch 'felt': keep one"));
  EXPECT_THAT(refusal("patch = [{ name = \"felt\", surface = { stiffness = -1 } }]\n"),
              HasSubstr("x.toml:4:"));
  EXPECT_THAT(
      refusal("patch = [{ name = \"felt\", friction = { static = 0.1, kinetic = 0.2 } }]\n"),
      HasSubstr("kinetic must not be above static"));
  EXPECT_THAT(refusal("patch = [{ name = \"felt\", stiffnes = 1 }]\n"), HasSubstr("stiffnes"));
  try {
    (void)parse_scene_file("[[object]]\nname = \"b\"\nsphere = 1\npatch = [{ name = \"felt\" }]\n",
                           "x.toml");
    FAIL();
  } catch (const SceneFileError& error) {
    EXPECT_THAT(error.what(), HasSubstr("'patch' needs 'mesh' or 'heights'"));
  }
}

// Peers that read the same file agree on the numbers; a peer with other values has another world.
TEST_F(PatchKeys, AreInTheHashInAnyOrder) {
  const std::string felt = "{ name = \"felt\", surface = { stiffness = 200 } }";
  const std::string steel = "{ name = \"steel\", surface = { stiffness = 900 } }";
  const SceneFile one = file("patch = [" + felt + ", " + steel + "]\n");
  const SceneFile other = file("patch = [" + steel + ", " + felt + "]\n");
  EXPECT_EQ(one.hash, other.hash);
  EXPECT_NE(one.hash, file("").hash);
  EXPECT_NE(one.hash, file("patch = [" + felt + "]\n").hash);
  EXPECT_NE(one.hash, file("patch = [{ name = \"felt\" }, " + steel + "]\n").hash);
  for (const SceneFile* scene : {&one, &other}) {
    const auto patches = haptics::EffectPlan(scene->scene).objects().at(0).patches;
    ASSERT_NE(patches, nullptr);
    ASSERT_EQ(patches->patches.size(), 3u);
    EXPECT_EQ(patches->patches[1].name, "felt");
    EXPECT_EQ(patches->patches[2].name, "steel");
    EXPECT_THAT(haptics::patch_notes(*patches), IsEmpty());
  }
}

TEST(HandKeys, GiveTheContactRadius) {
  EXPECT_EQ(parse_scene_file("[hand]\ncontact_radius = \"2 mm\"\n", "x.toml").hand.contact_radius,
            0.002);
  EXPECT_EQ(parse_scene_file("", "x.toml").hand.contact_radius, 0.0);
}

}  // namespace
}  // namespace reckon::peer
