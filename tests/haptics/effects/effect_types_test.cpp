// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/haptics/effects/effect_types.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <set>
#include <string>

#include "reckon/haptics/effects/effect_set.hpp"
#include "reckon/tests/support/places.hpp"

namespace reckon::haptics {
namespace {

using Eigen::Vector3d;

TEST(EffectTypes, EveryDefaultIsInRangeAndStruct) {
  for_each_effect([]<class Effect>(std::type_identity<Effect>) {
    const typename Effect::Parameters defaults{};
    for (const auto& row : Effect::kParameters) {
      EXPECT_EQ(defaults.*row.field, row.default_value) << Effect::kName << "." << row.key;
      EXPECT_LE(row.minimum, row.default_value);
      EXPECT_GE(row.maximum, row.default_value);
      EXPECT_THAT(std::string(row.help), testing::EndsWith("."));
    }
  });
}

TEST(EffectTypes, EveryEffectHasAHeaderAndARow) {
  // Shared code of effects is in effect_*.hpp; each other header is the effect of its name.
  std::set<std::string> headers;
  for (const auto& file :
       std::filesystem::directory_iterator(reckon::test::source_dir() + "/haptics/effects")) {
    const std::string name = file.path().stem().string();
    if (file.path().extension() == ".hpp" && !name.starts_with("effect_")) headers.insert(name);
  }
  std::set<std::string> rows;
  for_each_effect([&]<class Effect>(std::type_identity<Effect>) {
    EXPECT_TRUE(rows.emplace(Effect::kName).second) << Effect::kName << " has two rows";
  });
  EXPECT_EQ(headers, rows) << "a header without a row is simulated by nobody";
}

TEST(EffectTypes, NoTwoShareAKeyInSceneFiles) {
  std::set<std::string_view> keys;
  for_each_effect([&]<class Effect>(std::type_identity<Effect>) {
    EXPECT_TRUE(keys.insert(Effect::kKey).second) << Effect::kName << ": " << Effect::kKey;
  });
}

// The requirements of an effect beside its hook.
struct Nothing {
  double value = 1.0;
};
template <class Effect>
class Described : public CountedEffect<Effect> {
 public:
  using Parameters = Nothing;
  static constexpr std::string_view kName = "nothing";
  static constexpr std::string_view kKey = "nothing";
  static constexpr std::string_view kCost = "nothing";
  static constexpr std::array<EffectParameter<Nothing>, 1> kParameters{
      {{"value", "", &Nothing::value, 0.0, 1.0, 1.0, "None."}}};
  explicit Described(const Nothing& values) : values_(values) {}
  [[nodiscard]] const Nothing& parameters() const noexcept { return values_; }

 private:
  Nothing values_;
};

struct Good : Described<Good> {
  using Described<Good>::Described;
  Vector3d force(const EffectContact&) noexcept { return Vector3d::Zero(); }
  double damping() const noexcept { return 0.0; }
};
struct Misspelt : Described<Misspelt> {
  using Described<Misspelt>::Described;
  Vector3d forse(const EffectContact&) noexcept { return Vector3d::Zero(); }
};
struct MisspeltByHalf : Described<MisspeltByHalf> {
  using Described<MisspeltByHalf>::Described;
  FrictionCone& cone() noexcept { return cone_; }
  FrictionCone cone_{0.0, 0.0};
  Vector3d forse(const EffectContact&) noexcept { return Vector3d::Zero(); }
  double damping() const noexcept { return 0.0; }
};
struct Throwing : Described<Throwing> {
  using Described<Throwing>::Described;
  FrictionCone& cone() noexcept { return cone_; }
  FrictionCone cone_{0.0, 0.0};
  Vector3d force(const EffectContact&) { return Vector3d::Zero(); }
  double damping() const noexcept { return 0.0; }
};
struct Undescribed : CountedEffect<Undescribed> {
  Vector3d force(const EffectContact&) noexcept { return Vector3d::Zero(); }
  double damping() const noexcept { return 0.0; }
};

TEST(EffectHooks, EffectWithoutACompleteHookIsRejected) {
  EXPECT_TRUE(DescribedEffect<Good> && HookedEffect<Good> && WholeHooks<Good>);
  EXPECT_TRUE(DescribedEffect<Misspelt>);
  EXPECT_FALSE(HookedEffect<Misspelt>);
  EXPECT_TRUE(HookedEffect<MisspeltByHalf>) << "by its cone";
  EXPECT_FALSE(WholeHooks<MisspeltByHalf>);
  EXPECT_FALSE(WholeHooks<Throwing>) << "a hook that may throw is none";
  EXPECT_FALSE(DescribedEffect<Undescribed>);
}

// Such an effect is not evaluated without contact of its object.
TEST(EffectHooks, ContactOnlyEffectsGiveNothingWithoutContact) {
  for_each_effect([&]<class Effect>(std::type_identity<Effect>) {
    if constexpr (GivesForce<Effect> && ActsInContactOnly<Effect>) {
      typename Effect::Parameters parameters;
      for (const auto& row : Effect::kParameters) parameters.*row.field = row.maximum;
      Effect effect(parameters);
      EffectContact free;
      free.device = Vector3d(0.1, 0.2, 0.3);
      free.velocity = Vector3d(-1.0, 2.0, 0.5);
      EXPECT_EQ(effect.force(free), Vector3d::Zero()) << Effect::kName;
    }
  });
}

TEST(EffectSlots, HoldDeclaredAndPermanentEffects) {
  DeclaredEffects effects;
  EXPECT_EQ(effects.find<StickSlipFriction>(), nullptr);
  ASSERT_NE(effects.find<SpringDamper>(), nullptr) << "whatever can be touched has a surface";
  effects.declare<StickSlipFriction>().static_coefficient = 0.9;
  ASSERT_NE(effects.find<StickSlipFriction>(), nullptr);
  EXPECT_EQ(effects.declare<StickSlipFriction>().static_coefficient, 0.9) << "declared before";
  int declared = 0;
  effects.for_each([&](const auto&) { ++declared; });
  EXPECT_EQ(declared, 2);
}

}  // namespace
}  // namespace reckon::haptics
