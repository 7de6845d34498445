// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// A quiet peer on a network that loses datagrams, and relays that repeat its announcements from
// addresses of their own. They receive all; the listener receives all of their datagrams.
#include <gtest/gtest.h>

#include <map>
#include <optional>
#include <random>
#include <set>
#include <string>
#include <vector>

#include "reckon/tests/aoim/support/segment.hpp"

namespace reckon::aoim {
namespace {

using namespace test;
using std::chrono::microseconds;

constexpr std::uint32_t kLife = 101, kNextLife = 102;
constexpr nanoseconds kLook = milliseconds(100);

struct Attack {
  double loss = 0.0;
  nanoseconds relay = microseconds(200);  // from the victim by the relay to the listener
  std::size_t relays = 1;
  double drift = 0.0;  // of the victim's clock
  double rate = 0.0;   // of the victim's states [1/s]
  std::uint64_t seed = 1;
};

class Street {
 public:
  explicit Street(const Attack& attack) : attack_(attack), random_(attack.seed) {
    restart(kLife);
    listener_ = peer(presence_of(2, 202), source(9));
  }

  void begin_with_the_victim_alone() {
    relays_live = false;
    run(seconds(5));
    relays_live = true;
  }
  void restart(std::uint32_t epoch) {
    epoch_ = epoch;
    victim_ = peer(presence_of(1, epoch, epoch), home_);
  }
  void move(const SourceAddress& to) {
    home_ = to;
    victim_->note_own_source(to, clock());
    lost_ = 0;
  }
  void run(nanoseconds length) {
    for (const nanoseconds end = now_ + length; now_ < end; now_ += milliseconds(1)) step();
  }
  // Samples the listener ten times a second. @return samples that have the victim at a relay's
  // address
  std::size_t look(std::size_t looks) {
    std::size_t elsewhere = 0;
    for (std::size_t i = 0; i < looks; ++i) {
      run(kLook);
      for (const std::uint32_t epoch : {kLife, kNextLife}) {
        const auto at = listener_->source_of(epoch);
        elsewhere += at && is_relay(*at) ? 1 : 0;
      }
    }
    return elsewhere;
  }
  // Time until the listener has the victim at its address; at most 30 s.
  nanoseconds known_after() {
    const nanoseconds begin = now_;
    while (listener_->source_of(epoch_) != home_ && now_ - begin < seconds(30))
      run(milliseconds(1));
    return now_ - begin;
  }

  static SourceAddress relay(std::size_t i) {
    return source(static_cast<std::uint8_t>(100 + i % 100), static_cast<std::uint16_t>(6000 + i));
  }
  static bool is_relay(const SourceAddress& at) { return at.port >= 6000; }

  bool relays_live = true, victim_reaches = true, is_touched = false, replays = false,
       listener_stands = false;
  std::set<SourceAddress> accused;
  std::size_t moves = 0, gone = 0;
  std::size_t lost() const { return lost_; }
  Presence& listener() { return *listener_; }

 private:
  struct Flight {
    pdu::Presence said;
    SourceAddress from;
    bool is_state;
  };

  std::unique_ptr<Presence> peer(const pdu::Presence& own, const SourceAddress& at) {
    PresenceConfig config;
    config.one_way = scrambled;
    config.keyed_hash = scrambled_with;
    config.secret[0] = static_cast<std::uint8_t>(own.epoch);
    auto made = std::make_unique<Presence>(config, own);
    made->note_own_source(at, clock());
    made->start(clock());
    return made;
  }
  nanoseconds clock() const {
    return now_ + nanoseconds(static_cast<std::int64_t>(attack_.drift * double(now_.count())));
  }
  double drawn() { return std::uniform_real_distribution<double>(0, 1)(random_); }

  // 0.2 to 3 ms; every tenth datagram is duplicated.
  void send(const pdu::Presence& said, bool is_state) {
    const auto path = [&] { return now_ + microseconds(200 + random_() % 2800); };
    const bool is_lost = !victim_reaches || drawn() < attack_.loss;
    if (is_lost && !is_state) ++lost_;
    if (!is_lost) flights_.emplace(path(), Flight{said, home_, is_state});
    if (!is_lost && drawn() < 0.1) flights_.emplace(path(), Flight{said, home_, is_state});
    if (!relays_live) return;
    for (std::size_t i = 0; i < attack_.relays; ++i)
      flights_.emplace(now_ + attack_.relay, Flight{said, relay(i), is_state});
    if (is_state) return;
    recorded_.push_back(said);
    if (replays)
      flights_.emplace(path(), Flight{recorded_[random_() % recorded_.size()], relay(0), false});
  }
  void step() {
    while (!listener_stands && !flights_.empty() && flights_.begin()->first <= now_) {
      deliver(flights_.begin()->second);
      flights_.erase(flights_.begin());
    }
    for (const pdu::Presence& said : victim_->step(clock())) send(said, false);
    if (attack_.rate > 0 && drawn() < 0.001 * attack_.rate) send(presence_of(1, epoch_), true);
    if (listener_stands) return;
    if (is_touched) listener_->note_touched(epoch_, now_);
    (void)listener_->step(now_);
    for (const PresenceEvent& event : listener_->take_events()) {
      if (event.kind == Kind::impostor) accused.insert(event.other);
      moves += event.kind == Kind::moved ? 1 : 0;
      gone += event.kind == Kind::timed_out || event.kind == Kind::departed ? 1 : 0;
    }
  }
  void deliver(const Flight& flight) {
    const std::uint32_t epoch = flight.said.epoch;
    const Standing standing = listener_->standing(epoch, &flight.from);
    if (standing == Standing::member) listener_->note_alive(epoch, now_);
    if (standing == Standing::impostor) listener_->note_impostor(epoch, flight.from, now_);
    if (!flight.is_state) listener_->receive(flight.said, now_, flight.from);
  }

  Attack attack_;
  std::mt19937_64 random_;
  nanoseconds now_ = seconds(1000);
  SourceAddress home_ = source(1);
  std::uint32_t epoch_ = kLife;
  std::unique_ptr<Presence> victim_, listener_;
  std::multimap<nanoseconds, Flight> flights_;
  std::vector<pdu::Presence> recorded_;
  std::size_t lost_ = 0;
};

std::string attack_name(const testing::TestParamInfo<Attack>& info) {
  return "Case" + std::to_string(info.index);
}

class Relays : public testing::TestWithParam<Attack> {
 protected:
  static void expect_no_theft(Street& street, std::size_t looks) {
    EXPECT_EQ(street.look(looks), 0u) << "shown elsewhere";
    for (const SourceAddress& at : street.accused)
      EXPECT_TRUE(Street::is_relay(at)) << "the genuine one was called the impostor";
    EXPECT_EQ(street.moves, 0u);
    EXPECT_EQ(street.gone, 0u);
  }
};

TEST_P(Relays, DoNotMoveAQuietPeer) {
  Street street(GetParam());
  street.begin_with_the_victim_alone();
  expect_no_theft(street, 600);
  EXPECT_FALSE(street.accused.empty()) << "the relay is reported";
}

TEST_P(Relays, ReplaysProveNothing) {
  Street street(GetParam());
  street.begin_with_the_victim_alone();
  street.replays = true;
  expect_no_theft(street, 600);
}

// The listener receives the relay's first announcement only.
TEST_P(Relays, FirstReceivedRelayIsDisplaced) {
  Attack attack = GetParam();
  attack.relays = std::min<std::size_t>(attack.relays, 2);  // each additional one takes a share
  Street street(attack);
  street.victim_reaches = false;
  street.run(milliseconds(100));
  ASSERT_TRUE(Street::is_relay(street.listener().source_of(kLife).value()));
  street.victim_reaches = true;
  const nanoseconds after = street.known_after();
  EXPECT_LE(after, milliseconds(2200) + seconds(1) * street.lost());
  EXPECT_EQ(street.look(600), 0u);
  EXPECT_FALSE(street.accused.contains(source(1)));
}

TEST_P(Relays, RestartUnderARelayBelongsToTheOwner) {
  Attack attack = GetParam();
  attack.relays = std::min<std::size_t>(attack.relays, 2);
  Street street(attack);
  street.run(seconds(5));
  (void)street.known_after();
  street.restart(kNextLife);
  EXPECT_EQ(street.look(670), 0u);
  EXPECT_EQ(street.listener().source_of(kNextLife), source(1));
  EXPECT_FALSE(street.accused.contains(source(1)));
}

TEST_P(Relays, SuspendedListenerIsNotDeceived) {
  Street street(GetParam());
  street.begin_with_the_victim_alone();
  for (int i = 0; i < 5; ++i) {
    street.listener_stands = true;
    street.run(seconds(10));
    street.listener_stands = false;
    expect_no_theft(street, 40);
  }
}

TEST_P(Relays, DoNotMoveAHandInContact) {
  Attack attack = GetParam();
  attack.rate = 30;
  Street street(attack);
  street.is_touched = true;
  street.begin_with_the_victim_alone();
  expect_no_theft(street, 600);
}

TEST_P(Relays, HonestChangeUnderARelayIsAccepted) {
  Attack attack = GetParam();
  attack.relays = std::min<std::size_t>(attack.relays, 2);
  Street street(attack);
  street.run(seconds(5));
  for (std::uint8_t i = 0; i < 10; ++i) {
    street.run(milliseconds(3000 + 137 * i));
    street.move(source(static_cast<std::uint8_t>(10 + i)));
    EXPECT_LE(street.known_after(), seconds(2) + seconds(1) * street.lost());
  }
  for (const SourceAddress& at : street.accused) EXPECT_TRUE(Street::is_relay(at));
}

INSTANTIATE_TEST_SUITE_P(Relays, Relays,
                         testing::Values(Attack{}, Attack{0.01, microseconds(50), 1, 0, 0, 2},
                                         Attack{0.1, microseconds(50), 1, 1e-3, 0, 3},
                                         Attack{0.1, microseconds(5000), 2, -1e-3, 0, 4},
                                         Attack{0.3, microseconds(50), 2, 0, 0, 5},
                                         Attack{0.3, microseconds(5000), 1, 1e-3, 0, 6},
                                         Attack{0.3, microseconds(1000), 40, -1e-3, 0, 7}),
                         attack_name);

class HonestChange : public testing::TestWithParam<Attack> {};

TEST_P(HonestChange, IsAcceptedWhenItsKeyIsRevealed) {
  Attack attack = GetParam();
  attack.relays = 0;
  nanoseconds longest{0};
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    SCOPED_TRACE(seed);
    attack.seed = seed;
    Street street(attack);
    street.run(seconds(5));
    for (std::uint8_t i = 0; i < 20; ++i) {
      street.run(milliseconds(2500 + 131 * i));
      street.move(source(static_cast<std::uint8_t>(10 + i)));
      const nanoseconds after = street.known_after();
      longest = std::max(longest, after);
      EXPECT_LE(after, seconds(2) + seconds(1) * street.lost());
    }
    EXPECT_TRUE(street.accused.empty());
    EXPECT_EQ(street.gone, 0u);
  }
  RecordProperty("longest_ms", std::to_string(longest / milliseconds(1)));
}

TEST_P(HonestChange, TakesHalfASecondInContact) {
  Attack attack = GetParam();
  attack.relays = 0;
  attack.rate = 60;
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    SCOPED_TRACE(seed);
    attack.seed = seed;
    Street street(attack);
    street.is_touched = true;
    street.run(seconds(5));
    for (std::uint8_t i = 0; i < 20; ++i) {
      street.run(milliseconds(2500 + 131 * i));
      street.move(source(static_cast<std::uint8_t>(10 + i)));
      const nanoseconds after = street.known_after();
      EXPECT_LE(after, street.lost() < 3 ? nanoseconds(milliseconds(500))
                                         : seconds(2) + seconds(1) * street.lost());
    }
    street.run(seconds(10));
    EXPECT_TRUE(attack.loss > 0.0 || street.moves == 20) << "each is confirmed";
    EXPECT_TRUE(street.accused.empty());
  }
}

INSTANTIATE_TEST_SUITE_P(Losses, HonestChange,
                         testing::Values(Attack{0.0}, Attack{0.1}, Attack{0.3}), attack_name);

// The relay takes over a hand in contact whose owner is cut off: briefly and once.
TEST(MoveOnApproval, IsUndoneWhenTheKeyRefutesIt) {
  Street street({.rate = 30});
  street.is_touched = true;
  street.begin_with_the_victim_alone();
  street.victim_reaches = false;
  const std::size_t elsewhere = street.look(50);
  EXPECT_GT(elsewhere, 5u);
  EXPECT_LE(elsewhere, 20u);
  EXPECT_EQ(street.accused.size(), 1u);
  street.victim_reaches = true;
  EXPECT_LE(street.known_after(), milliseconds(1100));
}

TEST(MoveOnApproval, EndsWhenTheOldAddressSendsAgain) {
  Street street({.rate = 30});
  street.is_touched = true;
  street.begin_with_the_victim_alone();
  street.victim_reaches = false;
  for (int ms = 0; street.moves == 0 && ms < 3000; ++ms) street.run(milliseconds(1));
  ASSERT_EQ(street.moves, 1u);
  street.victim_reaches = true;
  EXPECT_LE(street.known_after(), milliseconds(400));
}

}  // namespace
}  // namespace reckon::aoim
