// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/peer/scene/scene_file.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <fstream>
#include <numbers>
#include <random>
#include <string>

#include "reckon/tests/src/support/refusal.hpp"

namespace reckon::peer::scene_file_test {
namespace {

using std::chrono::milliseconds;
using test::refusal;
using testing::HasSubstr;

constexpr const char* kTwoHands = R"(
[scene]
name = "two hands"
origin = { latitude = "47.05 deg", longitude = "8.31 deg", height = "430 m" }

[[object]]
name = "ball"
sphere = "50 mm"
position = "0 0 10 cm"
orientation = ["0 deg", 0, "90 deg"]
surface = { stiffness = "900 N/m", damping = "1.5 N s/m" }
friction = { static = 0.6, kinetic = "40 %" }

[[object]]
name = "floor"
plane = [0, 0, 1]

[hand]
radius = "15 mm"
k1 = "700 N/m"
validity = "20 s"

[[operator]]
passive = true
position = [0.1, 0, "20 mm"]

[[operator]]
sweep = { from = "0 0 10 mm", to = "0 0 -5 mm", period = "500 ms" }
start = "1 s"

[dead_reckoning]
algorithm = "fpw"
position = "0.5 mm"
heartbeat = "4 s"

[aoim]
scheme = "square"
cell = "10 m"
radius = "25 m"
pool = 16

[network]
group = "239.192.7.0"
port = 4000
interop = true
bundle = { max = "1200 B", hold = "2 ms" }

[impairment]
delay = "20 ms"
loss = "5 %"
seed = 7
outage = [{ start = "1 s", duration = "200 ms" }]
)";

std::uint64_t hash_of(const std::string& text) { return parse_scene_file(text, "x.toml").hash; }

/// A folder of its own for each test; it is removed at the end.
class SceneFolder : public testing::Test {
 protected:
  SceneFolder()
      : folder_(std::filesystem::temp_directory_path() /
                fmt::format("reckon_scene_{}_{}", getpid(),
                            testing::UnitTest::GetInstance()->current_test_info()->name())) {
    std::filesystem::create_directories(folder_);
  }
  ~SceneFolder() override { std::filesystem::remove_all(folder_); }

  std::filesystem::path write(const std::string& name, const std::string& text) const {
    std::ofstream(folder_ / name) << text;
    return folder_ / name;
  }

  std::filesystem::path folder_;
};

TEST(SceneFile, GivesEveryValueInSi) {
  const SceneFile file = parse_scene_file(kTwoHands, "two_hands.toml");
  EXPECT_EQ(file.name, "two hands");
  EXPECT_DOUBLE_EQ(file.origin.latitude, 47.05 * std::numbers::pi / 180);
  EXPECT_EQ(file.origin.height, 430);

  ASSERT_EQ(file.scene.objects.size(), 2U);
  const haptics::SceneObject& ball = file.scene.objects[0];
  EXPECT_EQ(std::get<haptics::SphereShape>(ball.shape).radius, 0.05);
  EXPECT_EQ(ball.pose.position, Eigen::Vector3d(0, 0, 0.1));
  const Eigen::Vector3d turned = ball.pose.orientation * Eigen::Vector3d::UnitX();
  EXPECT_NEAR((turned - Eigen::Vector3d::UnitY()).norm(), 0, 1e-15);
  const haptics::Surface& surface = ball.effects.of<haptics::SpringDamper>();
  EXPECT_EQ(surface.stiffness, 900);
  EXPECT_EQ(surface.damping, 1.5);
  const auto& friction = ball.effects.of<haptics::StickSlipFriction>();
  ASSERT_TRUE(friction);
  EXPECT_EQ(friction->static_coefficient, 0.6);
  EXPECT_EQ(friction->kinetic_coefficient, 0.4);
  EXPECT_FALSE(file.scene.objects[1].effects.of<haptics::StickSlipFriction>());

  EXPECT_EQ(file.hand.radius, 0.015);
  EXPECT_EQ(file.hand.validity, std::chrono::seconds(20));
  ASSERT_EQ(file.operators.size(), 2U);
  EXPECT_EQ(file.operators[0].kind, OperatorKind::passive);
  EXPECT_EQ(file.operators[0].position, Eigen::Vector3d(0.1, 0, 0.02));
  EXPECT_EQ(file.operators[1].kind, OperatorKind::sweep);
  EXPECT_EQ(file.operators[1].to, Eigen::Vector3d(0, 0, -0.005));
  EXPECT_EQ(file.operators[1].period, milliseconds(500));
  EXPECT_EQ(file.operators[1].start, std::chrono::seconds(1));

  EXPECT_EQ(file.dead_reckoning.algorithm, pdu::DeadReckoningAlgorithm::fpw);
  EXPECT_EQ(file.dead_reckoning.thresholds.position, 0.0005);
  EXPECT_EQ(file.dead_reckoning.heartbeat, std::chrono::seconds(4));
  EXPECT_EQ(file.aoim.scheme, aoim::CellScheme::square);
  EXPECT_EQ(file.aoim.cell, 10);
  EXPECT_EQ(file.aoim.pool, 16U);
  EXPECT_EQ(file.network.group.text(), "239.192.7.0:4000");
  EXPECT_TRUE(file.network.interop);
  EXPECT_EQ(file.network.bundle_max, 1200U);
  EXPECT_EQ(file.network.bundle.hold, milliseconds(2));
  EXPECT_EQ(file.impairment.law.delay, milliseconds(20));
  EXPECT_EQ(file.impairment.law.loss, 0.05);
  EXPECT_EQ(file.impairment.seed, 7U);
  ASSERT_EQ(file.impairment.law.outages.size(), 1U);
  EXPECT_EQ(file.impairment.law.outages[0].duration, milliseconds(200));
}

TEST(SceneFile, EmptyFileIsAnEmptyWorldWithDefaults) {
  const SceneFile file = parse_scene_file("", "empty.toml");
  EXPECT_EQ(file.name, "empty");
  EXPECT_TRUE(file.scene.objects.empty());
  EXPECT_TRUE(file.operators.empty());
  EXPECT_EQ(file.network.group.text(), "239.192.1.0:3000");
  EXPECT_TRUE(file.impairment.law.is_perfect());
}

TEST(SceneFile, NamesPeersWhereThereIsNoMulticast) {
  const SceneFile file = parse_scene_file(
      "[network]\npeers = [\"10.0.0.7\", \" host-b:3001\", \"[2001:db8::8]:3002\"]\n", "x.toml");
  EXPECT_THAT(file.network.peers,
              testing::ElementsAre(NamedPeer{"10.0.0.7", 0}, NamedPeer{"host-b", 3001},
                                   NamedPeer{"2001:db8::8", 3002}));
  EXPECT_EQ(file.hash, parse_scene_file("", "x.toml").hash) << "how a peer speaks, not the world";
  const SceneFile subnet =
      parse_scene_file("[network]\ninterop = true\ngroup = \"10.9.9.255\"\n", "x.toml");
  EXPECT_EQ(subnet.network.group.text(), "10.9.9.255:3000");
  std::string many = "[network]\npeers = [";
  for (int i = 0; i < 257; ++i) many += "\"10.0.0.2\", ";
  EXPECT_THAT(refusal(many + "]\n"), HasSubstr("x.toml:2:9: 'peers': '10.0.0.2' is one of more"));
}

TEST(SceneFile, RefusesUnknownKeysWithPlaceAndNearestKey) {
  const std::string text = "[[object]]\nname = \"a\"\nsphere = 0.1\nsurface = { stifness = 800 }\n";
  EXPECT_EQ(refusal(text), "x.toml:4:13: unknown key 'stifness' (did you mean 'stiffness'?)");
}

TEST(SceneFile, ListsASectionsKeysWhenNoneIsNear) {
  EXPECT_THAT(refusal("[aoim]\nzzzzzz = 1\n"),
              testing::AllOf(HasSubstr("x.toml:2:1: unknown key 'zzzzzz'"),
                             HasSubstr("[aoim] takes"), HasSubstr("radius")));
  EXPECT_THAT(refusal("[netwrok]\nport = 3\n"), HasSubstr("did you mean 'network'?"));
}

TEST(SceneFile, ReportsAllProblemsInFileOrder) {
  const std::string text =
      "[hand]\nk1 = \"5 m\"\nradius = true\n[network]\nport = 70000\nttl = 1.5\n";
  const std::string told = refusal(text);
  EXPECT_EQ(std::ranges::count(told, '\n'), 3) << told;
  EXPECT_THAT(told, HasSubstr("x.toml:2:6: 'k1': unit 'm' does not fit here: write one of N/m"));
  EXPECT_THAT(told, HasSubstr("x.toml:3:10: 'radius' is true or false; it needs number [m]"));
  EXPECT_THAT(told, HasSubstr("x.toml:5:8: 'port' is 70000; it must be 1 to 65535"));
  EXPECT_THAT(told, HasSubstr("x.toml:6:7: 'ttl' is a number; it needs whole number"));
  EXPECT_LT(told.find("k1"), told.find("radius"));
}

TEST(SceneFile, RefusesInconsistentKeys) {
  const auto object = [](const std::string& lines) { return "[[object]]\nname = \"a\"\n" + lines; };
  const auto region = [](const std::string& lines) { return "[[region]]\nname = \"a\"\n" + lines; };
  const std::pair<std::string, const char*> cases[] = {
      {"[scene\n", "x.toml:1:7"},
      {"[hand]\nradius = nan\n", "must be"},
      {"[hand]\nradius = \"-1 mm\"\n", "must be"},
      {"[hand]\nkinetic_friction = 0.9\n", "above 'static_friction'"},
      {"[[object]]\nsphere = 1\n", "[[object]] needs 'name'"},
      {object(""), "the shape is missing"},
      {object("sphere = 1\nbox = [1, 1, 1]\n"), "the shape is given twice"},
      {object("box = [1, 0, 1]\n"), "not above 0 m"},
      {object("box = [1, 1]\n"), "it needs three numbers"},
      {object("box = \"1 1 m\"\n"), "'box' is a text; it needs three numbers [m]"},
      {object("plane = [0, 0, 0]\n"), "no direction"},
      {object("sphere = 1\nscale_to = 1\n"), "'scale_to' needs a mesh"},
      {object("mesh = \"no_such.obj\"\n"), "cannot read"},
      {object("mesh = \"/dev/null\"\n"), "cannot read"},
      {object("mesh = \"\"\n"), "is empty"},
      {object("sphere = 1\nfriction = { static = 0.1, kinetic = 0.2 }\n"),
       "x.toml:4:12: friction: kinetic"},
      {object("sphere = 1\n") + object("sphere = 2\n"), "another object 'a'"},
      {"object = 3\n", "it needs tables"},
      {region(""), "this region has no effect: give it one of viscosity, "},
      {region("border = {}\n"), "no border"},
      {region("sphere = 1\nbox = [1, 1, 1]\nborder = {}\n"), "the shape is given twice"},
      {region("magnet = {range = \"2 m\"}\n"), "'range' is "},
      {region("spring = {}\n") + region("spring = {}\n"), "another region 'a'"},
      {"[[operator]]\n", "what moves the hand is missing"},
      {"[[operator]]\npassive = false\n", "write true"},
      {"[[operator]]\ntrace = \"nobody.csv\"\n", "cannot read"},
      {"[dead_reckoning]\nalgorithm = \"drm4\"\n", "one of auto static fpw"},
      {"[dead_reckoning]\nposition = 0\n", "it must be"},
      {"[network]\ngroup = \"10.0.0.1\"\n", "multicast address"},
      {"[network]\ngroup = \"255.255.255.255\"\n", "set 'interop'"},
      {"[network]\ngroup = \"10.9.9.255\"\n", "set 'interop'"},
      {"[network]\ninterop = true\ngroup = \"10.9.9.8\"\n", "the subnet's broadcast address"},
      {"[network]\nlenient = true\n",
       "x.toml:2:11: 'lenient' is only for plain DIS: set 'interop'"},
      {"[network]\ninterop = true\nlenient = true\nkey = \"k\"\n",
       "a sealed exercise cannot be 'lenient'"},
      {"[network]\ngroup = \"239.1.2.3:4000\"\n", "write it as 'port'"},
      {"[network]\ngroup = \"239.255.255.250\"\n", "x.toml: "},
      {"[network]\npeers = \"10.0.0.2\"\n", "it needs texts, any number"},
      {"[network]\npeers = [\"10.0.0.2\", 3]\n", "it needs texts, any number"},
      {"[network]\npeers = [\"10.0.0.2\",\n \"a:0\"]\n",
       "x.toml:3:2: 'peers': 'a:0' has a port outside 1 to 65535"},
      {"[network]\npeers = [\"\"]\n", "has no host"},
      {"[impairment]\nloss = 1.5\n", "it must be 0 to 1"},
      {"[impairment]\noutage = 3\n", "it needs tables"},
  };
  for (const auto& [text, words] : cases) EXPECT_THAT(refusal(text), HasSubstr(words)) << text;
}

TEST_F(SceneFolder, FindsFilesBesideTheSceneFile) {
  write("cube.obj", "v 0 0 0\n");
  write("hand.csv", "t_s,px_m,py_m,pz_m\n0,0,0,0\n");
  const auto path = write("s.toml",
                          "[[object]]\nname = \"cube\"\nmesh = \"cube.obj\"\nscale_to = \"10 cm\"\n"
                          "[[operator]]\ntrace = \"hand.csv\"\nspeed = 2\n");
  const SceneFile file = load_scene_file(path);
  EXPECT_EQ(file.name, "s");
  EXPECT_EQ(file.path, path);
  const auto& mesh = std::get<haptics::MeshShape>(file.scene.objects.at(0).shape);
  EXPECT_EQ(mesh.file, folder_ / "cube.obj");
  EXPECT_DOUBLE_EQ(mesh.scale_to, 0.1);
  EXPECT_EQ(file.operators.at(0).trace, folder_ / "hand.csv");
  EXPECT_EQ(file.operators.at(0).speed, 2);
}

TEST_F(SceneFolder, ReadsPicturesAndHashesTheirContent) {
  const std::string picture = "P5 4 4 255\n0123456789abcdef";
  write("land.pgm", picture);
  const auto scene = [&](const std::string& heights, const std::string& more = "") {
    return load_scene_file(write(
        "s.toml",
        "[[object]]\nname = \"land\"\nheights = { file = \"land.pgm\"" + heights + " }\n" + more));
  };
  const SceneFile file =
      scene(", width = \"8 cm\", height = \"2 cm\"", "patch = [{ name = \"top\" }]\n");
  const auto& shape = std::get<haptics::HeightsShape>(file.scene.objects.at(0).shape);
  EXPECT_EQ(shape.file, folder_ / "land.pgm");
  EXPECT_DOUBLE_EQ(shape.width, 0.08);
  EXPECT_DOUBLE_EQ(shape.height, 0.02);
  EXPECT_EQ(shape.length, 0.0);
  const std::uint64_t hash = scene("").hash;
  EXPECT_EQ(scene(", width = 0.1, base = \"1 cm\"").hash, hash);
  for (const char* other : {", width = 0.2", ", length = 0.1", ", height = 0.02", ", base = 0.02"})
    EXPECT_NE(scene(other).hash, hash) << other;
  write("land.pgm", picture.substr(0, picture.size() - 1) + "g");
  EXPECT_NE(scene("").hash, hash);

  const auto refused = [&](const std::string& heights,
                           const std::string& more = "") -> std::string {
    try {
      static_cast<void>(scene(heights, more));
      return "taken";
    } catch (const SceneFileError& error) {
      return error.what();
    }
  };
  EXPECT_THAT(refused(", width = 0"), HasSubstr("'width' is 0 m"));
  EXPECT_THAT(refused("", "sphere = 1\n"), HasSubstr("the shape is given twice"));
  EXPECT_THAT(refused("", "scale_to = 1\n"), HasSubstr("'scale_to' needs a mesh"));
  write("land.pgm", picture.substr(0, picture.size() - 1));
  EXPECT_THAT(refused(""), HasSubstr("s.toml:3:20: "));
  EXPECT_THAT(refused(""), HasSubstr("land.pgm: ends early: its pixels need 16 octets"));
}

TEST_F(SceneFolder, NamesAMissingFile) {
  try {
    (void)load_scene_file(folder_ / "none.toml");
    FAIL();
  } catch (const SceneFileError& error) {
    EXPECT_EQ(std::string(error.what()),
              (folder_ / "none.toml").string() +
                  ": there is no such file; name a scene file, for example scenes/two_hands.toml");
  }
  EXPECT_THROW((void)load_scene_file(folder_), SceneFileError);
}

TEST_F(SceneFolder, HashFollowsTheContentOfMeshes) {
  write("cube.obj", "v 0 0 0\n");
  const auto path = write("s.toml", "[[object]]\nname = \"cube\"\nmesh = \"cube.obj\"\n");
  const auto before = load_scene_file(path).hash;
  EXPECT_EQ(load_scene_file(path).hash, before);
  write("cube.obj", "v 0 0 1\n");
  EXPECT_NE(load_scene_file(path).hash, before);
}

TEST(SceneHash, IgnoresSpellingOrderAndPeersOwnKeys) {
  const std::string plain =
      "[scene]\norigin = { latitude = \"47.05 deg\", height = 430 }\n"
      "[[object]]\nname = \"a\"\nsphere = \"50 mm\"\norientation = \"0 0 180 deg\"\n"
      "surface = { stiffness = 900, damping = 1 }\n";
  const std::string told_otherwise =
      "# a remark\n[[object]]\norientation = [0, 0, 3.141592653589793]\nsphere = \"5 cm\"\n"
      "surface = { damping = \"1 N s/m\", stiffness = \"0.9 kN/m\" }\nname = \"a\"\n"
      "[scene]\norigin = { height = \"0.43 km\", latitude = 0.821177413063332 }\nname = \"other\"\n"
      "[hand]\nradius = 0.1\n[network]\niface = \"lo\"\n[impairment]\nloss = 0.5\n"
      "[dead_reckoning]\nposition = 1\n[[operator]]\npassive = true\n[aoim]\nradius = 7\n";
  EXPECT_EQ(hash_of(plain), hash_of(told_otherwise));
}

TEST(SceneHash, ChangesWithEachThingThatPeersMustShare) {
  const std::string object = "[[object]]\nname = \"a\"\nsphere = \"50 mm\"\n";
  const auto base = hash_of(object);
  for (const std::string& text :
       {std::string(), object + "position = [0, 0, 1e-6]\n",
        object + "orientation = \"0 0 1 deg\"\n", object + "surface = { stiffness = 801 }\n",
        object + "friction = {}\n", object + "texture = {}\n",
        object + "[[region]]\nname = \"b\"\nspring = {}\n",
        object + "[scene]\norigin = { longitude = \"1 deg\" }\n", object + "[aoim]\ncell = 3\n",
        object + "[aoim]\npool = 4\n", object + "[aoim]\nscheme = \"square\"\n",
        object + "[dead_reckoning]\nacceleration = \"inertial\"\n",
        std::string("[[object]]\nname = \"b\"\nsphere = \"50 mm\"\n"),
        std::string("[[object]]\nname = \"a\"\nbox = [1, 1, 1]\n"),
        std::string("[[object]]\nname = \"a\"\nplane = [1, 0, 0]\n")}) {
    EXPECT_NE(hash_of(text), base) << text;
  }
}

// 2^53 + 1 and the largest integer: toml++ returns no double for them.
TEST(SceneFile, RefusesUnrepresentableWholeNumbersByTheirValue) {
  struct Case {
    const char* number;
    const char* shown;
  };
  for (const auto& [number, shown] : {Case{"9007199254740993", "9.00719925e+12 km"},
                                      Case{"9223372036854775807", "9.22337204e+15 km"},
                                      Case{"-9223372036854775807", "-9.22337204e+15 km"}}) {
    const std::string text = fmt::format("[[object]]\nname = \"a\"\nsphere = {}\n", number);
    EXPECT_THAT(refusal(text), HasSubstr(fmt::format("'sphere' is {};", shown)));
  }
}

TEST(SceneFile, SurvivesAnyCutAndAnyChangedOctet) {
  const std::string text = kTwoHands;
  for (std::size_t length = 0; length < text.size(); length += 3) {
    EXPECT_NO_FATAL_FAILURE((void)refusal(text.substr(0, length)));
  }
  std::mt19937 random(1);
  for (int i = 0; i < 2000; ++i) {
    std::string changed = text;
    changed[random() % changed.size()] = static_cast<char>(random() % 128);
    EXPECT_NO_FATAL_FAILURE((void)refusal(changed));
  }
}

}  // namespace
}  // namespace reckon::peer::scene_file_test
