// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// [[entity]] of a scene file.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <fstream>
#include <numbers>
#include <string>
#include <utility>

#include "reckon/deadreckon/motion/geocentric.hpp"
#include "reckon/deadreckon/motion/rotation.hpp"
#include "reckon/peer/scene/scene_file.hpp"
#include "reckon/tests/src/support/refusal.hpp"
#include "reckon/tests/support/scratch_folder.hpp"

namespace reckon::peer {
namespace {

using Eigen::Vector3d;
using std::chrono::seconds;
using test::refusal;
using testing::HasSubstr;

constexpr double kDegree = std::numbers::pi / 180;

EntityConfig entity_of(const std::string& lines, const std::string& rest = "") {
  return parse_scene_file("[[entity]]\n" + lines + rest, "x.toml").entities.at(0);
}

TEST(EntitySection, GivesEveryValueInSi) {
  const EntityConfig entity = entity_of(R"(
peer = 2
marking = "POST"
type = "1.1.225.1"
force_id = "opposing"
appearance = 4294967295
capabilities = 3
position = "1 2 3 cm"
power = "20 mW"
[entity.force_model]
kind = "plane"
k1 = "2 N/mm"
k3 = "1 MN/m3"
damping = "1 N s/m"
static_friction = 0.2
kinetic_friction = 0.1
point = "0 0 -5 mm"
normal = [0, 3, 4]
validity = "20 s"
mass = "500 g"
restitution = "50 %"
)");
  EXPECT_EQ(entity.peer, 2u);
  EXPECT_EQ(entity.marking, "POST");
  EXPECT_EQ(entity.type,
            (pdu::EntityType{pdu::EntityKind::platform, pdu::EntityDomain::land, 225, 1}));
  EXPECT_EQ(entity.force_id, pdu::ForceId::opposing);
  EXPECT_EQ(entity.appearance, 0xFFFFFFFFu);
  EXPECT_EQ(entity.capabilities, 3u);
  EXPECT_EQ(entity.position, Vector3d(0.01, 0.02, 0.03));
  EXPECT_EQ(entity.power, 0.02);
  ASSERT_TRUE(entity.model);
  const deadreckon::ForceModel& model = *entity.model;
  EXPECT_EQ(model.kind, pdu::ForceModelKind::plane);
  EXPECT_EQ(model.k1, 2000);
  EXPECT_EQ(model.k3, 1e6);
  EXPECT_EQ(model.damping, 1);
  EXPECT_EQ(model.static_friction, 0.2);
  EXPECT_EQ(model.kinetic_friction, 0.1);
  EXPECT_EQ(model.point, Vector3d(0, 0, -0.005));
  EXPECT_LE((model.normal - Vector3d(0, 0.6, 0.8)).norm(), 1e-15);
  EXPECT_EQ(model.validity, 20);
  EXPECT_EQ(model.mass, 0.5);
  EXPECT_EQ(model.restitution, 0.5);
}

TEST(EntitySection, ForceModelsDefaultToThatOfAHand) {
  const EntityConfig entity = entity_of("force_model = { kind = \"region\" }\n");
  ASSERT_TRUE(entity.model);
  deadreckon::ForceModel hand = to_force_model(HandModel{});
  EXPECT_EQ(entity.model->kind, pdu::ForceModelKind::spring_damper_region);
  EXPECT_EQ(entity.model->radius, hand.radius);
  EXPECT_EQ(entity.model->k1, hand.k1);
  EXPECT_EQ(entity.model->damping, hand.damping);
  EXPECT_EQ(entity.model->static_friction, hand.static_friction);
  EXPECT_EQ(entity.model->validity, hand.validity);
  EXPECT_EQ(entity.model->normal, Vector3d(0, 0, -1)) << "body up";
  EXPECT_FALSE(entity_of("").model);
}

TEST(EntitySection, TakesForceIdsByWordAndByNumber) {
  EXPECT_EQ(entity_of("").force_id, pdu::ForceId::other);
  EXPECT_EQ(entity_of("force_id = \"neutral\"\n").force_id, pdu::ForceId::neutral);
  EXPECT_EQ(static_cast<int>(entity_of("force_id = 30\n").force_id), 30);
  EXPECT_EQ(refusal("[[entity]]\nforce_id = 256\n"),
            "x.toml:2:12: 'force_id' is 256; it must be 0 to 255");
  EXPECT_THAT(refusal("[[entity]]\nforce_id = \"neutrla\"\n"),
              HasSubstr("did you mean \"neutral\"?"));
}

TEST(EntitySection, TurnsFromNorthAsDisMeansIt) {
  struct Case {
    const char* keys;
    Vector3d forward, right;
  };
  for (const auto& [keys, forward, right] :
       {Case{"", {0, 1, 0}, {1, 0, 0}}, Case{"heading = \"90 deg\"\n", {1, 0, 0}, {0, -1, 0}},
        Case{"pitch = \"90 deg\"\n", {0, 0, 1}, {1, 0, 0}},
        Case{"roll = \"90 deg\"\n", {0, 1, 0}, {0, 0, -1}},
        Case{"heading = \"-90 deg\"\nroll = \"180 deg\"\n", {-1, 0, 0}, {0, -1, 0}}}) {
    const EntityConfig entity = entity_of(keys);
    EXPECT_LE((entity.orientation * Vector3d::UnitX() - forward).norm(), 1e-15) << keys;
    EXPECT_LE((entity.orientation * Vector3d::UnitY() - right).norm(), 1e-15) << keys;
    const Vector3d down = entity.orientation * Vector3d::UnitZ();
    EXPECT_LE((down - forward.cross(right)).norm(), 1e-15) << keys;
  }
}

// Reference: Euler angles of the standard in the north, east and down axes of the place.
TEST(EntitySection, TurnsAsTheAnglesOfTheWire) {
  const SceneFile scene = parse_scene_file(
      "[scene]\norigin = { latitude = \"47 deg\", longitude = \"8 deg\" }\n"
      "[[entity]]\nheading = \"30 deg\"\npitch = \"-20 deg\"\nroll = \"10 deg\"\n",
      "x.toml");
  const deadreckon::LocalFrame frame(scene.origin.latitude, scene.origin.longitude, 0);
  Eigen::Matrix3d R_WN;  // north, east, down
  R_WN << frame.rotation().col(1), frame.rotation().col(0), -frame.rotation().col(2);
  const Eigen::Quaterniond body_to_ned =
      deadreckon::quaternion_from_euler({30 * kDegree, -20 * kDegree, 10 * kDegree});
  const Eigen::Quaterniond truth = Eigen::Quaterniond(R_WN) * body_to_ned;
  EXPECT_LE(deadreckon::angle_between(frame.world_from_scene(scene.entities[0].orientation), truth),
            1e-12);
}

TEST(EntitySection, ConvertsGeodeticPlacesByTheScenesOrigin) {
  const std::string place =
      "place = { latitude = \"47.001 deg\", longitude = \"8 deg\", height = 10 }\n";
  const EntityConfig entity = entity_of(
      place, "[scene]\norigin = { latitude = \"47 deg\", longitude = \"8 deg\", height = 10 }\n");
  // A thousandth of a degree of the meridian at 47 degrees: 111.17 m, 1 mm below the tangent.
  EXPECT_NEAR(entity.position.y(), 111.17, 0.02);
  EXPECT_NEAR(entity.position.x(), 0, 1e-6);
  EXPECT_NEAR(entity.position.z(), -0.00097, 1e-4);
  EXPECT_EQ(refusal("[[entity]]\nposition = [0, 0, 0]\n" + place),
            "x.toml:3:9: the position is given twice, by position and place: keep one");
  EXPECT_THAT(refusal("[[entity]]\n" + place),
              HasSubstr("x.toml:2:9: 'place' is 51"));  // 5115 km from latitude and longitude 0
  EXPECT_THAT(refusal("[[entity]]\nplace = { latitude = 0 }\n"),
              HasSubstr("[entity.place] needs 'longitude'"));
}

TEST(EntitySection, TakesTheStandardsThresholdsUnlessHandsFeelIt) {
  const std::string scene =
      "[dead_reckoning]\nposition = \"2 mm\"\nangle = \"1 deg\"\nforce = \"0.2 N\"\n"
      "algorithm = \"fpw\"\nheartbeat = \"4 s\"\nforce_share = 0.1\n";
  const auto plain = entity_of("type = \"1.1\"\n", scene).dead_reckoning;
  EXPECT_EQ(plain.thresholds.position, 1.0);
  EXPECT_NEAR(plain.thresholds.angle, 3 * kDegree, 1e-15);
  EXPECT_EQ(plain.thresholds.force, 0.2);
  EXPECT_EQ(plain.thresholds.weber, 0.1);
  EXPECT_EQ(plain.algorithm, pdu::DeadReckoningAlgorithm::fpw);
  EXPECT_EQ(plain.heartbeat, seconds(60)) << "it stands";

  const auto felt = entity_of("force_model = { kind = \"sphere\" }\n", scene).dead_reckoning;
  EXPECT_EQ(felt.thresholds.position, 0.002);
  EXPECT_NEAR(felt.thresholds.angle, kDegree, 1e-15);
  EXPECT_EQ(felt.heartbeat, seconds(4));

  const auto own = entity_of(
      "dead_reckoning = { position = \"3 m\", algorithm = \"rvw\", heartbeat = \"7 s\" }\n", scene);
  EXPECT_EQ(own.dead_reckoning.thresholds.position, 3.0);
  EXPECT_NEAR(own.dead_reckoning.thresholds.angle, 3 * kDegree, 1e-15);
  EXPECT_EQ(own.dead_reckoning.algorithm, pdu::DeadReckoningAlgorithm::rvw);
  EXPECT_EQ(own.dead_reckoning.heartbeat, seconds(7));
}

TEST(EntitySection, InheritsTheSceneRuleUnlessItHasOne) {
  const std::string scene = "[dead_reckoning]\nrule = \"velocity_aware\"\nspeed_allowance = 0.2\n";
  const auto inherited = entity_of("", scene).dead_reckoning;
  EXPECT_EQ(inherited.rule->name, deadreckon::VelocityAware::kName);
  EXPECT_EQ(inherited.thresholds.of<deadreckon::VelocityAware>().speed_allowance, 0.2);
  const auto own = entity_of("dead_reckoning = { rule = \"per_axis\" }\n", scene).dead_reckoning;
  EXPECT_EQ(own.rule->name, deadreckon::PerAxis::kName);
  EXPECT_EQ(own.thresholds.of<deadreckon::VelocityAware>().speed_allowance, 0);
  EXPECT_THAT(refusal("[[entity]]\ndead_reckoning = { rule = \"velocity_aware\" }\n"),
              HasSubstr("rule 'velocity_aware' needs 'speed_allowance' above 0"));
  EXPECT_THAT(refusal("[[entity]]\ndead_reckoning = { acceleration = \"inertial\" }\n"),
              HasSubstr("unknown key 'acceleration'"))
      << "all peers share one reading";
}

class EntityTracks : public testing::Test {
 protected:
  std::string write(const std::string& name, const std::string& text) const {
    std::ofstream(folder_.file(name)) << text;
    return name;
  }
  [[nodiscard]] std::filesystem::path folder() const { return folder_.file("."); }
  [[nodiscard]] EntityConfig entity_of(const std::string& lines) const {
    return parse_scene_file("[[entity]]\n" + lines, "x.toml", folder()).entities.at(0);
  }

  test::ScratchFolder folder_;
};

TEST_F(EntityTracks, AreFoundBesideTheSceneFile) {
  write("t.csv", "t_s,px_m,py_m,pz_m\n0,0,0,0\n1,5,0,0\n2,9,0,0\n");
  const EntityConfig entity =
      entity_of("type = \"1.1\"\ntrack = \"t.csv\"\nspeed = 2\nrepeat = true\n");
  EXPECT_EQ(entity.track.filename(), "t.csv");
  EXPECT_TRUE(entity.track.is_absolute());
  EXPECT_EQ(entity.speed, 2);
  EXPECT_EQ(entity.repeat, true);
  EXPECT_TRUE(entity.turns);
  EXPECT_EQ(entity.dead_reckoning.heartbeat, seconds(55)) << "a land platform that moves";
  EXPECT_EQ(entity_of("track = \"t.csv\"\n").repeat, std::nullopt);
  EXPECT_FALSE(entity_of("track = \"t.csv\"\nheading = 0\n").turns);
}

TEST_F(EntityTracks, AreRefusedWithTheirPlaceInBothFiles) {
  write("bad.csv", "t_s,px_m,py_m,pz_m\n0,0,0,0\n0,5,0,0\n");
  EXPECT_THAT(refusal("[[entity]]\ntrack = \"bad.csv\"\n", folder()),
              testing::AllOf(HasSubstr("x.toml:2:9: 'track': "),
                             HasSubstr("bad.csv:3:1: t_s does not increase")));
  EXPECT_THAT(refusal("[[entity]]\ntrack = \"none.csv\"\n", folder()),
              HasSubstr("x.toml:2:9: 'track': cannot read "));
}

TEST(EntitySection, RefusesInconsistentKeys) {
  const std::pair<std::string, const char*> cases[] = {
      {"marking = \"TWELVE CHARS\"\n", "x.toml:2:11: 'marking' has 12 characters; use at most 11"},
      {"marking = \"MÜHLE\"\n",
       "x.toml:2:11: 'marking' has a character that is not printable ASCII"},
      {"marking = \"A\\tB\"\n", "not printable ASCII"},
      {"peer = 0\n", "x.toml:2:8: 'peer' is 0; it must be 1 to 64"},
      {"peer = 65\n", "it must be 1 to 64"},
      {"type = \"Platform Lnad\"\n",
       "x.toml:2:8: 'type' is \"Platform Lnad\": 'Lnad' is no domain"},
      {"type = 1\n", "x.toml:2:8: 'type' is a number; it needs text"},
      {"type = \"\"\n", "it is empty"},
      {"speed = 2\n", "x.toml:2:9: 'speed' needs a track"},
      {"repeat = false\n", "'repeat' needs a track"},
      {"power = 1\n", "'power' needs a force_model"},
      {"force_model = { radius = 1 }\n", "[entity.force_model] needs 'kind'"},
      {"force_model = { kind = \"spere\" }\n", "did you mean \"sphere\"?"},
      {"force_model = { kind = \"sphere\", radius = 0 }\n", "'radius' is 0 m; it must be"},
      {"force_model = { kind = \"plane\", normal = [0, 0, 0] }\n", "x.toml:2:42: 'normal' has no"},
      {"force_model = { kind = \"plane\", normal = [nan, 0, 1] }\n", "it must be"},
      {"force_model = { kind = \"sphere\", static_friction = 0.1, kinetic_friction = 0.2 }\n",
       "'kinetic_friction' (0.2) is above 'static_friction' (0.1): lower it"},
      {"force_model = { kind = \"sphere\" }\ndead_reckoning = { heartbeat = \"20 s\" }\n",
       "its force fades out 12 s after an update, and the heartbeat is 22 s: raise 'validity'"},
      {"force_model = 3\n", "it needs table"},
  };
  for (const auto& [lines, words] : cases) {
    EXPECT_THAT(refusal("[[entity]]\n" + lines), HasSubstr(words)) << lines;
  }
}

TEST(EntitySection, MayUseAMarkingTwice) {
  EXPECT_EQ(refusal("[[entity]]\nmarking = \"A\"\n[[entity]]\nmarking = \"A\"\n"), "");
}

TEST(SceneHash, IsIndependentOfEntitiesAndDevices) {
  const std::string world = "[[object]]\nname = \"a\"\nsphere = 1\n[[operator]]\npassive = true\n";
  const auto plain = parse_scene_file(world, "x.toml").hash;
  EXPECT_EQ(parse_scene_file(world + "[[entity]]\nforce_model = { kind = \"sphere\" }\n"
                                     "[[device]]\ndamping = 2\n",
                             "x.toml")
                .hash,
            plain);
}

}  // namespace
}  // namespace reckon::peer
