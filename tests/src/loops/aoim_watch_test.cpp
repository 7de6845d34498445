// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/peer/loops/aoim_watch.hpp"

#include <gmock/gmock.h>

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "reckon/peer/loops/aoim_setup.hpp"

namespace reckon::peer {
namespace {

using std::chrono::milliseconds;
using std::chrono::nanoseconds;
using std::chrono::seconds;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

pdu::Presence presence_of(std::uint16_t application) {
  pdu::Presence own;
  own.simulation = {7, application};
  own.epoch = application;
  return own;
}

/// A manager that is stepped 20 times a second, as in the model loop.
class AoimWatchTest : public testing::Test {
 protected:
  void begin(const SceneFile& scene) {
    scene_ = scene;
    manager_.emplace(aoim_config(scene_), presence_of(1));
    watch_.emplace(scene_, counters_);
    manager_->start(now_);
  }
  /// The notices until `length` has passed.
  std::vector<std::string> run(nanoseconds length) {
    for (const nanoseconds end = now_ + length; now_ < end; now_ += milliseconds(50)) {
      const aoim::Focus focus{{}, 0.0, scene_.aoim.radius};
      watch_->look(*manager_, manager_->listen(aoim::kCellTier, {&focus, 1}, now_), now_, notices_);
    }
    std::vector<std::string> told;
    for (; notices_.front() != nullptr; notices_.pop()) {
      told.emplace_back(notices_.front()->text.data());
    }
    return told;
  }
  /// This number of other peers announce themselves.
  void announce(std::uint16_t peers) {
    for (std::uint16_t i = 2; i < 2 + peers; ++i) {
      std::array<std::byte, pdu::kFixedSize<pdu::Presence>> octets;
      pdu::Presence heard = presence_of(i);
      heard.cell_scheme = scene_.aoim.scheme;
      ASSERT_EQ(pdu::encode(heard, octets), octets.size());
      manager_->receive(aoim::kBaseGroup, octets, now_);
    }
  }
  std::uint64_t count(std::string_view name) { return counters_.find(name)->value(); }

  SceneFile scene_;
  Counters counters_;
  haptics::SpscRing<Notice> notices_{64};
  std::optional<aoim::AreaOfInterestManager> manager_;
  std::optional<AoimWatch> watch_;
  nanoseconds now_ = seconds(100);
};

TEST_F(AoimWatchTest, IsSilentForAHealthyScene) {
  begin({});
  EXPECT_THAT(run(seconds(100)), IsEmpty());
}

TEST_F(AoimWatchTest, ReportsACapOnceAndItsEndOnce) {
  SceneFile scene;
  scene.aoim.scheme = aoim::CellScheme::square;
  scene.aoim.radius = 3.0;
  scene.aoim.groups = 20;
  begin(scene);
  EXPECT_THAT(run(seconds(60)), ElementsAre(HasSubstr("[aoim] groups = 20 is reached")));
  scene_.aoim.radius = 1.0;  // the focus shrinks: 20 groups are enough
  EXPECT_THAT(run(seconds(60)), ElementsAre(HasSubstr("joined again")));
}

TEST_F(AoimWatchTest, ReportsPeersWithoutRoom) {
  begin({});
  announce(1024);
  EXPECT_THAT(run(seconds(1)), IsEmpty());
  announce(1027);
  EXPECT_THAT(run(seconds(1)), ElementsAre(HasSubstr("is full with 1024")));
  EXPECT_EQ(count("peers_not_joined"), 3u);
  announce(1027);
  EXPECT_THAT(run(seconds(2)), IsEmpty());
  EXPECT_THAT(run(seconds(2)), ElementsAre(HasSubstr("the table of peers has room again")));
}

TEST_F(AoimWatchTest, ReportsAnInteropExerciseOutOfRangeOnce) {
  SceneFile scene;
  scene.network.interop = true;
  begin(scene);
  EXPECT_THAT(run(seconds(70)), IsEmpty()) << "nothing heard, nothing to say";
  const auto hear = [&](double away) {
    static_cast<void>(manager_->sight().judge({away, 0, 0}, 0.0, 1, false));
  };
  hear(12000);
  hear(3500);
  EXPECT_THAT(run(seconds(60)), ElementsAre(testing::AllOf(HasSubstr("nearest is 3500 m away"),
                                                           HasSubstr("[aoim] radius is 2 m"))));
  EXPECT_EQ(count("entities_outside"), 2u);
  hear(3500);
  EXPECT_THAT(run(seconds(120)), IsEmpty()) << "told already";
  hear(1.0);
  hear(3500);
  EXPECT_THAT(run(seconds(60)), IsEmpty()) << "one is shown";
  hear(5000);
  EXPECT_THAT(run(seconds(60)), ElementsAre(HasSubstr("nearest is 5000 m away")));
}

TEST_F(AoimWatchTest, ChecksAfterTenSecondsAndNeverWithCells) {
  SceneFile scene;
  scene.network.interop = true;
  begin(scene);
  EXPECT_THAT(run(seconds(9)), IsEmpty());
  static_cast<void>(manager_->sight().judge({3000, 0, 0}, 0.0, 1, false));
  EXPECT_THAT(run(seconds(2)), ElementsAre(HasSubstr("3000 m")));
  begin({});
  static_cast<void>(manager_->sight().judge({3000, 0, 0}, 0.0, 1, false));
  EXPECT_THAT(run(seconds(100)), IsEmpty());
}

TEST_F(AoimWatchTest, ReportsOnceThatNoPeerIsNear) {
  begin({});
  announce(2);
  EXPECT_THAT(run(seconds(9)), IsEmpty());
  run(seconds(2));  // no peer was present when the first interval began
  announce(2);
  EXPECT_THAT(run(seconds(65)), ElementsAre(HasSubstr("2 other peers have no entity within")));
  announce(2);
  EXPECT_THAT(run(seconds(120)), IsEmpty()) << "told already";
  begin({});
  announce(1);
  run(seconds(11));
  static_cast<void>(manager_->sight().judge({1, 0, 0}, 0.0, 1, false));
  announce(1);
  EXPECT_THAT(run(seconds(200)), IsEmpty()) << "one is shown, and rests";
}

TEST_F(AoimWatchTest, CountsOwnUpdatesThatWereRefused) {
  begin({});
  EXPECT_EQ(manager_->send(aoim::kEverybody, aoim::PduPayload{{}}, {}, now_),
            aoim::AddResult::refused_kind);
  run(milliseconds(50));
  EXPECT_EQ(count("updates_refused"), 1u);
}

TEST_F(AoimWatchTest, FitsEachSentenceIntoANotice) {
  SceneFile scene;
  scene.aoim.scheme = aoim::CellScheme::square;
  scene.aoim.cell = 0.123;
  scene.aoim.radius = 123456.7;
  scene.aoim.pool = 1000;
  scene.aoim.groups = 999;
  begin(scene);
  const auto told = run(seconds(1));
  ASSERT_EQ(told.size(), 1u);
  EXPECT_LT(told.front().size(), Notice{}.text.size() - 1);
}

}  // namespace
}  // namespace reckon::peer
