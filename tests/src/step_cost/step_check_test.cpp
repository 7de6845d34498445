// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Scenes that a host cannot run: a federate reports and refuses them.
#include "reckon/peer/step_cost/step_check.hpp"

#include <gmock/gmock.h>

#include <fstream>

#include "reckon/haptics/devices/simulated_device.hpp"
#include "reckon/peer/clocks/clock.hpp"
#include "reckon/peer/joined_peer.hpp"
#include "reckon/peer/scene/scene_file.hpp"
#include "reckon/tests/src/support/manual_link.hpp"
#include "reckon/tests/src/support/udp_on_loopback.hpp"
#include "reckon/tests/support/scratch_folder.hpp"
#include "reckon/tests/support/touch_meshes.hpp"

namespace reckon::peer {
namespace {

using namespace std::chrono_literals;
using testing::HasSubstr;

TEST(StepTooDear, NamesTheThreeDearestStagesOfTheObject) {
  const std::vector<haptics::PlanStage> stages = {
      {"contact", "stone", "", ""}, {"spring_damper", "stone", "", ""},
      {"texture", "stone", "", ""}, {"relief", "stone", "", ""},
      {"skin", "stone", "", ""},    {"contact", "ball", "", ""}};
  const std::vector<double> costs = {2e-3, -1.0, 1e-4, 3e-4, 2e-5, 9e-3};
  EXPECT_EQ(too_dear_sentence({2.45e-3, "stone"}, 1ms, stages, costs),
            "a servo step that touches stone takes 2.4 ms on this host, and its period is 1 ms "
            "(costliest: contact 2 ms, relief 0.3 ms, texture 0.1 ms)");
}

class SlowScene : public testing::Test {
 protected:
  SlowScene() {
    std::ofstream(folder_.file("corner.obj")) << "v 0 0 0\nv 0.1 0 0\nv 0 0.1 0\nv 0 0 0.1\n"
                                                 "f 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n";
  }
  [[nodiscard]] SceneFile scene(const std::string& shape) const {
    return parse_scene_file("[[object]]\nname = \"corner\"\n" + shape, "x.toml",
                            std::filesystem::path(folder_.file("")));
  }
  [[nodiscard]] SceneFile mesh() const { return scene("mesh = \"corner.obj\"\n"); }

  test::ScratchFolder folder_;
};

TEST_F(SlowScene, IsFoundByMeshesButNotByPrimitives) {
  const SceneFile dear = mesh(), cheap = scene("sphere = \"5 cm\"\n");
  const haptics::EffectPlan dear_plan(dear.scene), cheap_plan(cheap.scene);
  const auto found = find_step_too_dear(dear.scene, dear_plan, 0.005, 1ns);
  ASSERT_TRUE(found);
  EXPECT_GT(found->step(), 1e-9);
  EXPECT_EQ(found->period(), 1ns);
  EXPECT_THAT(found->finding(), HasSubstr("a servo step that touches corner takes "));
  EXPECT_THAT(found->finding(), HasSubstr("(costliest: contact "));
  EXPECT_THAT(found->what(), HasSubstr("or set FederateOptions::even_if_slow"));
  EXPECT_FALSE(find_step_too_dear(cheap.scene, cheap_plan, 0.005, 1ns));
  EXPECT_FALSE(find_step_too_dear(dear.scene, dear_plan, 0.005, 1h));
  const StageCosts costs = measure_stages(dear.scene, dear_plan, 0.005);
  ASSERT_EQ(costs.stages.size(), dear_plan.stages().size());
  EXPECT_EQ(costs.dearest_object, "corner");
}

TEST_F(SlowScene, IsRefusedOnALanUnlessForced) {
  haptics::SimulatedDevice hand({}, [](double) { return haptics::HandTarget(); });
  FederateOptions options;
  test::write_obj(test::sliver_cone(100'000), folder_.file("corner.obj"));
  options.scene = mesh();
  options.scene->hand.contact_radius = 0.02;
  options.scene->network.group = test::group(61);
  options.interface = "lo";
  options.loops = FederateLoops::threads;
  options.devices.emplace_back().device = &hand;
  options.devices[0].period = 100us;  // the shortest possible
  EXPECT_THROW(JoinedPeer{options}, StepTooDear);
  options.even_if_slow = true;
  JoinedPeer joined(options);
  ASSERT_NE(joined.peer().notices().front(), nullptr);
  EXPECT_THAT(joined.peer().notices().front()->text.data(),
              HasSubstr("a servo step that touches corner takes"));

  // Simulated time may take any wall time.
  options.even_if_slow = false;
  ManualClock clock(1s, 1h);
  test::ManualLink link;
  JoinedPeer simulated(options, link, clock, 1);
  EXPECT_EQ(simulated.peer().notices().front(), nullptr);
  // Without devices there is no servo.
  options.devices.clear();
  EXPECT_NO_THROW(JoinedPeer{options});
}

constexpr const char* kTwoCubes = R"(
[[object]]
name = "floor"
plane = [0, 0, 1]
[[object]]
name = "low"
box = "40 40 40 mm"
position = "0 0 20 mm"
mass = "50 g"
[[object]]
name = "high"
box = "40 40 40 mm"
position = "0 0 60.5 mm"
mass = "50 g"
[[operator]]
passive = true
[[device]]
peer = 1
operator = 1
)";

TEST(BodyCosts, AreOfMovingBodiesWithHandsAmongThem) {
  const SceneFile scene = parse_scene_file(kTwoCubes, "x.toml", {});
  const auto costs = measure_bodies(scene, 2, 1ms, {1, 10.0});
  ASSERT_TRUE(costs);
  EXPECT_EQ(costs->bodies, 2u);
  EXPECT_EQ(costs->steps, 700u);
  EXPECT_GT(costs->p99_until_force, 0.0);
  EXPECT_GE(costs->p99, costs->p99_until_force);
  EXPECT_GE(costs->p99, costs->median);
  EXPECT_FALSE(measure_bodies(parse_scene_file("", "x.toml", {}), 1, 1ms));
}

TEST(BodyCosts, NameTheStepThatIsTooDear) {
  EXPECT_FALSE(find_bodies_too_dear(parse_scene_file("", "x.toml", {}), 1, 100us, 1.0));
  EXPECT_EQ(bodies_too_dear_sentence({64, 4e-4, 1.34e-3, 3e-4, 700, 85}, 1ms),
            "the servo steps of one period among 64 moving bodies take 1.3 ms at p99 on this host, "
            "and the period is 1 ms (85 of 700 periods are late; costliest: bodies)");
}

TEST(BodyCosts, GiveThePaceOfThisHost) {
  const double pace = measure_body_pace();
  EXPECT_GT(pace, 0.05);
  EXPECT_LT(pace, 50.0);
}

}  // namespace
}  // namespace reckon::peer
