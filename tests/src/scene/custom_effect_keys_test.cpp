// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Scene files with effects that a program adds.
#include <gmock/gmock.h>

#include <string>

#include "reckon/haptics/regions/region_custom.hpp"
#include "reckon/peer/scene/scene_file.hpp"
#include "reckon/tests/src/support/refusal.hpp"

namespace reckon::peer {
namespace {

using haptics::CustomEffects;
using testing::HasSubstr;

struct Values {
  double strength = 1.0, speed = 0.1;
};

/// Each `number` makes another effect type.
template <int number>
class Own : public haptics::CountedEffect<Own<number>> {
 public:
  using Parameters = Values;
  static constexpr bool kInContactOnly = true;
  static constexpr std::string_view kName = number == 2 ? "second" : "first";
  static constexpr std::string_view kKey = number == 2   ? "resin"
                                           : number == 3 ? "friction"
                                                         : "honey";
  static constexpr std::string_view kCost = "little";
  static constexpr std::array<haptics::EffectParameter<Values>, 2> kParameters{{
      {"strength", "N", &Values::strength, 0.0, 10.0, 1.0, "How much."},
      {"speed", "m/s", &Values::speed, 0.01, 1.0, 0.1, "How fast."},
  }};
  explicit Own(const Values& values) : values_(values) {
    haptics::check_parameters(kParameters, values);
    if (values.strength > 100.0 * values.speed)
      throw std::invalid_argument("so much strength needs more speed");
  }
  Eigen::Vector3d force(const haptics::EffectContact&) noexcept { return Eigen::Vector3d::Zero(); }
  double damping() const noexcept { return 0.0; }
  const Values& parameters() const noexcept { return values_; }

 private:
  Values values_;
};

std::string table(const std::string& lines) {
  return "[[object]]\nname = \"table\"\nplane = [0, 0, 1]\n" + lines;
}

SceneFile read(const std::string& lines, const CustomEffects& effects) {
  return parse_scene_file(table(lines), "x.toml", ".", effects);
}

std::string refusal(const std::string& lines, const CustomEffects& effects) {
  try {
    static_cast<void>(read(lines, effects));
    return "taken";
  } catch (const SceneFileError& error) {
    return error.what();
  }
}

TEST(CustomEffectKeys, GiveValuesWithUnitsAndTakeDefaults) {
  const auto effects = haptics::custom_effects<Own<1>, Own<2>>();
  const SceneFile scene = read("honey = { strength = \"2 N\", speed = \"50 mm/s\" }\n", effects);
  const auto& declared = scene.scene.objects.at(0).custom_effects;
  ASSERT_EQ(declared.size(), 1U);
  EXPECT_EQ(declared[0].effect->name(), "first");
  EXPECT_EQ(declared[0].values, (std::vector{2.0, 0.05}));
  EXPECT_EQ(read("resin = {}\n", effects).scene.objects.at(0).custom_effects.at(0).values,
            (std::vector{1.0, 0.1}));
  EXPECT_TRUE(read("", effects).scene.objects.at(0).custom_effects.empty());
}

TEST(CustomEffectKeys, RefuseBadValuesWithPlaceAndRemedy) {
  const auto effects = haptics::custom_effects<Own<1>>();
  EXPECT_THAT(refusal("honey = { strength = 11 }\n", effects),
              HasSubstr("x.toml:4:22: 'strength'"));
  EXPECT_THAT(refusal("honey = { strenght = 1 }\n", effects), HasSubstr("did you mean 'strength'"));
  EXPECT_THAT(refusal("honey = { strength = \"1 m\" }\n", effects), HasSubstr("'strength'"));
  EXPECT_THAT(refusal("honey = 3\n", effects), HasSubstr("it needs table"));
  EXPECT_THAT(refusal("honey = { strength = 9, speed = 0.05 }\n", effects),
              HasSubstr("x.toml:4:9: so much strength needs more speed"));
}

TEST(CustomEffectKeys, AnEffectThatTheProgramLacksIsNamed) {
  const std::string sentence = test::refusal(table("honey = { strength = 2 }\n"));
  EXPECT_THAT(sentence, HasSubstr("x.toml:4:1: unknown key 'honey'"));
  EXPECT_THAT(sentence, HasSubstr("a custom effect exists only in its own program"));
  EXPECT_THAT(refusal("resin = {}\n", haptics::custom_effects<Own<1>>()), HasSubstr("'resin'"));
}

TEST(CustomEffectKeys, AKeyThatIsTakenIsRefused) {
  EXPECT_THROW(read("", haptics::custom_effects<Own<3>>()), std::invalid_argument);
  EXPECT_THROW(read("", (haptics::custom_effects<Own<1>, Own<1>>())), std::invalid_argument);
}

/// An effect of regions whose key an effect of objects also has.
class Fog : public haptics::CountedEffect<Fog> {
 public:
  using Parameters = Values;
  static constexpr std::string_view kName = "fog", kKey = "honey", kCost = "little";
  static constexpr std::array<haptics::EffectParameter<Values>, 1> kParameters{
      {{"strength", "N", &Values::strength, 0.0, 10.0, 1.0, "How much."}}};
  explicit Fog(const Values& values) : values_(values) {
    haptics::check_parameters(kParameters, values);
  }
  Eigen::Vector3d force(const haptics::RegionPoint&) noexcept { return Eigen::Vector3d::Zero(); }
  const Values& parameters() const noexcept { return values_; }

 private:
  Values values_;
};

SceneFile read_region(const std::string& lines, const CustomEffects& effects) {
  return parse_scene_file("[[region]]\nname = \"cloud\"\n" + lines, "x.toml", ".", effects);
}

TEST(CustomEffectKeys, OfRegionsAreTakenThereAlone) {
  const auto effects = haptics::custom_effects<Own<1>, Own<2>, Fog>();
  const SceneFile scene = read_region("honey = { strength = \"2 N\" }\n", effects);
  const auto& declared = scene.scene.regions.at(0).custom_effects;
  ASSERT_EQ(declared.size(), 1U);
  EXPECT_EQ(declared[0].effect->name(), "fog");
  EXPECT_EQ(declared[0].values, std::vector{2.0});
  EXPECT_EQ(read("honey = {}\n", effects).scene.objects.at(0).custom_effects.at(0).effect->name(),
            "first");
  EXPECT_NE(read_region("honey = { strength = 3 }\n", effects).hash, scene.hash);
  const auto refused = [&](const std::string& lines, const CustomEffects& known) -> std::string {
    try {
      static_cast<void>(read_region(lines, known));
      return "taken";
    } catch (const SceneFileError& error) {
      return error.what();
    }
  };
  EXPECT_THAT(refused("honey = { strength = 11 }\n", effects),
              HasSubstr("x.toml:3:22: 'strength'"));
  EXPECT_THAT(refused("resin = {}\n", effects), HasSubstr("'resin'"));
  EXPECT_THAT(refused("honey = {}\n", haptics::custom_effects<Own<1>>()),
              HasSubstr("unknown key 'honey'"));
  EXPECT_THAT(refused("", effects), HasSubstr("border, honey"));
  EXPECT_THROW(read_region("", (haptics::custom_effects<Fog, Fog>())), std::invalid_argument);
}

TEST(CustomEffectKeys, EnterTheHashIndependentlyOfTheirOrder) {
  const auto effects = haptics::custom_effects<Own<1>, Own<2>>();
  const auto turned = haptics::custom_effects<Own<2>, Own<1>>();
  const std::string both = "honey = {}\nresin = {}\n", other = "resin = {}\nhoney = {}\n";
  EXPECT_EQ(read(both, effects).hash, read(other, turned).hash);
  EXPECT_EQ(read("honey = { strength = 1 }\n", effects).hash, read("honey = {}\n", turned).hash);
  EXPECT_NE(read("honey = { strength = 2 }\n", effects).hash, read("honey = {}\n", effects).hash);
  EXPECT_NE(read(both, effects).hash, read("honey = {}\n", effects).hash);
  EXPECT_EQ(read("", effects).hash, read("", {}).hash);
}

}  // namespace
}  // namespace reckon::peer
