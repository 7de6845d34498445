// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// PDUs of every type, correct in length but false in content, beside two hands that hold each
// other: PDUs of the hands' own peers with other values, and random ones. No contact is lost, no
// hand is moved, hidden or frozen, and the user gets few notices. RECKON_SOAK=1 tries 1,000 seeds.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <deque>
#include <limits>
#include <random>
#include <span>
#include <string>
#include <vector>

#include "reckon/pdu/timestamp.hpp"
#include "reckon/peer/loops/notice_gate.hpp"
#include "reckon/tests/pdu/support/random_pdu.hpp"
#include "reckon/tests/support/arriving_hand.hpp"
#include "reckon/tests/support/in_process.hpp"
#include "reckon/tests/support/soak.hpp"
#include "reckon/tests/support/tier_rows.hpp"

namespace reckon::test::liars_test {
namespace {

constexpr std::string_view kPair = R"(
[scene]
name = "two hands among liars"
origin = {latitude = "47.05 deg", longitude = "8.31 deg", height = "430 m"}

[hand]
radius = "10 mm"
k1 = "300 N/m"

[network]
touch = ["1:1", "1:2"]
#network

[aoim]
pool = 64
#aoim

[[operator]]
sweep = {from = [-0.004, 0.0, 0.0], to = [-0.003, 0.0, 0.0], period = "1 s"}

[[operator]]
passive = true
position = [0.010, 0.0, 0.0]
stiffness = "150 N/m"
)";

// Changes some fields of a PDU, most often its IDs.
class OtherMeaning {
 public:
  OtherMeaning(std::mt19937& random, std::span<const pdu::EntityId> names)
      : random_(random), names_(names) {}

  template <typename T>
  void operator()(std::string_view, T& value) {
    if constexpr (pdu::Scalar<T>) {
      if (one_in(8)) value = other(value);
    } else if constexpr (pdu::kIsStdArray<T>) {
      for (auto& element : value)
        if (one_in(30)) element = other(element);
    } else {
      fields(*this, value);
    }
  }
  void operator()(std::string_view, pdu::PduHeader& header) {
    if (one_in(4)) header.timestamp = static_cast<std::uint32_t>(random_());
  }
  void operator()(std::string_view, pdu::EntityId& id) {
    if (one_in(4)) id = names_[random_() % names_.size()];
    if (one_in(16)) fields(*this, id);
  }
  template <typename Record, typename Count>
  void count(std::string_view, std::span<const std::byte>&, pdu::Records<Record, Count>) {}
  template <typename Record, typename Count>
  void records(std::string_view, std::span<const std::byte>& view, pdu::Records<Record, Count>) {
    view = other_octets(view);
  }
  template <typename View>
  void walked(std::string_view, View& view) {
    view.bytes = other_octets(view.bytes);
  }

 private:
  [[nodiscard]] bool one_in(unsigned n) { return random_() % n == 0; }
  template <typename T>
  T other(T value) {
    if constexpr (std::is_floating_point_v<T>) {
      constexpr std::array<T, 12> kReals{0,
                                         T(-0.0),
                                         T(1e-30),
                                         T(1e-3),
                                         1,
                                         -1,
                                         T(1e3),
                                         T(1e9),
                                         T(-1e30),
                                         std::numeric_limits<T>::infinity(),
                                         std::numeric_limits<T>::quiet_NaN(),
                                         T(3e38)};
      return one_in(3) ? value * static_cast<T>(1 + 1e-6 * static_cast<double>(random_() % 1000))
                       : kReals[random_() % kReals.size()];
    } else {
      constexpr std::array<std::uint64_t, 8> kNumbers{0, 1, 2, 255, 0x7FFF, 0xFFFE, 0xFFFF, ~0ULL};
      return static_cast<T>(one_in(2) ? static_cast<std::uint64_t>(random_())
                                      : kNumbers[random_() % kNumbers.size()]);
    }
  }
  std::span<const std::byte> other_octets(std::span<const std::byte> view) {
    if (view.empty() || !one_in(2)) return view;
    auto& octets = store_.emplace_back(view.begin(), view.end());
    for (std::size_t i = 8; i < octets.size(); ++i)
      if (one_in(24)) octets[i] = static_cast<std::byte>(random_());
    return octets;
  }

  std::mt19937& random_;
  std::span<const pdu::EntityId> names_;
  std::deque<std::vector<std::byte>> store_;
};

class Liars : public testing::TestWithParam<std::uint32_t> {
 protected:
  Liars() : random_(GetParam()), scene_(drawn()) {
    world_.listen(scene_);
    world_.move_by(0, arriving(scene_.operators[0], {-0.03, 0, 0}));
    world_.start(0, scene_);
    world_.start(1, scene_);
    if (random_() % 2 == 0) world_.start(2, scene_);  // the liar has joined
    world_.run(4000);
    usual_ = std::min(felt(0), felt(1));
    names_ = {world_.peer(0).own_id(), world_.peer(1).own_id(), {1, 3, 1}, {1, 3, 9}, {9, 9, 9},
              {0xFFFF, 0xFFFF, 0xFFFF}};
    known_ = world_.heard();
    for (const std::size_t link : {0u, 1u}) static_cast<void>(world_.notices(link));
  }
  // Random options of interest and network.
  peer::SceneFile drawn() {
    struct Ways {
      std::string aoim, network;
    };
    const std::array<Ways, 9> ways{{{"", ""},
                                    {"", "compression = \"compact\""},
                                    {"", "compression = \"residual\""},
                                    {kTouchTier, ""},
                                    {kTouchTier, "compression = \"residual\""},
                                    {"leaders = true", ""},
                                    {"leaders = true\nhand_out = true", ""},
                                    {kDistanceTiers, ""},
                                    {kOwnTiers, ""}}};
    const Ways& way = ways[random_() % ways.size()];
    return scene_of(with(with(kPair, "#aoim", way.aoim), "#network", way.network));
  }

  [[nodiscard]] double felt(std::size_t link) {
    const haptics::ServoSnapshot& servo = world_.view(link).servo();
    for (std::size_t i = 0; i < servo.count; ++i) {
      if (servo.contacts[i].id == world_.peer(1 - link).own_id())
        return servo.contacts[i].force.norm();
    }
    return 0.0;
  }
  // Distance of the other hand as a peer shows it from its true position [m]; infinite if it is not
  // shown.
  [[nodiscard]] double off(std::size_t link) {
    const auto* row = world_.peer(link).model().remote().find(world_.peer(1 - link).own_id());
    if (row == nullptr) return std::numeric_limits<double>::infinity();
    return (row->shown(world_.clock().now()).position - world_.view(1 - link).servo().scp).norm();
  }

  // Resends a PDU of a peer with changed values.
  void say_again() {
    const auto& heard = known_[random_() % known_.size()];
    std::vector<pdu::BundledPdu> said;
    for (const pdu::BundledPdu& one : pdu::BundleReader(heard.octets)) said.push_back(one);
    if (said.empty()) return;
    const pdu::BundledPdu& one = said[random_() % said.size()];
    static_cast<void>(pdu::visit(one.bytes, one.header, [&](const auto& known) {
      auto other = known;
      send(heard.group, other);
    }));
  }
  // Sends a PDU of any type with random content.
  void say_new() {
    const std::size_t chosen = random_() % pdu::PduTypes::kSize;
    std::size_t at = 0;
    [&]<typename... T>(pdu::TypeList<T...>) {
      (
          [&] {
            if (at++ != chosen) return;
            RandomFields random(random_());
            T message;
            fields(random, message);
            message.header = pdu::header_of<T>();
            message.header.exercise_id = scene_.network.exercise;
            message.header.timestamp = pdu::to_dis_timestamp(world_.clock().utc_now(), true);
            send(scene_.network.group, message);
          }(),
          ...);
    }(pdu::PduTypes{});
  }
  template <typename T>
  void send(const peer::GroupAddress& group, T& message) {
    OtherMeaning other(random_, names_);
    fields(other, message);
    std::vector<std::byte> octets(pdu::wire_size(message));
    if (octets.empty() || octets.size() > 1288 || pdu::encode(message, octets) != octets.size())
      return;
    if (world_.network().link(2).send(group, octets)) ++sent_;
  }
  void step_and_judge() {
    world_.run(1);
    for (const std::size_t link : {0u, 1u}) {
      gap_[link] = felt(link) < 0.5 * usual_ ? gap_[link] + 1 : 0;
      longest_ = std::max(longest_, gap_[link]);
      farthest_ = std::max(farthest_, off(link));
      frozen_ = frozen_ || world_.view(link).frozen;
    }
  }

  std::mt19937 random_;
  peer::SceneFile scene_;
  InProcess world_{4};
  std::vector<pdu::EntityId> names_;
  std::vector<Heard> known_;
  double usual_ = 0, farthest_ = 0;
  std::array<std::size_t, 2> gap_{};
  std::size_t longest_ = 0, sent_ = 0;
  bool frozen_ = false;
};

TEST_P(Liars, NeitherEndContactsNorMoveOrHideHands) {
  constexpr std::size_t kSeconds = 3;
  ASSERT_GT(usual_, 0.1);
  for (std::size_t i = 0; i < kSeconds * 1000; ++i) {
    if (i % 2 == 0) random_() % 2 == 0 ? say_again() : say_new();
    step_and_judge();
  }
  EXPECT_GT(sent_, 1000u);
  EXPECT_LE(longest_, 500u) << "[ms] without the other hand";
  EXPECT_LE(farthest_, 0.005) << "[m] from where it is";
  EXPECT_FALSE(frozen_);
  for (const std::size_t link : {0u, 1u})
    EXPECT_LE(world_.notices(link).size(), peer::NoticeGate::kAtOnce + kSeconds) << "lines";
}
INSTANTIATE_TEST_SUITE_P(Seeds, Liars, testing::Range(1u, test::tries(11u, 1001u)));

}  // namespace
}  // namespace reckon::test::liars_test
