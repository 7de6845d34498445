// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Recorded exercises mapped to other numbers, IDs and places, with every golden sample.
#include "reckon/tools/captures/exercise_map.hpp"

#include <gmock/gmock.h>

#include <cmath>
#include <cstring>
#include <filesystem>
#include <map>
#include <numbers>
#include <set>
#include <string>
#include <vector>

#include "reckon/deadreckon/motion/drm.hpp"
#include "reckon/pdu/bundle.hpp"
#include "reckon/pdu/pdu_types.hpp"
#include "reckon/tests/support/capture_builder.hpp"
#include "reckon/tests/support/wire_samples.hpp"
#include "reckon/tools/captures/placed_fields.hpp"
#include "reckon/tools/command_line/console.hpp"

namespace reckon::tools::exercise_map_test {
namespace {

using test::append_pdu;
using test::Octets;
using ::testing::HasSubstr;
using Vector = Eigen::Vector3d;

constexpr double kDegree = std::numbers::pi / 180;

ExerciseMap map_of(std::vector<std::string> exercises, std::vector<std::string> ids,
                   std::string place, bool lenient = false) {
  return ExerciseMap({std::move(exercises), std::move(ids), std::move(place)}, lenient);
}

/// The PDU as mapped.
template <typename Pdu>
Pdu mapped(ExerciseMap& map, const Pdu& pdu) {
  Octets octets;
  append_pdu(octets, pdu);
  map.apply(octets);
  Pdu out;
  EXPECT_EQ(decode(octets, out), pdu::DecodeError::none);
  return out;
}

std::vector<std::string> samples() {
  std::vector<std::string> names;
  for (const auto& file :
       std::filesystem::directory_iterator(test::sample_path("fire", ".hex").parent_path()))
    if (file.path().extension() == ".hex") names.push_back(file.path().stem());
  return names;
}

/// Collects the IDs and places of a PDU, and the names of its vectors.
struct Collector {
  template <typename T>
  void operator()(std::string_view, const T&, std::size_t) {}
  void operator()(std::string_view, const pdu::EntityId& id, std::size_t) { ids.push_back(id); }
  void operator()(std::string_view, const pdu::SimulationAddress& id, std::size_t) {
    ids.push_back({id.site, id.application, 0});
  }
  void operator()(std::string_view, const pdu::EventId& id, std::size_t) {
    ids.push_back({id.site, id.application, 0});
  }
  void operator()(std::string_view, const pdu::LiveEntityId& id, std::size_t) {
    ids.push_back({id.site, id.application, id.entity});
  }
  void operator()(std::string_view, const pdu::WorldCoordinates& p, std::size_t) {
    places.emplace_back(p.x, p.y, p.z);
  }
  void operator()(std::string_view name, const pdu::Vector3Float& v, std::size_t) {
    vectors.insert(std::string(name));
    (void)v;
  }
  void octets(std::string_view, std::span<const std::byte>) {}

  std::vector<pdu::EntityId> ids;
  std::vector<Vector> places;
  std::set<std::string> vectors;
};

Collector collected(const Octets& octets) {
  Collector all;
  for (const pdu::BundledPdu& bundled : pdu::BundleReader(octets)) {
    const auto error = pdu::visit(bundled.bytes, bundled.header, [&](const auto& pdu) {
      PlacedFields placed(bundled.bytes, all);
      fields(placed, pdu);
    });
    EXPECT_EQ(error, pdu::DecodeError::none);
  }
  return all;
}

/// Reads each number again at its stated offset.
struct SecondReader {
  template <typename T>
  void operator()(std::string_view name, const T& value, std::size_t at) {
    if constexpr (pdu::Scalar<T>) {
      ASSERT_LE(at + sizeof(T), whole.size()) << name;
      const T again = pdu::load_big_endian<T>(whole.data() + at);
      EXPECT_EQ(std::memcmp(&again, &value, sizeof(T)), 0) << name << " at " << at;
    }
  }
  void octets(std::string_view, std::span<const std::byte>) {}

  std::span<const std::byte> whole;
};

TEST(ExerciseMap, ReadsEachFieldAtItsOffset) {
  for (const std::string& name : samples()) {
    SCOPED_TRACE(name);
    const Octets octets = test::sample_octets(name);
    pdu::PduHeader header;
    ASSERT_EQ(pdu::decode_header(octets, header), pdu::DecodeError::none);
    const auto error = pdu::visit(octets, header, [&](const auto& pdu) {
      SecondReader reader{octets};
      PlacedFields placed(octets, reader);
      fields(placed, pdu);
    });
    EXPECT_EQ(error, pdu::DecodeError::none);
  }
}

TEST(ExerciseMap, ChangesOnlyTheIdsOfEverySample) {
  for (const std::string& name : samples()) {
    SCOPED_TRACE(name);
    const Octets before = test::sample_octets(name);
    const Collector old = collected(before);
    Octets octets = before;
    ExerciseMap map = map_of({"77"}, {"*:*:*=*:201:*"}, "");
    map.apply(octets);
    ASSERT_EQ(octets.size(), before.size());
    EXPECT_EQ(octets[1], std::byte{77});
    const Collector now = collected(octets);
    ASSERT_EQ(now.ids.size(), old.ids.size());
    for (std::size_t i = 0; i < now.ids.size(); ++i) {
      pdu::EntityId expected = old.ids[i];
      const bool is_none = expected == pdu::EntityId{};
      const bool is_all = expected.site == 0xFFFF || expected.application == 0xFFFF;
      if (!is_none && !is_all) expected.application = 201;
      EXPECT_EQ(now.ids[i], expected) << i;
    }
    EXPECT_EQ(now.places, old.places);

    // Mapped back: no other octet was changed.
    std::size_t differ = 0;
    for (std::size_t i = 0; i < octets.size(); ++i) differ += octets[i] != before[i] ? 1 : 0;
    EXPECT_LE(differ, 1 + 2 * now.ids.size());
    EXPECT_EQ(map.counts().mapped, 1U);
  }
}

TEST(ExerciseMap, MovesThePlacesOfEverySampleAndBack) {
  for (const std::string& name : samples()) {
    SCOPED_TRACE(name);
    const Octets before = test::sample_octets(name);
    const Collector old = collected(before);
    Octets octets = before;
    ExerciseMap map = map_of({}, {}, "48.1,11.6=-33.9,151.2");
    map.apply(octets);
    const Collector there = collected(octets);
    EXPECT_EQ(there.ids, old.ids);
    ASSERT_EQ(there.places.size(), old.places.size());
    for (std::size_t i = 0; i < old.places.size(); ++i) {
      if (old.places[i] == Vector::Zero()) {
        EXPECT_EQ(there.places[i], Vector::Zero());
        continue;
      }
      EXPECT_GT((there.places[i] - old.places[i]).norm(), 1e3);
      for (std::size_t j = 0; j < i; ++j) {
        if (old.places[j] == Vector::Zero()) continue;
        EXPECT_NEAR((there.places[i] - there.places[j]).norm(),
                    (old.places[i] - old.places[j]).norm(), 1e-6);
      }
    }
    map_of({}, {}, "-33.9,151.2=48.1,11.6").apply(octets);
    const Collector back = collected(octets);
    for (std::size_t i = 0; i < old.places.size(); ++i)
      EXPECT_LT((back.places[i] - old.places[i]).norm(), 1e-6);
  }
}

TEST(ExerciseMap, KnowsTheAxesOfEveryTypesVectors) {
  std::set<std::string> names;
  const auto add = [&]<typename Pdu>(std::type_identity<Pdu>) {
    Collector all;
    const Pdu pdu{};
    PlacedFields placed({}, all);
    fields(placed, pdu);
    names.merge(all.vectors);
  };
  [&]<typename... T>(pdu::TypeList<T...>) { (add(std::type_identity<T>{}), ...); }(pdu::PduTypes{});
  for (const std::string& name : samples())
    names.merge(collected(test::sample_octets(name)).vectors);
  EXPECT_GE(names.size(), 15U);
  for (const std::string& name : names) EXPECT_TRUE(axes_of(name).has_value()) << name;
}

/// An aircraft at 48 N 11 E that flies north-east and climbs.
pdu::EntityState aircraft(pdu::DeadReckoningAlgorithm algorithm) {
  const deadreckon::LocalFrame here(48 * kDegree, 11 * kDegree, 3000);
  pdu::EntityState pdu;
  pdu.entity_id = {1, 2, 3};
  pdu.location = {here.origin().x(), here.origin().y(), here.origin().z()};
  Vector velocity(70, 70, 5);
  // Nose to the north, wings level: body axes are north, east, down.
  Eigen::Matrix3d body;
  body << 0, 1, 0, 1, 0, 0, 0, 0, -1;
  const auto angles =
      deadreckon::euler_from_quaternion(here.world_from_scene(Eigen::Quaterniond(body)));
  pdu.orientation = {static_cast<float>(angles.psi), static_cast<float>(angles.theta),
                     static_cast<float>(angles.phi)};
  if (!deadreckon::drm_terms(algorithm).body_axes)
    velocity = here.world_from_scene_vector(velocity);
  pdu.linear_velocity = {static_cast<float>(velocity.x()), static_cast<float>(velocity.y()),
                         static_cast<float>(velocity.z())};
  pdu.dead_reckoning.algorithm = algorithm;
  return pdu;
}

TEST(ExerciseMap, TurnsVelocityAndHeadingAlongWithThePlace) {
  for (const auto algorithm :
       {pdu::DeadReckoningAlgorithm::fpw, pdu::DeadReckoningAlgorithm::fpb}) {
    ExerciseMap map = map_of({}, {}, "-33.9,151.2");
    const pdu::EntityState old = aircraft(algorithm);
    const pdu::EntityState now = mapped(map, old);
    const deadreckon::LocalFrame there(-33.9 * kDegree, 151.2 * kDegree, 3000);
    const Vector place(now.location.x, now.location.y, now.location.z);
    EXPECT_LT((place - there.origin()).norm(), 1e-6);  // at its own height
    const auto body = deadreckon::quaternion_from_euler(
        {now.orientation.psi, now.orientation.theta, now.orientation.phi});
    const Vector nose = there.scene_from_world_vector(body * Vector::UnitX());
    EXPECT_LT((nose - Vector::UnitY()).norm(), 1e-6);  // north
    const Vector velocity(now.linear_velocity.x, now.linear_velocity.y, now.linear_velocity.z);
    const bool is_body = deadreckon::drm_terms(algorithm).body_axes;
    const Vector seen = is_body ? velocity : there.scene_from_world_vector(velocity);
    EXPECT_LT((seen - Vector(70, 70, 5)).norm(), 1e-4);
  }
}

TEST(ExerciseMap, TurnsUpdatesByTheirEntityStatesAxes) {
  for (const auto algorithm :
       {pdu::DeadReckoningAlgorithm::fpw, pdu::DeadReckoningAlgorithm::fpb}) {
    ExerciseMap map = map_of({}, {}, "48,11,3000=-33.9,151.2,3000");
    const pdu::EntityState state = aircraft(algorithm);
    (void)mapped(map, state);
    pdu::EntityStateUpdate update;
    update.entity_id = state.entity_id;
    update.entity_linear_velocity = state.linear_velocity;
    update.entity_location = state.location;
    const bool is_body = deadreckon::drm_terms(algorithm).body_axes;
    EXPECT_EQ(mapped(map, update).entity_linear_velocity == state.linear_velocity, is_body);
  }
}

TEST(ExerciseMap, KeepsTheBearingsOfOthersFromTheFirst) {
  ExerciseMap map = map_of({}, {}, "-33.9,151.2");
  const deadreckon::LocalFrame here(48 * kDegree, 11 * kDegree, 0);
  const deadreckon::LocalFrame there(-33.9 * kDegree, 151.2 * kDegree, 0);
  for (const Vector& scene : {Vector(0, 0, 0), Vector(3000, 0, 50), Vector(-500, 9000, -2)}) {
    pdu::EntityState pdu;
    const Vector world = here.world_from_scene(scene);
    pdu.location = {world.x(), world.y(), world.z()};
    const pdu::WorldCoordinates now = mapped(map, pdu).location;
    EXPECT_LT((there.scene_from_world(Vector(now.x, now.y, now.z)) - scene).norm(), 1e-5);
  }
}

TEST(ExerciseMap, TakesTheFirstRuleThatFits) {
  ExerciseMap map = map_of({"1=7", "2=1"}, {"1:2:3=5:5:5", "1:2:*=9:*:*", "4:*:*=4:8:*"}, "");
  pdu::Fire fire;
  fire.header.exercise_id = 1;
  fire.firing_entity_id = {1, 2, 3};
  fire.target_entity_id = {1, 2, 4};
  fire.munition_expendable_id = {4, 6, 1};
  fire.event_id = {1, 2, 30};
  const pdu::Fire now = mapped(map, fire);
  EXPECT_EQ(now.header.exercise_id, 7);
  EXPECT_EQ(now.firing_entity_id, (pdu::EntityId{5, 5, 5}));
  EXPECT_EQ(now.target_entity_id, (pdu::EntityId{9, 2, 4}));
  EXPECT_EQ(now.munition_expendable_id, (pdu::EntityId{4, 8, 1}));
  EXPECT_EQ(now.event_id, (pdu::EventId{9, 2, 30}));
  fire.header.exercise_id = 3;
  EXPECT_EQ(mapped(map, fire).header.exercise_id, 3);
  pdu::StartResume all;
  all.originating_entity_id = {1, 2, 0};
  all.receiving_entity_id = pdu::kAllEntities;
  EXPECT_EQ(mapped(map, all).originating_entity_id, (pdu::EntityId{9, 2, 0}));
  EXPECT_EQ(mapped(map, all).receiving_entity_id, pdu::kAllEntities);
}

TEST(ExerciseMap, ReportsUnmappablePdus) {
  ExerciseMap map = map_of({}, {"*:*:*=300:*:*"}, "10,20");
  for (const char* name : {"fire", "le_fire", "tspi", "gridded_data", "signal"}) {
    Octets octets = test::sample_octets(name);
    map.apply(octets);
  }
  Octets unknown = test::sample_octets("fire");
  unknown[2] = std::byte{222};
  map.apply(unknown);
  Octets cut = test::sample_octets("fire");
  cut.pop_back();
  map.apply(cut);
  EXPECT_EQ(map.counts().mapped, 5U);
  EXPECT_EQ(map.counts().untabled, 1U);
  EXPECT_EQ(map.counts().broken, 1U);
  EXPECT_EQ(map.counts().ids, 2U);
  EXPECT_GE(map.counts().places, 2U);
  EXPECT_THAT(map.summary(), HasSubstr("5 PDUs mapped\n1 PDU not mapped: damaged"));
  EXPECT_THAT(map.summary(),
              HasSubstr("with locations that cannot be moved: live entities, grids"));
  EXPECT_EQ(map_of({}, {}, "").summary(), "");
}

TEST(ExerciseMap, CountsEachPduWithAnUnmovablePlace) {
  for (const auto& [name, places] : std::map<std::string, std::size_t>{{"fire", 0},
                                                                       {"gridded_data", 1},
                                                                       {"compressed_states", 1},
                                                                       {"cell_snapshot", 1},
                                                                       {"assured_record", 1}}) {
    ExerciseMap map = map_of({}, {}, "10,20=30,40");
    Octets octets = test::sample_octets(name);
    map.apply(octets);
    EXPECT_EQ(map.counts().mapped, 1U) << name;
    EXPECT_EQ(map.counts().places, places) << name;
  }
}

TEST(ExerciseMap, MapsAPduWithoutALengthIfLenient) {
  Octets octets = test::sample_octets("fire");
  octets[8] = octets[9] = std::byte{0};
  const Octets before = octets;
  map_of({"9"}, {"*:*:*=77:*:*"}, "").apply(octets);
  EXPECT_EQ(octets[12], before[12]);
  map_of({"9"}, {"*:*:*=77:*:*"}, "", true).apply(octets);
  EXPECT_EQ(octets[1], std::byte{9});
  EXPECT_EQ(octets[13], std::byte{77});
  EXPECT_EQ(octets[8], std::byte{0});
  EXPECT_EQ(octets[9], std::byte{0});
}

TEST(ExerciseMap, RefusesInvalidMapsWithTheRemedy) {
  const auto error_of = [](auto make) {
    try {
      make();
    } catch (const UsageError& error) {
      return std::string(error.what());
    }
    return std::string("none");
  };
  for (const char* text : {"1=2=3", "256", "1=", "x=1", "-1"})
    EXPECT_THAT(error_of([&] { map_of({text}, {}, ""); }), HasSubstr("write FROM=TO, each 0 to"));
  for (const char* text : {"1:2:3", "1:2=3:4", "1:2:70000=1:2:3", "1:2:3=1:2:3=1:2:3", ""})
    EXPECT_THAT(error_of([&] { map_of({}, {text}, ""); }), HasSubstr("site:application:entity"));
  EXPECT_THAT(error_of([] { map_of({}, {"1:2:*=1:2:3"}, ""); }), HasSubstr("merge all entities"));
  for (const char* text : {"91,0", "1", "1,2,3,4", "a,b", "1,2=3,4=5,6", "nan,1", "1,2,1e9"})
    EXPECT_THAT(error_of([&] { map_of({}, {}, text); }), HasSubstr("LATITUDE,LONGITUDE"));
  EXPECT_THAT(error_of([] { map_of({}, {}, "1,2,3=4,5"); }), HasSubstr("give both heights"));
}

}  // namespace
}  // namespace reckon::tools::exercise_map_test
