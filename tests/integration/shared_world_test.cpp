// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Two users share a world: space, presence, time, messages and the interaction with an object (the
// five features of a networked virtual environment, thesis chapter 1).
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "reckon/pdu/management/comment.hpp"
#include "reckon/peer/federate.hpp"
#include "reckon/peer/federation/federate_bodies.hpp"
#include "reckon/peer/joined_peer.hpp"
#include "reckon/tests/integration/owners_exercise.hpp"

namespace reckon::test {
namespace {

using namespace std::chrono_literals;
using Eigen::Vector3d;
using peer::BodyHandle;

constexpr nanoseconds kAhead = 250ms;   // the second user's clock of the day
constexpr double kShownWithin = 0.002;  // [m], of the shown hands and bodies, with the delay's way

/// Each has a hand and a clock of its own, over a LAN.
class TwoUsers {
 public:
  explicit TwoUsers(const std::array<haptics::HandScript, 2>& laws) {
    network_.impair(line_of(1ms, 300us, 0.0));
    for (std::size_t i = 0; i < 2; ++i) {
      haptics::SimulatedDeviceConfig config;
      config.hand_stiffness = 300;
      config.start = laws[i](0).position;
      hands_[i] = std::make_unique<haptics::SimulatedDevice>(config, laws[i]);
      peer::FederateOptions options;
      options.name = i == 0 ? "ALICE" : "BOB";
      options.scene = scene_of(cubes_scene(2));
      options.application = static_cast<std::uint16_t>(i + 1);
      options.scene_peer = static_cast<std::uint32_t>(i + 1);
      options.devices.resize(1);
      options.devices[0].device = hands_[i].get();
      users_[i] = std::make_unique<peer::Federate>(options, network_.link(i), clocks_[i],
                                                   static_cast<std::uint32_t>(i + 1));
      users_[i]->subscribe(peer::EntityClass{});
      users_[i]->publish<pdu::Comment>();
      users_[i]->subscribe<pdu::Comment>([this, i](const pdu::Comment& comment) {
        for (const pdu::VariableDatum& datum : comment.variable_datums.records())
          read_[i].emplace_back(reinterpret_cast<const char*>(datum.value.data()),
                                datum.value.size());
      });
    }
  }
  void run(nanoseconds span) {
    for (const nanoseconds end = clocks_[0].now() + span; clocks_[0].now() < end;) {
      for (std::size_t i = 0; i < 2; ++i) clocks_[i].advance(1ms);
      for (const auto& user : users_) user->step();
    }
  }
  void say(std::size_t user, const std::string& text) {
    std::array<std::byte, 256> buffer{};
    pdu::VariableDatumWriter writer(buffer);
    ASSERT_TRUE(writer.add(1, std::as_bytes(std::span(text))));
    pdu::Comment comment;
    comment.variable_datums = writer.datums();
    users_[user]->send(comment, peer::Delivery::assured);
  }
  [[nodiscard]] peer::Federate& operator[](std::size_t i) { return *users_[i]; }
  [[nodiscard]] haptics::SimulatedDevice& hand(std::size_t i) { return *hands_[i]; }
  [[nodiscard]] const std::vector<std::string>& read_by(std::size_t i) const { return read_[i]; }
  /// Lead of the other user's clock, as this one measures it.
  [[nodiscard]] nanoseconds lead_for(std::size_t i) {
    const auto other = static_cast<std::uint32_t>(2 - i);
    const auto found = users_[i]->peer().model().time().peers().difference(other, clocks_[i].now());
    EXPECT_TRUE(found);
    return found ? found->ahead : nanoseconds::max();
  }
  [[nodiscard]] Vector3d place(std::size_t i, std::uint32_t body) {
    return users_[i]->bodies().motion_of(BodyHandle{body}).position;
  }
  /// Distance between a user's hand and the one that the other user sees [m].
  [[nodiscard]] double hand_error(std::size_t i) {
    peer::Federate& other = *users_[1 - i];
    const auto seen = other.find(users_[i]->id_of(users_[i]->hand(0)));
    EXPECT_TRUE(seen) << "nobody sees the hand of user " << i;
    if (!seen) return INFINITY;
    EXPECT_EQ(seen->marking(), i == 0 ? "ALICE" : "BOB");
    return (seen->shown(other.now()).position - hands_[i]->position()).norm();
  }

 private:
  std::array<peer::ManualClock, 2> clocks_{peer::ManualClock{1s, 1h},
                                           peer::ManualClock{1s, 1h + kAhead}};
  peer::SimulatedNetwork network_{{.links = 2}, clocks_[0]};
  std::array<std::unique_ptr<haptics::SimulatedDevice>, 2> hands_;
  std::array<std::unique_ptr<peer::Federate>, 2> users_;
  std::array<std::vector<std::string>, 2> read_;
};

TEST(SharedWorld, HasItsFiveFeatures) {
  const auto rests = [](double) {
    haptics::HandTarget target;
    target.position = {-0.1, 0.1, 0.02};
    return target;
  };
  const auto pushes = [](double t) {
    haptics::HandTarget target;
    target.position = {0.2 - std::min(0.1 * std::max(0.0, t - 4), 0.15), 0, 0.02};
    return target;
  };
  TwoUsers users({rests, pushes});
  users.run(4s);

  // Space and presence: the same bodies in the same places, and the other user's hand.
  for (std::uint32_t body = 0; body < 2; ++body)
    EXPECT_LT((users.place(0, body) - users.place(1, body)).norm(), kShownWithin) << body;
  for (std::size_t i = 0; i < 2; ++i) EXPECT_LT(users.hand_error(i), kShownWithin) << i;

  // Time: each knows the other's clock.
  for (std::size_t i = 0; i < 2; ++i) {
    const nanoseconds error = users.lead_for(i) - (i == 0 ? kAhead : -kAhead);
    EXPECT_LT(std::chrono::abs(error), 1ms) << i;
  }

  // Messages.
  users.say(0, "push the cube");
  users.run(100ms);
  EXPECT_EQ(users.read_by(1), std::vector<std::string>{"push the cube"});
  users.say(1, "I push");
  users.run(100ms);
  EXPECT_EQ(users.read_by(0), std::vector<std::string>{"I push"});

  // Interaction: the second user pushes a cube of the first, feels it, and both see it move.
  ASSERT_TRUE(users[0].bodies().owns(BodyHandle{1}));
  double most = 0.0, apart = 0.0;
  for (int i = 0; i < 1500; ++i) {
    users.run(1ms);
    most = std::max(most, users.hand(1).force().norm());
    apart = std::max(apart, (users.place(0, 1) - users.place(1, 1)).norm());
  }
  EXPECT_TRUE(users[1].bodies().owns(BodyHandle{1}));
  EXPECT_GT(most, 0.15) << "N, friction of 50 g at 0.4";
  EXPECT_LT(users.place(1, 1).x(), 0.08);
  EXPECT_LT(apart, kShownWithin);
  EXPECT_LT(users.hand_error(1), kShownWithin);
}

}  // namespace
}  // namespace reckon::test
