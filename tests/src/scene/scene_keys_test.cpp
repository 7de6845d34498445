// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The list of keys: each is read and checked, its default equals the default in the struct, and the
// documentation contains it.
#include "reckon/peer/scene/scene_keys.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <fstream>
#include <iterator>
#include <numbers>
#include <string>
#include <type_traits>

#include "reckon/haptics/effects/effect_types.hpp"
#include "reckon/peer/notation/nearest_word.hpp"
#include "reckon/tests/src/support/refusal.hpp"
#include "reckon/tests/support/allocation_guard.hpp"
#include "reckon/tests/support/places.hpp"

namespace reckon::peer {
namespace {

using std::chrono::milliseconds;
using test::refusal;
using testing::HasSubstr;
using testing::Not;

/// A file with `value` for `key`, and nothing besides its section.
std::string file_with(const SceneKey& key, const std::string& value) {
  const std::string path = key.section;
  std::string text;
  for (std::size_t end = 0; end != std::string::npos && !path.empty();) {
    end = path.find('.', end + 1);
    text += section_name(path.substr(0, end)) + '\n';
  }
  return text + key.key + " = " + value + "\n";
}

/// The place of the value in a file of file_with().
std::string place_of(const std::string& text, const SceneKey& key) {
  const auto line = std::ranges::count(text, '\n');
  return fmt::format("x.toml:{}:{}: ", line, key.key.size() + 4);
}

TEST(SceneKeys, AreAllReadAndCheckedForTheirType) {
  for (const SceneKey& key : scene_keys()) {
    const std::string text = file_with(key, "2026-01-01");
    EXPECT_THAT(refusal(text), HasSubstr(place_of(text, key) + "'" + key.key + "' is a date"))
        << text;
  }
}

TEST(SceneKeys, AreAllCheckedForTheirRange) {
  for (const SceneKey& key : scene_keys()) {
    if (key.kind != KeyKind::number && key.kind != KeyKind::integer) continue;
    const bool whole = key.kind == KeyKind::integer;
    for (const double outside : {key.least - 1, key.most * 2 + 1}) {
      const std::string text =
          file_with(key, whole ? fmt::format("{:.0f}", outside) : fmt::format("{:.12e}", outside));
      EXPECT_THAT(refusal(text), HasSubstr(place_of(text, key) + "'" + key.key + "' is ")) << text;
    }
    for (const double inside : {key.least, key.most}) {
      const std::string text =
          file_with(key, whole ? fmt::format("{:.0f}", inside) : fmt::format("{:.17e}", inside));
      EXPECT_THAT(refusal(text), Not(HasSubstr("'" + key.key + "' is "))) << text;
    }
  }
}

void expect_same_prediction(const SceneFile& told, const SceneFile& silent) {
  EXPECT_EQ(told.dead_reckoning.algorithm, silent.dead_reckoning.algorithm);
  EXPECT_EQ(told.dead_reckoning.thresholds.position, silent.dead_reckoning.thresholds.position);
  EXPECT_DOUBLE_EQ(told.dead_reckoning.thresholds.angle, silent.dead_reckoning.thresholds.angle);
  EXPECT_EQ(told.dead_reckoning.thresholds.force, silent.dead_reckoning.thresholds.force);
  EXPECT_EQ(told.dead_reckoning.heartbeat, silent.dead_reckoning.heartbeat);
  EXPECT_EQ(told.dead_reckoning.rule, silent.dead_reckoning.rule);
  EXPECT_EQ(told.dead_reckoning.thresholds.weber, silent.dead_reckoning.thresholds.weber);
  deadreckon::for_each_send_rule([&]<class Rule>(std::type_identity<Rule>) {
    for (const auto& row : Rule::kParameters)
      EXPECT_EQ(told.dead_reckoning.thresholds.of<Rule>().*row.field,
                silent.dead_reckoning.thresholds.of<Rule>().*row.field)
          << row.key;
  });
  EXPECT_EQ(told.dead_reckoning.acceleration, silent.dead_reckoning.acceleration);
  EXPECT_EQ(told.convergence.settings.curve, silent.convergence.settings.curve);
  EXPECT_EQ(told.convergence.settings.duration, silent.convergence.settings.duration);
  EXPECT_EQ(told.convergence.settings.longest, silent.convergence.settings.longest);
  EXPECT_DOUBLE_EQ(told.convergence.settings.teleport_angle,
                   silent.convergence.settings.teleport_angle);
  EXPECT_EQ(told.convergence.settings.teleport_distance,
            silent.convergence.settings.teleport_distance);
  EXPECT_EQ(told.convergence.prediction, silent.convergence.prediction);
}

TEST(SceneKeys, StateTheDefaultsOfTheStructs) {
  const auto& keys = scene_keys();
  const auto section_as_written = [&](const std::string& section) {
    std::string text = "[" + section + "]\n";
    for (const SceneKey& key : keys) {
      if (key.section != section || key.standard.empty()) continue;
      const bool quoted =
          key.kind == KeyKind::number || key.kind == KeyKind::text || key.kind == KeyKind::choice;
      text +=
          fmt::format(fmt::runtime(quoted ? "{} = \"{}\"\n" : "{} = {}\n"), key.key, key.standard);
    }
    return text;
  };
  std::string text;
  for (const char* section : {"scene.origin", "hand", "dead_reckoning", "aoim", "network",
                              "network.bundle", "impairment", "convergence"}) {
    text += section_as_written(section);
  }
  const SceneFile told = parse_scene_file(text, "x.toml");
  const SceneFile silent = parse_scene_file("", "x.toml");
  EXPECT_EQ(told.hash, silent.hash);
  EXPECT_EQ(told.hand.radius, silent.hand.radius);
  EXPECT_EQ(told.hand.k1, silent.hand.k1);
  EXPECT_EQ(told.hand.k3, silent.hand.k3);
  EXPECT_EQ(told.hand.damping, silent.hand.damping);
  EXPECT_EQ(told.hand.static_friction, silent.hand.static_friction);
  EXPECT_EQ(told.hand.kinetic_friction, silent.hand.kinetic_friction);
  EXPECT_EQ(told.hand.validity, silent.hand.validity);
  expect_same_prediction(told, silent);
  EXPECT_EQ(told.aoim.radius, silent.aoim.radius);
  EXPECT_EQ(told.network.group, silent.network.group);
  EXPECT_EQ(told.network.interop, silent.network.interop);
  EXPECT_EQ(told.network.exercise, silent.network.exercise);
  EXPECT_EQ(told.network.ttl, silent.network.ttl);
  EXPECT_EQ(told.network.rate, silent.network.rate);
  EXPECT_EQ(told.network.offload, silent.network.offload);
  EXPECT_EQ(told.network.entities, silent.network.entities);
  EXPECT_EQ(told.network.bundle_max, silent.network.bundle_max);
  EXPECT_EQ(told.network.bundle.hold, silent.network.bundle.hold);
  EXPECT_EQ(told.network.bundle.updates, silent.network.bundle.updates);
  EXPECT_EQ(told.impairment.law.reorder_delay, silent.impairment.law.reorder_delay);
  EXPECT_EQ(told.impairment.seed, silent.impairment.seed);
  EXPECT_TRUE(told.impairment.law.is_perfect());
}

TEST(SceneKeys, OfEffectsStateTheDefaultsOfTheStructs) {
  haptics::for_each_effect([]<class Effect>(std::type_identity<Effect>) {
    const typename Effect::Parameters standard;
    for (const auto& row : Effect::kParameters) {
      EXPECT_EQ(standard.*row.field, row.default_value) << Effect::kName << ' ' << row.key;
    }
  });
}

std::string documentation() {
  std::ifstream page(reckon::test::source_dir() + "/docs/scene_files.md");
  return {std::istreambuf_iterator<char>(page), {}};
}

TEST(SceneKeys, StandInTheDocumentationAsTheyAre) {
  EXPECT_THAT(documentation(), HasSubstr(scene_keys_markdown()))
      << "docs/scene_files.md is behind the list: replace its tables by those that "
         "`reckon scene keys` prints";
}

TEST(SceneFile, OfTheDocumentationIsGood) {
  const std::string page = documentation();
  const auto begin = page.find("```toml\n") + 8;
  const SceneFile file = parse_scene_file(page.substr(begin, page.find("```", begin) - begin), "x");
  EXPECT_EQ(file.scene.objects.size(), 2U);
  EXPECT_EQ(file.operators.at(0).from, Eigen::Vector3d(-0.06, 0, 0.09));
}

TEST(NearestKey, IsGivenForATypoOnly) {
  const std::vector<std::string_view> keys = {"stiffness", "damping", "k1", "k3"};
  EXPECT_EQ(nearest_word("stifness", keys), "stiffness");
  EXPECT_EQ(nearest_word("dampign", keys), "damping");
  EXPECT_EQ(nearest_word("k2", keys), "k1");
  EXPECT_EQ(nearest_word("colour", keys), "");
}

TEST(NearestKey, UsesMemoryByTheKnownWordsOnly) {
  const std::string typed(1'000'000, 'k');
  const std::vector<std::string_view> keys = {"stiffness", "k1"};
  const test::AllocationGuard guard;
  const std::string_view nearest = nearest_word(typed, keys);
  const std::size_t peak = guard.peak_octets();
  EXPECT_EQ(nearest, "");
  EXPECT_LE(peak, 1024U);
}

}  // namespace
}  // namespace reckon::peer
