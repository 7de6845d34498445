// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Contacts with bodies of strangers or silent senders: what a hand feels, and for how long.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "reckon/pdu/entity/attribute.hpp"
#include "reckon/pdu/timestamp.hpp"
#include "reckon/tests/support/in_process.hpp"

namespace reckon::test {
namespace {

using testing::Contains;
using testing::HasSubstr;

// One hand that is held at rest; TOUCH stands for a line of [network].
constexpr std::string_view kHeldHand = R"(
[scene]
name = "one hand"
origin = {latitude = "47.05 deg", longitude = "8.31 deg", height = "430 m"}

[hand]
radius = "10 mm"
k1 = "300 N/m"

[aoim]
pool = 16

[network]
TOUCH

[[operator]]
passive = true
position = [0.0, 0.0, 0.0]
stiffness = "300 N/m"
)";

// Force of all bodies on a peer's hand, in its newest snapshot [N].
double pressure_on(InProcess& world, std::size_t link = 0) {
  const haptics::ServoSnapshot& servo = world.view(link).servo();
  double sum = 0.0;
  for (std::size_t i = 0; i < servo.count; ++i) sum += servo.contacts[i].force.norm();
  return sum;
}

/// A peer on link 0, and a plain DIS program that sends from the link in its argument.
class Guest {
 public:
  static constexpr float kRadius = 0.03F;  // [m]

  explicit Guest(const std::string& touch, std::string_view more = {})
      : scene_(scene_of(with(kHeldHand, "TOUCH", touch) + std::string(more))), world_(3) {
    world_.listen(scene_);
    world_.move_by(0, [this](double) {
      haptics::HandTarget target;
      target.position = hand_at_;
      return target;
    });
    world_.start(0, scene_);
    if (!more.empty()) world_.start(1, scene_);
    world_.run(1500);
    for (const pdu::EntityState& state : world_.heard_pdus<pdu::EntityState>()) state_ = state;
    state_.variable_parameters = {};
    state_.entity_id = {900, 1, 1};
    state_.entity_type = {pdu::EntityKind::platform, pdu::EntityDomain::land};
    state_.dead_reckoning.algorithm = pdu::DeadReckoningAlgorithm::fpw;
    static_cast<void>(world_.notices(0));
  }
  // Sends its ball of 250 N/m at this distance east of the scene's origin [m], with this speed
  // [m/s].
  void say(double east, double speed = 0.0, std::size_t link = 1) {
    say_ball(1, {east, 0, 0}, {speed, 0, 0}, link);
  }
  // Sends one of its balls at a position [m], with a velocity [m/s].
  void say_ball(std::uint16_t number, const Eigen::Vector3d& at, const Eigen::Vector3d& moving,
                std::size_t link) {
    const deadreckon::LocalFrame frame(scene_.origin.latitude, scene_.origin.longitude,
                                       scene_.origin.height);
    const Eigen::Vector3d place = frame.world_from_scene(at);
    const Eigen::Vector3f motion = frame.world_from_scene_vector(moving).cast<float>();
    state_.entity_id.entity = number;
    state_.header.timestamp = pdu::to_dis_timestamp(world_.clock().utc_now(), true);
    state_.location = {place.x(), place.y(), place.z()};
    state_.linear_velocity = {motion.x(), motion.y(), motion.z()};
    std::array<std::byte, 512> records;
    pdu::AttributeWriter writer(records, {});
    pdu::HapticRecord model;
    model.kind = pdu::ForceModelKind::sphere;
    model.radius = kRadius;
    model.k1 = 250.0F;
    model.validity_ms = 12'000;
    model.normal = {0, 0, 1};
    ASSERT_TRUE(writer.begin_set(state_.entity_id) && writer.add(model));
    const std::size_t size = writer.finish();
    std::vector<std::byte> datagram(pdu::wire_size(state_));
    ASSERT_EQ(pdu::encode(state_, datagram), datagram.size());
    datagram.insert(datagram.end(), records.begin(),
                    records.begin() + static_cast<std::ptrdiff_t>(size));
    ASSERT_TRUE(world_.network().link(link).send(scene_.network.group, datagram));
  }
  // Moves the hand, which is at the origin, to the east.
  void press(double east) { hand_at_.x() = east; }
  // Runs `steps` milliseconds; returns how many of them the hand feels something.
  std::size_t run(std::size_t steps) {
    std::size_t pressed = 0;
    for (std::size_t i = 0; i < steps; ++i) {
      world_.run(1);
      if (pressure_on(world_) > 0.05) ++pressed;
    }
    return pressed;
  }
  [[nodiscard]] InProcess& world() { return world_; }
  [[nodiscard]] std::string endpoint(std::size_t link) {
    return world_.network().link(link).local_endpoint().text();
  }

 private:
  peer::SceneFile scene_;
  InProcess world_;
  pdu::EntityState state_;
  Eigen::Vector3d hand_at_ = Eigen::Vector3d::Zero();
};

TEST(OneShot, IsNotFeltByDefault) {
  for (const double speed : {0.0, -0.2}) {
    Guest guest("");
    guest.say(speed == 0.0 ? 0.02 : 0.1, speed);
    EXPECT_EQ(guest.run(3000), 0u);
    EXPECT_EQ(guest.world().count(0, "touch_refused"), 1u);
    EXPECT_THAT(guest.world().notices(0),
                Contains(HasSubstr("900:1:1 at " + guest.endpoint(1) + " is not felt")));
  }
}

TEST(OneShot, InsideAHandIsNotFelt) {
  for (const double away : {0.0, 0.001, 0.02, 0.039}) {
    Guest guest("touch = \"all\"");
    guest.say(away);
    EXPECT_EQ(guest.run(3000), 0u) << away;
    EXPECT_THAT(guest.world().notices(0),
                Contains(HasSubstr("900:1:1 at " + guest.endpoint(1) + " appeared inside a hand")));
  }
}

TEST(OneShot, IsFeltForHalfASecond) {
  for (const double deep : {0.005, 0.02}) {
    Guest guest("touch = \"all\"");
    guest.say(0.06);
    guest.run(100);
    guest.press(0.02 + deep);
    const std::size_t pressed = guest.run(4000);
    EXPECT_GT(pressed, 300u);
    EXPECT_LE(pressed, 550u + static_cast<std::size_t>(kPicture.count()));
    const auto told = guest.world().notices(0);
    EXPECT_THAT(told, Contains(HasSubstr("900:1 at " + guest.endpoint(1) + " presses a hand")));
    EXPECT_THAT(told, Contains(HasSubstr("was silent for 0.5 s in contact")));
  }
}

TEST(OneShot, PassingThroughIsFeltForHalfASecond) {
  for (const double speed : {-0.05, -0.2, -1.0}) {
    Guest guest("touch = \"all\"");
    guest.say(0.06, speed);
    EXPECT_LE(guest.run(6000), 600u) << speed;
  }
}

constexpr std::string_view kSecondHand = R"(
[[operator]]
passive = true
position = [0.0175, 0.0, 0.0]
stiffness = "300 N/m"
)";

// Force of the other hand [N].
double pressure_of_hands(InProcess& world, std::size_t link) {
  const haptics::ServoSnapshot& servo = world.view(link).servo();
  double sum = 0.0;
  for (std::size_t i = 0; i < servo.count; ++i) {
    if (servo.contacts[i].id.site != 900) sum += servo.contacts[i].force.norm();
  }
  return sum;
}

TEST(Guests, WithoutEnergyPartNoHands) {
  for (const double speed : {0.1, 0.2, 0.4}) {
    Guest guests("touch = \"all\"", kSecondHand);
    guests.press(-0.02);
    guests.run(1000);
    guests.press(0.0);
    guests.run(3000);
    InProcess& world = guests.world();
    const std::array<double, 2> before{pressure_of_hands(world, 0), pressure_of_hands(world, 1)};
    ASSERT_GT(std::min(before[0], before[1]), 0.2);
    for (int i = 0; i < 9; ++i) {
      const double around = 0.7 * i;
      const Eigen::Vector3d away(std::cos(around), std::sin(around), 0.3 * (i % 3));
      guests.say_ball(static_cast<std::uint16_t>(1 + i), 0.12 * away, -speed * away, 2);
    }
    std::array<int, 2> low{}, longest{};
    double felt = 0.0;
    for (int i = 0; i < 4000; ++i) {
      world.run(1);
      felt = std::max(felt, pressure_on(world) - pressure_of_hands(world, 0));
      for (std::size_t hand = 0; hand < 2; ++hand) {
        low[hand] = pressure_of_hands(world, hand) < 0.5 * before[hand] ? low[hand] + 1 : 0;
        longest[hand] = std::max(longest[hand], low[hand]);
      }
    }
    EXPECT_GT(felt, 0.05) << "they were there";
    EXPECT_GT(world.view(0).servo().tally.guests.seconds, 0.1) << "the summary reports it";
    EXPECT_LT(std::max(longest[0], longest[1]), 500) << speed;
  }
}

TEST(Guest, IsFeltWhileItRepeatsItself) {
  Guest guest("touch = [\"900:1\"]");
  guest.say(0.06);
  guest.run(100);
  guest.press(0.04);
  std::size_t pressed = 0;
  for (int i = 0; i < 20; ++i) {
    guest.say(0.06);
    pressed += guest.run(200);
  }
  EXPECT_GT(pressed, 3800u);
  EXPECT_LE(guest.run(2000), 600u) << "it fell silent";
}

TEST(Guest, KeepsItsNameAtItsFirstAddress) {
  Guest guest("touch = [\"900:1\"]");
  guest.say(0.06);
  guest.run(13'000);
  guest.say(0.06, 0.0, 2);
  guest.run(100);
  guest.press(0.04);
  guest.say(0.06, 0.0, 2);
  EXPECT_EQ(guest.run(400), 0u) << "another host";
  EXPECT_EQ(guest.world().count(0, "touch_refused"), 2u);
}

// A post of the second peer, which the first peer's hand presses.
const std::string kPost = with(kHeldHand, "TOUCH", "") + R"(
[[entity]]
peer = 2
marking = "POST"
type = "5.0"
position = [0.025, 0.0, 0.0]
force_model = {kind = "sphere", radius = "20 mm", k1 = "300 N/m"}
)";

haptics::HandTarget pressing(double t) {
  haptics::HandTarget target;
  target.position = {t < 3.0 ? -0.05 : std::min(0.0, -0.05 + 0.1 * (t - 3.0)), 0, 0};
  return target;
}

struct Post {
  explicit Post(const peer::ImpairmentLaw& law) : scene(scene_of(kPost)), world(2) {
    world.network().impair(law);
    world.listen(scene);
    world.move_by(0, pressing);
    world.start(0, scene);
    world.start(1, scene);
  }
  const peer::SceneFile scene;
  InProcess world;
};

TEST(Post, IsRepeatedWhileAHandPressesIt) {
  peer::ImpairmentLaw bad;
  bad.delay = milliseconds(100);
  bad.jitter = milliseconds(30);
  bad.loss = 0.1;
  for (const auto& law : {peer::ImpairmentLaw{}, bad}) {
    Post post(law);
    post.world.run(2900);
    const std::size_t before = post.world.count(1, "updates_out");
    post.world.run(1600);
    std::size_t unfelt = 0;
    for (int i = 0; i < 60'000; ++i) {
      post.world.run(1);
      unfelt += pressure_on(post.world) > 0.1 ? 0 : 1;
    }
    EXPECT_EQ(unfelt, 0u);
    EXPECT_GT(post.world.count(1, "updates_out") - before, 600u);
    EXPECT_EQ(post.world.count(0, "silent_in_contact"), 0u);
  }
}

TEST(Post, FadesOutWhenItsOwnerIsCutOff) {
  Post post({});
  post.world.run(5000);
  ASSERT_GT(pressure_on(post.world), 0.1);
  post.world.kill(1);
  const auto gone = [&] { return pressure_on(post.world) == 0.0; };
  EXPECT_LE(post.world.run_until(gone, 2000), 800u);
}

TEST(Post, IsSilentWhileNobodyPressesIt) {
  Post post({});
  post.world.run(1000);
  const std::size_t before = post.world.count(1, "updates_out");
  post.world.run(1900);
  EXPECT_LE(post.world.count(1, "updates_out") - before, 3u);
}

}  // namespace
}  // namespace reckon::test
