// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// A device that renders springs and is pulled out before each call of its session, and at random
// instants.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <string>

#include "reckon/tests/haptics/support/evdev_model.hpp"
#include "reckon/tests/haptics/support/hid_wheel.hpp"
#include "reckon/tests/haptics/support/plugged_events.hpp"

namespace reckon::haptics::evdev_unplug_test {
namespace {

using Eigen::Vector3d;
using std::chrono::microseconds;
using std::chrono::milliseconds;
using std::chrono::nanoseconds;
using ::testing::AnyOf;
using ::testing::Each;
using ::testing::HasSubstr;

struct Evdev {
  using Model = test::EvdevModel;
  using Options = test::EvdevModelOptions;
  static constexpr const char* kName = "Evdev";
  static constexpr unsigned kCalls = 60;  // calls of the set-up, and some of its use
  static constexpr milliseconds kGone{10}, kBack{10};
  static constexpr microseconds kTick{50};
  static void pull(Model& model) { model.pull(); }
  static double force(const Model& model) { return model.force(0); }
};

struct Hid {
  using Model = test::HidWheel;
  using Options = test::HidWheelOptions;
  static constexpr const char* kName = "Hid";
  static constexpr unsigned kCalls = 90;
  static constexpr milliseconds kGone{12}, kBack{30};
  static constexpr microseconds kTick{100};
  static void pull(Model& model) { model.plug(false); }
  static double force(const Model& model) { return model.wheel.force(0); }
};

template <class Kind>
class Plugged : public test::PluggedEvents<typename Kind::Model> {
 public:
  // Into the wall and out of it, five times a second.
  Plugged()
      : test::PluggedEvents<typename Kind::Model>(
            typename Kind::Options{},
            [](double t) {
              return typename Kind::Model::Places{-0.02 + 0.01 * std::sin(30 * t), 0};
            },
            test::one_wall(), test::settings_for(typename Kind::Options{}), Kind::kTick) {}

  // Some ms after the unplug.
  void expect_nothing() {
    EXPECT_EQ(this->last().force, Vector3d::Zero());
    EXPECT_FALSE(this->last().enabled);
    EXPECT_EQ(this->model.open_files(), 0);
    EXPECT_EQ(Kind::force(this->model), 0);
  }
  void expect_back() {
    this->notices.clear();
    this->model.plug(true);
    this->run(EvdevLoop::kRetry + Kind::kBack);
    EXPECT_THAT(this->notices, ::testing::Contains(HasSubstr("ready")));
    EXPECT_LE(this->notices.size(), 1U);
  }
};

template <class Kind>
class EventUnplug : public ::testing::Test {};
struct Names {
  template <class Kind>
  static std::string GetName(int) {
    return Kind::kName;
  }
};
using EventKinds = ::testing::Types<Evdev, Hid>;
TYPED_TEST_SUITE(EventUnplug, EventKinds, Names);

TYPED_TEST(EventUnplug, BeforeAnyCallIsReportedAndRecovered) {
  for (unsigned call = 0; call < TypeParam::kCalls; ++call) {
    SCOPED_TRACE(call);
    Plugged<TypeParam> plugged;
    unsigned made = 0;
    bool is_pulled = false;
    plugged.model.at_each_call = [&] {
      if (is_pulled || made++ != call) return;
      is_pulled = true;
      TypeParam::pull(plugged.model);
    };
    while (!is_pulled) plugged.run(TypeParam::kTick);
    plugged.run(TypeParam::kGone);
    plugged.expect_nothing();
    EXPECT_THAT(plugged.notices,
                Each(AnyOf(HasSubstr("was unplugged"), HasSubstr("attached"), HasSubstr("ready"))));
    EXPECT_LE(plugged.notices.size(), 2U);
    plugged.expect_back();
  }
}

TEST(EvdevUnplug, AtRandomInstantsLeavesNoForce) {
  std::mt19937 random(11);
  Plugged<Evdev> plugged;
  double most = 0;
  for (int round = 0; round < 100; ++round) {
    SCOPED_TRACE(round);
    plugged.run(microseconds(50) * (random() % 8'000));
    most = std::max(most, plugged.model.force(0));
    plugged.notices.clear();
    plugged.model.pull();
    // It may be back before anything was noticed.
    if (round % 4 == 0) plugged.model.plug(true);
    plugged.run(milliseconds(10));
    plugged.expect_nothing();
    EXPECT_THAT(plugged.notices, ::testing::SizeIs(1));
    if (round % 4 == 1) plugged.run(milliseconds(1) * (random() % 600));
    plugged.expect_back();
  }
  EXPECT_GT(most, 1) << "pulled out under a force";
  EXPECT_GE(plugged.model.least_absorbed(), -1e-9);
}

}  // namespace
}  // namespace reckon::haptics::evdev_unplug_test
