// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// `reckon scene check` and `explain` of a scene that requests more than its devices can show.
#include <fmt/format.h>
#include <gmock/gmock.h>

#include <nlohmann/json.hpp>
#include <string>

#include "reckon/tests/support/mesh_text.hpp"
#include "reckon/tests/support/places.hpp"
#include "reckon/tests/tools/support/captured_console.hpp"
#include "reckon/tests/tools/support/temporary_scene.hpp"

namespace reckon::tools::scene_softness_test {
namespace {

using test::kPlain;
using test::run_reckon;
using test::TemporaryScene;
using ::testing::HasSubstr;
using ::testing::Not;

constexpr const char* kStiff =
    "[[object]]\nname = \"wall\"\nplane = [0, 0, 1]\nsurface = { stiffness = 20000 }\n"
    "[hand]\nk1 = 1500\ndamping = 0\n";

// 1 N s/m at 1 kHz: 0.95 x 2 b/T is 1900 N/m, 3/4 of it for walls and half for hands.
TEST(SceneCheck, ReportsWhatTheDefaultDeviceSoftens) {
  const TemporaryScene scene(kStiff);
  const auto text = run_reckon({"scene", "check", scene.path()});
  EXPECT_EQ(text.status, 0);
  EXPECT_THAT(
      text.out,
      HasSubstr("note: object wall has 20000 N/m, but is rendered with 1425 N/m by its device"));
  EXPECT_THAT(text.out, HasSubstr("note: hand has 1500 N/m, but is rendered with 950 N/m"));
  const auto json =
      nlohmann::json::parse(run_reckon({"scene", "check", "--json", scene.path()}).out);
  ASSERT_EQ(json["softened"].size(), 2u);
  EXPECT_EQ(json["softened"][0]["what"], "object wall");
  EXPECT_EQ(json["softened"][0]["shown"], 1425);
  EXPECT_EQ(json["softened"][0]["asked"], 20000);
  EXPECT_EQ(json["softened"][1]["shown"], 950);
}

// The remedy depends on the limit.
TEST(SceneCheck, NamesDampingOrTheDeviceLimitAsRemedy) {
  const auto wall = [](const std::string& device) {
    const TemporaryScene scene(
        "[[object]]\nname = \"wall\"\nplane = [1, 0, 0]\nsurface = { stiffness = 20000 }\n"
        "[[operator]]\npassive = true\nposition = [0.05, 0, 0]\n[[device]]\n"
        "position = [0.2, 0, 0]\n" +
        device);
    return run_reckon({"scene", "check", scene.path()}).out;
  };
  EXPECT_THAT(wall(""), HasSubstr("more damping, a higher rate or less delay in [[device]]"));
  EXPECT_THAT(wall("max_stiffness = 600\n"), HasSubstr("a greater max_stiffness in [[device]]"));
  EXPECT_THAT(wall("max_stiffness = 5000\n"), HasSubstr("more damping, a higher rate"));
  EXPECT_THAT(wall("driver = \"evdev\"\ntravel = 0.25\nfull_force = 15\nfull_stiffness = 2000\n"
                   "max_stiffness = 800\n"),
              HasSubstr("a greater max_stiffness in [[device]]"));
}

// Of 1 N s/m three quarters are for surfaces, at most half for dampers.
TEST(SceneCheck, ReportsRequestedAndReservedDamping) {
  const auto check = [](const std::string& damping, bool json) {
    const TemporaryScene scene(
        "[[object]]\nname = \"wall\"\nplane = [0, 0, 1]\nsurface = { stiffness = 100, damping = " +
        damping + " }\ndrag = { viscosity = 0.125 }\n[hand]\nk1 = 475\n");
    return json ? run_reckon({"scene", "check", "--json", scene.path()}).out
                : run_reckon({"scene", "check", scene.path()}).out;
  };
  EXPECT_THAT(check("2", false),
              HasSubstr("note: dampers of wall have 2.125 N s/m: 0.375 N s/m are reserved for them "
                        "by its device, and the rest is rendered if"));
  EXPECT_THAT(check("0.25", false), Not(HasSubstr("dampers")));
  const auto row = nlohmann::json::parse(check("2", true))["softened"].at(0);
  EXPECT_EQ(row["what"], "dampers of wall");
  EXPECT_EQ(row["asked"], 2.125);
  EXPECT_EQ(row["shown"], 0.375);
  EXPECT_EQ(row["unit"], "N s/m");
  // Walls get the rest of the device's damping.
  const auto felt = [](const std::string& damping) {
    const TemporaryScene scene(
        "[[object]]\nname = \"wall\"\nplane = [0, 0, 1]\n"
        "surface = { stiffness = 9000, damping = " +
        damping + " }\n");
    const auto json =
        nlohmann::json::parse(run_reckon({"scene", "check", "--json", scene.path()}).out);
    return json["softened"].at(0)["shown"].get<double>();
  };
  EXPECT_EQ(felt("0.375"), felt("50"));
  EXPECT_GT(felt("0.37"), felt("0.375"));
}

// Limit: 0.3 m / 3.5 T for a ball.
TEST(SceneCheck, ReportsDampersTooStrongForALightBody) {
  const auto check = [](const std::string& mass) {
    const TemporaryScene scene(
        "[[object]]\nname = \"ball\"\nsphere = \"20 mm\"\nmass = \"" + mass +
        "\"\nsurface = { stiffness = 300, damping = 2 }\ndrag = { viscosity = 3 }\n"
        "[[operator]]\npassive = true\n[[device]]\npeer = 1\n");
    return run_reckon({"scene", "check", scene.path()}).out;
  };
  EXPECT_THAT(check("7 g"), HasSubstr("drag of ball has 3 N s/m, but is rendered with 0.6 N s/m"));
  EXPECT_THAT(check("7 g"), HasSubstr("damping of ball has 2 N s/m, but is rendered with 0.6 N"));
  EXPECT_THAT(check("30 g"), HasSubstr("drag of ball"));
  EXPECT_THAT(check("30 g"), Not(HasSubstr("damping of ball")));
  EXPECT_THAT(check("40 g"), Not(HasSubstr("drag of ball")));
}

TEST(SceneCheck, ReportsOnlyTheWeakDevices) {
  const TemporaryScene scene(
      std::string(kStiff) +
      "[[operator]]\npassive = true\n[[device]]\nmarking = \"STRONG\"\ndamping = 20\n"
      "[[device]]\npeer = 2\nmarking = \"WEAK\"\ndamping = 2\n");
  const auto text = run_reckon({"scene", "check", scene.path()});
  EXPECT_THAT(text.out,
              HasSubstr("20000 N/m, but is rendered with 2850 N/m by device 1 WEAK of peer 2"));
  EXPECT_THAT(text.out, Not(HasSubstr("STRONG")));
  EXPECT_THAT(text.out, Not(HasSubstr("hand has"))) << "2 N s/m show 1900 N/m";
}

TEST(SceneCheck, ReportsTheSlopeLimitOfAHardeningHand) {
  const TemporaryScene scene("[hand]\nk1 = 500\nk3 = 15000000\ndamping = 0\n");
  const auto text = run_reckon({"scene", "check", scene.path()});
  EXPECT_THAT(text.out,
              HasSubstr("k3 of [hand] is rendered up to a slope of 950 N/m, 3.16 mm deep"));
  const auto json =
      nlohmann::json::parse(run_reckon({"scene", "check", "--json", scene.path()}).out);
  ASSERT_EQ(json["softened"].size(), 1u);
  EXPECT_TRUE(json["softened"][0]["asked"].is_null());
  EXPECT_NEAR(json["softened"][0]["from_m"].get<double>(), 0.00316228, 1e-7);
}

TEST(SceneCheck, ReportsNoSofteningIfAllIsShown) {
  const TemporaryScene scene(std::string(kPlain) + "[hand]\nk1 = 475\n");
  EXPECT_THAT(run_reckon({"scene", "check", scene.path()}).out, Not(HasSubstr("rendered with")));
  const TemporaryScene defaults{kPlain};
  EXPECT_THAT(run_reckon({"scene", "check", defaults.path()}).out, Not(HasSubstr("rendered with")));
  // The damper of 0.5 N s/m uses half of the spring that the device could show.
  const TemporaryScene stiffer(std::string(kPlain) + "[hand]\nk1 = 476\n");
  EXPECT_THAT(run_reckon({"scene", "check", stiffer.path()}).out,
              HasSubstr("hand has 476 N/m, but is rendered with 475 N/m"));
}

TEST(SceneExplain, ShowsAWallsFeltStiffness) {
  const TemporaryScene scene(std::string(kStiff) +
                             "[[object]]\nname = \"soft\"\nsphere = 1\n"
                             "surface = { stiffness = 300 }\n");
  const auto text = run_reckon({"scene", "explain", scene.path()});
  EXPECT_THAT(text.out, HasSubstr("stiffness 20000 N/m, damping 0 N s/m: felt with 1425 N/m"));
  EXPECT_THAT(text.out, Not(HasSubstr("300 N/m, damping 0 N s/m:")));
  EXPECT_THAT(text.out, HasSubstr("hand has 1500 N/m, but is rendered with 950 N/m"));
  const auto json = run_reckon({"scene", "explain", "--json", scene.path()});
  std::size_t rows = 0;
  for (const std::string& line : json.lines())
    rows += nlohmann::json::parse(line)["kind"] == "softened" ? 1 : 0;
  EXPECT_EQ(rows, 2u);
}

}  // namespace
}  // namespace reckon::tools::scene_softness_test
