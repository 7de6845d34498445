// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Strangers' bodies around two touching hands: the hands continue to feel each other.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <span>
#include <string>
#include <vector>

#include "reckon/pdu/entity/attribute.hpp"
#include "reckon/pdu/timestamp.hpp"
#include "reckon/tests/support/arriving_hand.hpp"
#include "reckon/tests/support/in_process.hpp"
#include "reckon/tests/support/soak.hpp"

namespace reckon::test {
namespace {

using testing::Contains;
using testing::HasSubstr;
using testing::Not;

// One hand presses against another, and both rest.
constexpr std::string_view kHeld = R"(
[scene]
name = "two hands that hold each other"
origin = {latitude = "47.05 deg", longitude = "8.31 deg", height = "430 m"}

[hand]
radius = "10 mm"
k1 = "300 N/m"

[network]
touch = "all"

[aoim]
pool = 16

[[operator]]
sweep = {from = [-0.004, 0.0, 0.0], to = [-0.003, 0.0, 0.0], period = "1 s"}

[[operator]]
passive = true
position = [0.010, 0.0, 0.0]
stiffness = "150 N/m"
)";

// The strangers' bodies around the hands, drawn for each seed.
struct Guests {
  explicit Guests(std::uint32_t seed) : random(seed) {
    count = static_cast<std::uint16_t>(std::lround(33 * std::pow(12.0, uniform(0, 1))));
    kind = static_cast<pdu::ForceModelKind>(1 + random() % 4);
    radius = static_cast<float>(uniform(0.05, 3.0));
    constexpr std::array<float, 4> kSpringless{0.0F, 1e-30F, 1e-9F, 1e-3F};
    k1 = kSpringless[random() % kSpringless.size()];
    validity_ms = random() % 2 == 0 ? 65'535 : 900;
    at_once = 1 + random() % 5;
  }
  double uniform(double least, double most) {
    return std::uniform_real_distribution<double>(least, most)(random);
  }

  std::minstd_rand random;
  std::uint16_t count;
  pdu::ForceModelKind kind;
  float radius, k1;
  std::uint16_t validity_ms;
  std::size_t at_once;
};

class Crowding : public testing::Test {
 protected:
  void begin(const peer::SceneFile& scene) {
    scene_ = &scene;
    world_.listen(scene);
    world_.move_by(0, arriving(scene.operators[0], {-0.03, 0, 0}));
    world_.start(0, scene);
    world_.start(1, scene);
    world_.run(4000);
    usual_ = std::min(felt(0), felt(1));
    ASSERT_GT(usual_, 0.1);
    for (const pdu::EntityState& state : world_.heard_pdus<pdu::EntityState>()) {
      if (state.entity_id == world_.peer(1).own_id()) state_ = state;
    }
    state_.variable_parameters = {};
    world_.heard().clear();
  }
  // Force of the other hand [N].
  [[nodiscard]] double felt(std::size_t link) {
    const haptics::ServoSnapshot& servo = world_.view(link).servo();
    for (std::size_t i = 0; i < servo.count; ++i) {
      if (servo.contacts[i].id == world_.peer(1 - link).own_id())
        return servo.contacts[i].force.norm();
    }
    return 0.0;
  }
  // Longest time in which a hand feels less than half of its usual force [ms].
  std::size_t gap(std::size_t length) {
    std::size_t longest = 0;
    std::array<std::size_t, 2> since{};
    for (std::size_t i = 0; i < length; ++i) {
      world_.run(1);
      for (std::size_t link = 0; link < 2; ++link) {
        since[link] = felt(link) < 0.5 * usual_ ? since[link] + 1 : 0;
        longest = std::max(longest, since[link]);
      }
    }
    return longest;
  }
  void say_guests(std::size_t link, Guests& guests) {
    for (std::uint16_t i = 0; i < guests.count;) {
      std::vector<std::byte> datagram;
      std::array<std::byte, 4096> buffer;
      pdu::AttributeWriter records(buffer, {});
      for (std::size_t k = 0; k < guests.at_once && i < guests.count; ++k, ++i) {
        pdu::EntityState guest = state_;
        guest.entity_id = {900, 1, static_cast<std::uint16_t>(1 + i)};
        guest.header.timestamp = pdu::to_dis_timestamp(world_.clock().utc_now(), true);
        guest.location.x += guests.uniform(-0.03, 0.03);
        guest.location.y += guests.uniform(-0.03, 0.03);
        const std::size_t before = datagram.size();
        datagram.resize(before + pdu::wire_size(guest));
        static_cast<void>(pdu::encode(guest, std::span(datagram).subspan(before)));
        ASSERT_TRUE(records.begin_set(guest.entity_id) && records.add(model_of(guests)));
      }
      const std::size_t size = records.finish();
      datagram.insert(datagram.end(), buffer.begin(),
                      buffer.begin() + static_cast<std::ptrdiff_t>(size));
      ASSERT_TRUE(world_.network().link(link).send(scene_->network.group, datagram));
    }
  }
  static pdu::HapticRecord model_of(Guests& guests) {
    pdu::HapticRecord model;
    model.kind = guests.kind;
    model.radius = guests.radius;
    model.k1 = guests.k1;
    model.validity_ms = guests.validity_ms;
    model.normal = {0, 0, 1};
    return model;
  }

  const peer::SceneFile* scene_ = nullptr;
  InProcess world_{4};
  pdu::EntityState state_;
  double usual_ = 0;
};

class CrowdingSeeds : public Crowding, public testing::WithParamInterface<std::uint32_t> {};

TEST_P(CrowdingSeeds, KeepsTheContactAndReportsTheGuests) {
  const peer::SceneFile scene = scene_of(kHeld);
  ASSERT_NO_FATAL_FAILURE(begin(scene));
  static_cast<void>(world_.notices(0));
  Guests guests(GetParam());
  std::size_t longest = 0;
  for (int i = 0; i < 3; ++i) {
    say_guests(2, guests);
    longest = std::max(longest, gap(500));
  }
  EXPECT_LE(longest, 100u) << guests.count << " of " << guests.radius << " m";
  EXPECT_GT(world_.count(0, "hands_unfelt"), 0u);
  EXPECT_THAT(
      world_.notices(0),
      Contains(HasSubstr("most of them from " + world_.network().link(2).local_endpoint().text())));
}
INSTANTIATE_TEST_SUITE_P(Seeds, CrowdingSeeds, testing::Range(1u, tries(9u, 21u)));

TEST_F(Crowding, BeforeAHandComesLeavesItAPlace) {
  const peer::SceneFile scene = scene_of(kHeld);
  ASSERT_NO_FATAL_FAILURE(begin(scene));
  Guests guests(3);
  guests.validity_ms = 65'535;
  world_.stop(1);
  say_guests(2, guests);
  world_.run(500);
  ASSERT_GT(world_.count(0, "hands_unfelt"), 0u);
  world_.start(1, scene, 777, 2);
  const auto feel = [&] { return felt(0) > 0.5 * usual_; };
  EXPECT_LE(world_.run_until(feel, 3000), 3000u);
}

TEST_F(Crowding, PeersThatMayNotTouchAreReportedUnfelt) {
  const peer::SceneFile scene = scene_of(with(kHeld, "\"all\"", "[\"1:1\", \"1:2\"]"));
  ASSERT_NO_FATAL_FAILURE(begin(scene));
  static_cast<void>(world_.notices(0));
  Guests guests(1);
  guests.k1 = 500.0F;
  guests.count = 1;
  say_guests(2, guests);
  EXPECT_EQ(gap(500), 0u);
  const auto& servo = world_.view(0).servo();
  EXPECT_EQ(servo.count, 1u) << "the other hand alone";
  EXPECT_EQ(world_.count(0, "touch_refused"), 1u);
  EXPECT_THAT(world_.notices(0),
              Contains(HasSubstr("900:1:1 at " + world_.network().link(2).local_endpoint().text() +
                                 " is not felt: see touch in the scene")));
}

TEST_F(Crowding, ModelsExpireByTheScenesValidity) {
  const peer::SceneFile scene = scene_of(kHeld);
  ASSERT_NO_FATAL_FAILURE(begin(scene));
  Guests guests(1);
  guests.count = 1;
  guests.validity_ms = 65'535;
  say_guests(2, guests);
  world_.run(100);
  const peer::RemoteEntity* row = world_.peer(0).model().remote().find({900, 1, 1});
  ASSERT_NE(row, nullptr);
  EXPECT_LE(row->valid_until - row->last_heard, scene.hand.validity);
  EXPECT_LE(row->timeout, 12.0);
}

}  // namespace
}  // namespace reckon::test
