// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Every member has a key, and every word its value.
#include "reckon/peer/scene/scene_sections.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <optional>
#include <string>
#include <tuple>
#include <type_traits>
#include <vector>

#include "reckon/aoim/bundling/aggregator.hpp"
#include "reckon/peer/scene/node_section.hpp"

namespace reckon::peer {
namespace {

/// The place of a member that no key of a file fills.
template <class S, class T>
MemberPlace place_of(const S& whole, const T& member) {
  const auto octets = [](const auto& of) { return reinterpret_cast<const std::byte*>(&of); };
  return {static_cast<std::size_t>(octets(member) - octets(whole)), sizeof(T), alignof(T)};
}

/// Where the submembers of a member begin: its alignment explains the padding before it.
template <class S, class T>
MemberPlace start_of(const S& whole, const T& member) {
  MemberPlace place = place_of(whole, member);
  place.size = 0;
  return place;
}

/// The octets of an S that neither a key nor one of `unsaid` fills, as "8 to 16". Padding that the
/// alignment of the next member explains does not count.
template <class S>
std::vector<std::string> without_key(const Section<S>& section, std::vector<MemberPlace> unsaid) {
  std::vector<MemberPlace> places = section.places();
  places.insert(places.end(), unsaid.begin(), unsaid.end());
  std::ranges::sort(places, {}, [](const MemberPlace& place) {
    return std::tuple(place.offset, place.size, -static_cast<int>(place.alignment));
  });
  std::vector<std::string> found;
  std::size_t end = 0;
  for (const MemberPlace& next : places) {
    if (next.offset > end && next.offset - end >= next.alignment) {
      found.push_back(fmt::format("{} to {}", end, next.offset));
    }
    end = std::max(end, next.offset + next.size);
  }
  return found;
}

TEST(SceneSections, FillEveryMemberOfASceneExceptThese) {
  const SceneFile file;
  const auto of = [&](const auto& member) { return place_of(file, member); };
  const auto& settings = file.convergence.settings;
  std::vector<MemberPlace> unsaid = {
      of(file.path),
      of(file.files),    // noted as the reader opens them
      of(file.scene),    // its objects, which the file check reads
      of(file.nodes),    // the result of the node tables
      of(file.devices),  // read from their own tables
      of(file.entities),
      of(file.network.group),  // read with its port
      of(file.dead_reckoning.thresholds.of<deadreckon::SeenFrom>().visual_angle),
      of(settings.gentle_speed),
      of(settings.gentle_share),
      of(settings.gentle_turn),
      of(settings.shortest),
      of(settings.threshold),  // from [dead_reckoning]
      of(settings.threshold_angle),
      of(file.hash),
      of(file.hash_in_file),
      of(file.network.exercise_named),       // set by which key is present
      of(file.network.management),           // from its text
      of(file.network.touch),                // from its texts
      of(file.network.peers),                // from their texts
      of(file.aoim.awareness.kinds_wanted),  // from their names
      of(file.aoim.quad_tree.cells),         // from the keys that describe them
      start_of(file, file.aoim.awareness),
  };
  // A send rule without quantities has a place in their tuple, too.
  deadreckon::for_each_send_rule([&]<class Rule>(std::type_identity<Rule>) {
    const auto& values = file.dead_reckoning.thresholds.of<Rule>();
    if (std::is_empty_v<typename Rule::Parameters>) unsaid.push_back(of(values));
  });
  EXPECT_THAT(without_key(file_section(), unsaid), testing::IsEmpty());
}

TEST(SceneSections, FillEveryMemberOfOperatorsAndOutages) {
  const OperatorConfig config;
  const std::vector<MemberPlace> unsaid = {
      place_of(config, config.kind),  // set by which key is present
      place_of(config, config.fit_to)};
  EXPECT_THAT(without_key(operator_section(), unsaid), testing::IsEmpty());
  EXPECT_THAT(without_key(outage_section(), {}), testing::IsEmpty());
}

TEST(SceneSections, FillEveryMemberOfDevicesNodesAndEntities) {
  const DeviceConfig device;
  EXPECT_THAT(without_key(device_section(),
                          {place_of(device, device.orientation),
                           place_of(device, device.descriptor), place_of(device, device.described),
                           place_of(device, device.delay_samples), place_of(device, device.period),
                           place_of(device, device.driver),  // read by their names
                           place_of(device, device.driver_values)}),
              testing::IsEmpty());
  const NodeConfig node;
  EXPECT_THAT(without_key(node_section(), {place_of(node, node.orientation)}), testing::IsEmpty());
  const EntityConfig entity;
  const auto of = [&](const auto& member) { return place_of(entity, member); };
  EXPECT_THAT(
      without_key(entity_section(), {of(entity.type), of(entity.orientation), of(entity.turns),
                                     of(entity.dead_reckoning), of(entity.model)}),
      testing::IsEmpty())
      << "all others take more than one key, or the rest of the file";
  const TouchModel model;
  EXPECT_THAT(without_key(force_model_section(), {place_of(model, model.surface)}),
              testing::IsEmpty());
}

TEST(SceneSections, ReportAMemberWithoutKeyByItsPlace) {
  Section<Outage> section = outage_section();
  std::erase_if(section.rows, [](const auto& row) { return row.key().key == "duration"; });
  EXPECT_THAT(without_key(section, {}), testing::ElementsAre("8 to 16"));
}

TEST(SceneSections, HaveEachKeyOnce) {
  const auto& keys = scene_keys();
  for (auto key = keys.begin(); key != keys.end(); ++key) {
    EXPECT_TRUE(std::none_of(key + 1, keys.end(),
                             [&](const SceneKey& other) {
                               return other.section == key->section && other.key == key->key;
                             }))
        << key->section << ' ' << key->key;
  }
}

template <class T>
class SceneWords : public testing::Test {};
using TypesWithWords =
    testing::Types<NodeKind, OperatorKind, DeviceSource, pdu::ForceId, pdu::ForceModelKind,
                   aoim::CellScheme, pdu::CompressedForm, Prediction,
                   deadreckon::AccelerationReading, std::optional<pdu::DeadReckoningAlgorithm>,
                   const deadreckon::SendRule*, deadreckon::ConvergenceCurve>;
TYPED_TEST_SUITE(SceneWords, TypesWithWords);

TYPED_TEST(SceneWords, AreReadAsTheyAreWritten) {
  for (const auto& [name, value] : kWords<TypeParam>) {
    EXPECT_EQ(word_of(value), name);
    const std::optional<TypeParam> read = value_of<TypeParam>(name);
    ASSERT_TRUE(read);
    EXPECT_EQ(*read, value);
  }
  EXPECT_FALSE(value_of<TypeParam>(""));
}

TEST(SceneSections, TakeTheirLimitsFromWhereTheyAreKept) {
  const auto refusal = [](const std::string& text) -> std::string {
    try {
      (void)parse_scene_file(text, "x.toml");
    } catch (const SceneFileError& error) {
      return error.what();
    }
    return {};
  };
  EXPECT_EQ(refusal(fmt::format("[aoim]\npool = {}\n", aoim::kMaximumPool)), "");
  EXPECT_EQ(refusal(fmt::format("[aoim]\npool = {}\n", aoim::kMaximumPool + 1)),
            "x.toml:2:8: 'pool' is 1001; it must be 1 to 1000");
  EXPECT_EQ(refusal(fmt::format("[network.bundle]\nmax = {}\n", aoim::kLeastPayload)), "");
  EXPECT_EQ(refusal(fmt::format("[network.bundle]\nmax = \"{} B\"\n", aoim::kLeastPayload - 1)),
            "x.toml:2:7: 'max' is 279 B; it must be 280 B to 9216 B");
}

}  // namespace
}  // namespace reckon::peer
