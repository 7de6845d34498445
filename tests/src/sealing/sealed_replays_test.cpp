// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Sealed links beside an attacker without the key who records and replays all datagrams; random, by
// seed.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <cstring>
#include <memory>
#include <random>
#include <string>
#include <tuple>
#include <unordered_set>
#include <utility>
#include <vector>

#include "reckon/peer/network/simulated_network.hpp"
#include "reckon/peer/sealing/sealed_link.hpp"
#include "reckon/tests/src/sealing/sealing_samples.hpp"
#include "reckon/tests/support/soak.hpp"

namespace reckon::peer::sealed_replays_test {
namespace {

using namespace samples;

std::uint64_t number_from(const char* variable, std::uint64_t otherwise) {
  const char* const text = std::getenv(variable);
  return text == nullptr ? otherwise : std::stoull(text);
}

std::uint32_t below(std::mt19937& random, std::uint32_t end) {
  return static_cast<std::uint32_t>(random() % end);
}

// The content of a datagram in these tests.
struct Word {
  std::uint32_t speaker = 0, number = 0;
  std::int64_t said_ns = 0;
};

// Sends words and checks the words that it receives.
class Speaker {
 public:
  Speaker(Link& link, const Clock& clock, const GroupKey& key, std::uint32_t name,
          nanoseconds one_way = 0ns)
      : clock_(clock), one_way_(one_way), sealed_(link, options(key, name), clock), name_(name) {
    sealed_.count_in(counters_);
    join(0);
  }

  void join(std::uint32_t group) {
    joined_[group] = clock_.now();
    EXPECT_FALSE(sealed_.join(group_of(group)));
  }
  void leave(std::uint32_t group) {
    joined_[group] = nanoseconds::max();
    sealed_.leave(group_of(group));
  }
  [[nodiscard]] bool is_in(std::uint32_t group) const {
    return joined_[group] != nanoseconds::max();
  }

  void say(std::uint32_t group) {
    const Word word{name_, ++said_, clock_.now().count()};
    EXPECT_TRUE(sealed_.send(group_of(group), std::as_bytes(std::span(&word, 1))));
  }

  void read() {
    std::array<Datagram, 32> batch;
    while (const std::size_t count = sealed_.receive(batch))
      for (std::size_t i = 0; i < count; ++i) judge(batch[i]);
  }

  /// When it first received a word of that speaker; 0 if never.
  [[nodiscard]] nanoseconds hears(std::uint32_t speaker) const { return first_[speaker]; }
  [[nodiscard]] std::uint64_t taken() const { return taken_; }
  [[nodiscard]] std::uint64_t count(std::string_view name) const {
    return counters_.find(name)->value();
  }

  static constexpr std::uint32_t kSpeakers = 16, kGroups = 4;

 private:
  static SealedLinkOptions options(const GroupKey& key, std::uint32_t name) {
    SealedLinkOptions out;
    out.key = key;
    out.base = group_of();
    out.application = static_cast<std::uint16_t>(name);
    return out;
  }

  // A word must arrive once, in a joined group, and be sent after the join, except for one-way
  // delay.
  void judge(const Datagram& datagram) {
    Word word;
    ASSERT_EQ(datagram.bytes.size(), sizeof word);
    std::memcpy(&word, datagram.bytes.data(), sizeof word);
    const std::uint32_t group = datagram.group.octets[3];
    ++taken_;
    ASSERT_LT(group, kGroups);
    ASSERT_TRUE(is_in(group));
    EXPECT_GE(nanoseconds(word.said_ns), joined_[group] - one_way_) << "of before it came";
    EXPECT_TRUE(heard_.insert(std::uint64_t{word.speaker} << 32 | word.number).second) << "again";
    nanoseconds& first = first_[word.speaker];
    if (first == nanoseconds(0)) first = clock_.now();
  }

  const Clock& clock_;
  nanoseconds one_way_;
  Counters counters_;
  SealedLink sealed_;
  std::uint32_t name_, said_ = 0;
  std::uint64_t taken_ = 0;
  std::array<nanoseconds, kGroups> joined_{
      {nanoseconds::max(), nanoseconds::max(), nanoseconds::max(), nanoseconds::max()}};
  std::array<nanoseconds, kSpeakers> first_{};
  std::unordered_set<std::uint64_t> heard_;
};

// Records all groups and replays from several addresses.
class Replayer {
 public:
  Replayer(SimulatedNetwork& hub, std::size_t first, std::size_t links) {
    for (std::size_t i = 0; i < links; ++i) links_.push_back(&hub.link(first + i));
    for (std::uint32_t group = 0; group < Speaker::kGroups; ++group)
      EXPECT_FALSE(links_[0]->join(group_of(group)));
  }
  void record() {
    std::array<Datagram, 64> batch;
    while (const std::size_t count = links_[0]->receive(batch))
      for (std::size_t i = 0; i < count; ++i)
        tape_.emplace_back(batch[i].group, Octets(batch[i].bytes.begin(), batch[i].bytes.end()));
    for (Link* link : links_)
      while (link != links_[0] && link->receive(batch) > 0) continue;
  }
  void forget_all_but(std::size_t last) {
    if (tape_.size() > last)
      tape_.erase(tape_.begin(), tape_.end() - static_cast<std::ptrdiff_t>(last));
  }
  /// Replays one of the latest `newest` datagrams, to its original group or to `to`.
  void send_one(std::mt19937& random, std::size_t newest, const GroupAddress* to) {
    if (tape_.empty()) return;
    const std::size_t from = tape_.size() - std::min(newest, tape_.size());
    const auto& [group, octets] = tape_[from + random() % (tape_.size() - from)];
    links_[random() % links_.size()]->send(to != nullptr ? *to : group, octets);
  }
  [[nodiscard]] const std::vector<std::pair<GroupAddress, Octets>>& tape() const { return tape_; }
  void take(const std::vector<std::pair<GroupAddress, Octets>>& other) {
    tape_.insert(tape_.end(), other.begin(), other.end());
  }

 private:
  std::vector<Link*> links_;
  std::vector<std::pair<GroupAddress, Octets>> tape_;
};

// An exercise with three groups besides the base group, which its members join and leave.
// RECKON_REPLAYS sets the number of replayed datagrams.
TEST(SealedReplays, AreRefusedAtAnyTimeAndPlace) {
  constexpr std::size_t kMembers = 4, kAddresses = 4;
  const std::uint64_t wanted = number_from("RECKON_REPLAYS", 40'000);
  std::mt19937 random(static_cast<std::uint32_t>(number_from("RECKON_SEED", 1)));
  ManualClock clock{1s};
  SimulatedNetwork hub({.links = kMembers + kAddresses, .datagrams_in_flight = 8192}, clock);
  const GroupKey key = group_key(1, fast_suite());
  std::vector<std::unique_ptr<Speaker>> members;
  for (std::uint32_t i = 0; i < kMembers; ++i)
    members.push_back(std::make_unique<Speaker>(hub.link(i), clock, key, i));
  Replayer replayer(hub, kMembers, kAddresses);

  std::uint64_t sent = 0;
  for (int step = 0; sent < wanted; ++step) {
    for (auto& member : members) {
      if (random() % 10 == 0) member->say(below(random, Speaker::kGroups));
      const std::uint32_t group = 1 + below(random, Speaker::kGroups - 1);
      if (random() % 200 == 0) member->is_in(group) ? member->leave(group) : member->join(group);
      member->read();
    }
    replayer.record();
    replayer.forget_all_but(20'000);
    for (int i = 0; step > 500 && i < 50; ++i, ++sent) {
      const std::array<GroupAddress, 5> places = {group_of(0), group_of(1), group_of(2),
                                                  group_of(3),
                                                  hub.link(random() % kMembers).local_endpoint()};
      const std::size_t newest = std::size_t{1} << below(random, 15);
      replayer.send_one(random, newest, random() % 2 == 0 ? nullptr : &places[random() % 5]);
    }
    clock.advance(1ms);
    if (HasFailure()) return;
  }
  std::uint64_t taken = 0;
  for (auto& member : members) {
    taken += member->taken();
    EXPECT_GT(member->count("sealed_replayed_in"), 0U);
    EXPECT_GT(member->count("sealed_forged_in"), 0U) << "of another group";
    EXPECT_EQ(member->count("sealed_trusted"), kMembers - 1);
    // A datagram that opens moves a window. Such datagrams are: taken words, greetings, and words
    // that did not fit the held ones.
    EXPECT_EQ(member->count("sealed_in"), member->taken() + member->count("sealed_hellos_in") +
                                              member->count("sealed_held_lost"));
  }
  EXPECT_GT(taken, 1000U) << "genuine ones";
  RecordProperty("replays", static_cast<int>(sent));
}

// A recording of earlier days.
std::vector<std::pair<GroupAddress, Octets>> yesterday(const GroupKey& key, std::mt19937& random) {
  ManualClock clock{1s};
  SimulatedNetwork hub({.links = 4}, clock);
  Replayer recorder(hub, 3, 1);
  std::vector<std::unique_ptr<Speaker>> boots;
  for (std::uint32_t days = 1 + below(random, 4); days > 0; --days) {
    boots.clear();
    for (std::uint32_t i = 0; i < 3; ++i)
      boots.push_back(std::make_unique<Speaker>(hub.link(i), clock, key, i));
    for (int i = 0; i < 100; ++i) {
      for (auto& boot : boots) {
        if (i % 10 == 0) boot->say(0);
        boot->read();
      }
      recorder.record();
      clock.advance(1ms);
    }
  }
  return recorder.tape();
}

// A newcomer joins members while recordings of today and of other days are replayed.
void come_late(std::uint32_t seed, const GroupKey& key) {
  SCOPED_TRACE("seed " + std::to_string(seed));
  std::mt19937 random(seed);
  const std::uint32_t count = 1 + below(random, 5), addresses = 1 + below(random, 6);
  const nanoseconds one_way = std::chrono::microseconds(200 + below(random, 40'000));
  const std::uint32_t pace = 5 + below(random, 45);   // interval between two words of a member [ms]
  const std::uint32_t attack = 1 + below(random, 8);  // replayed datagrams a millisecond
  ManualClock clock{std::chrono::seconds(1 + below(random, 1000))};
  SimulatedNetwork hub({.links = count + 1 + addresses, .datagrams_in_flight = 8192}, clock);
  ImpairmentLaw law;
  law.delay = one_way;
  hub.impair(law);
  std::vector<std::unique_ptr<Speaker>> all;
  for (std::uint32_t i = 0; i < count; ++i)
    all.push_back(std::make_unique<Speaker>(hub.link(i), clock, key, i, one_way));
  Replayer replayer(hub, count + 1, addresses);
  if (random() % 2 == 0) replayer.take(yesterday(key, random));
  const nanoseconds begin = clock.now() + std::chrono::milliseconds(200 + below(random, 1500));
  const nanoseconds end = begin + 200ms + 2 * one_way;
  while (clock.now() <= end) {
    if (clock.now() >= begin && all.size() == count)
      all.push_back(std::make_unique<Speaker>(hub.link(count), clock, key, count, one_way));
    for (auto& one : all) {
      if (clock.now() / 1ms % pace == 0) one->say(0);
      one->read();
    }
    replayer.record();
    for (std::uint32_t i = 0; i < attack; ++i)
      replayer.send_one(random, std::size_t{1} << below(random, 14), nullptr);
    clock.advance(1ms);
  }
  for (std::uint32_t i = 0; i < count; ++i) {
    EXPECT_GT(all.back()->hears(i), 0s) << "the newcomer hears no " << i;
    EXPECT_GT(all[i]->hears(count), 0s) << i << " hears no newcomer";
  }
}

// All members receive the newcomer, and it receives all, within 0.2 s and a round trip. No recorded
// word is taken.
TEST(SealedReplays, DoNotDelayANewcomer) {
  const GroupKey key = group_key();
  const std::uint64_t seeds = number_from("RECKON_SEEDS", test::tries(200, 1000));
  for (std::uint32_t seed = 1; seed <= seeds && !testing::Test::HasFailure(); ++seed)
    come_late(seed, key);
}

}  // namespace
}  // namespace reckon::peer::sealed_replays_test
