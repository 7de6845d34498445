// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/peer/peer_threads.hpp"

#include <gtest/gtest.h>
#include <pthread.h>
#include <sys/resource.h>

#include <atomic>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <memory>
#include <set>
#include <string>
#include <system_error>
#include <thread>
#include <vector>

#include "reckon/haptics/devices/haptic_device.hpp"
#include "reckon/peer/threads/thread_name.hpp"
#include "reckon/tests/src/support/manual_link.hpp"

namespace reckon::peer::peer_threads_test {
namespace {

using namespace std::chrono_literals;
using std::chrono::nanoseconds;

const SteadyClock kClock;

constexpr std::string_view kScene = R"(
[scene]
name = "one hand in the air"
origin = {latitude = "47.05 deg", longitude = "8.31 deg", height = "430 m"}
[hand]
radius = "10 mm"
[aoim]
pool = 16
)";

// A hand whose position the test sets.
class PlacedHand final : public haptics::HapticDevice {
 public:
  std::atomic<double> x{0};  // [m]

  [[nodiscard]] haptics::DeviceLimits limits() const noexcept override {
    haptics::DeviceLimits limits;
    limits.max_force = limits.damping = 1;
    return limits;
  }
  [[nodiscard]] haptics::DeviceSample read(nanoseconds) noexcept override {
    haptics::DeviceSample sample;
    sample.ok = true;
    sample.position.x() = x;
    return sample;
  }
  void write(const Eigen::Vector3d&, nanoseconds) noexcept override {}
};

// A peer on a link that only the test drives.
struct Place {
  explicit Place(std::uint16_t application = 1, std::size_t ring = std::size_t{2} << 20)
      : scene(parse_scene_file(kScene, "test scene")),
        peer(scene, {.application = application, .epoch = 1u + application, .datagram_ring = ring},
             link, hand) {
    peer.start(kClock.now());
  }

  SceneFile scene;
  test::ManualLink link;
  PlacedHand hand;
  Peer peer;
};

// The link's wait() ends only when it is woken: a command without a wake would hang here.
TEST(PeerThreads, JoinsGroupsOfANewPlaceWithoutTimeout) {
  Place place;
  PeerThreads threads(place.peer, kClock, {});
  ASSERT_TRUE(place.link.settled(2, 1));  // base group and a cell; a presence
  const std::size_t joins = place.link.joins();
  place.hand.x = 1000;
  EXPECT_TRUE(place.link.settled(joins + 1, 1));
}

// The ring holds a hundredth of the data: reading has to wait for room many times.
TEST(PeerThreads, ReadsAllArrivalsThroughASmallRing) {
  Place place(1, std::size_t{64} << 10);
  for (int i = 0; i < 20'000; ++i) {
    std::vector<std::byte> octets(200 + i % 1000);  // of the exercise, but of no use
    octets[0] = std::byte{7};
    octets[1] = static_cast<std::byte>(place.scene.network.exercise);
    octets[9] = std::byte{12};
    place.link.put(place.scene.network.group, octets);
  }
  PeerThreads threads(place.peer, kClock, {});
  EXPECT_TRUE(place.link.settled(2, 1));
  threads.stop();
  EXPECT_EQ(place.peer.counters().find("datagrams_in")->value(), 20'000u);
  EXPECT_GT(place.peer.counters().find("read_waits")->value(), 10u);
  place.peer.model_step(kClock.now(), kClock.utc_now());  // processes the rest of the ring
  EXPECT_FALSE(place.peer.has_inbound());
}

// Nothing arrives, no group changes and the hand does not move: threads wake only to check that now
// and then.
TEST(PeerThreads, LeaveAQuietLinkAlone) {
  Place place;
  PeerThreads threads(place.peer, kClock, {});
  ASSERT_TRUE(place.link.settled(2, 2));  // the second presence follows a second later
  std::this_thread::sleep_for(200ms);
  const std::size_t waits = place.link.waits();
  const std::uint64_t steps = threads.servo_duty().steps();
  std::this_thread::sleep_for(300ms);
  const std::uint64_t more = threads.servo_duty().steps() - steps;
  EXPECT_GT(more, 0u);
  EXPECT_LE(place.link.waits(), waits + 5 + more / 5);
}

// While nothing can be felt one thread does all the work. An arrival that may be felt must not wait
// for its next pass.
TEST(PeerThreads, ReadInTheirOwnThreadNearABody) {
  Place here(1), there(2);
  here.link.connect(there.link);
  there.link.connect(here.link);
  there.hand.x = 1000;
  PeerThreads threads(here.peer, kClock, {}), others(there.peer, kClock, {});
  const auto is_read_by = [&](auto&& wanted) {
    for (int tries = 0; tries < 2000; ++tries) {
      if (wanted(here.link.reader())) return true;
      std::this_thread::sleep_for(5ms);  // waits for real threads
    }
    return false;
  };
  ASSERT_TRUE(here.link.settled(1, 1));
  const std::thread::id model = here.link.reader();
  there.hand.x = 0.1;
  EXPECT_TRUE(is_read_by([&](std::thread::id reader) { return reader != model; }));
  there.hand.x = 1000;
  EXPECT_TRUE(is_read_by([&](std::thread::id reader) { return reader == model; }));
}

// The fastest device paces the others: 700 Hz does not divide 1 kHz, yet 700 steps a second are
// made.
TEST(Peer, KeepsTheRateOfASlowerDevice) {
  const SceneFile scene = parse_scene_file(kScene, "test scene");
  test::ManualLink link;
  PlacedHand hands[3];
  std::vector<PeerDevice> devices(3);
  for (std::size_t i = 0; i < 3; ++i) devices[i].device = &hands[i];
  devices[1].period = nanoseconds(1'428'571);
  devices[2].period = 4ms;
  Peer peer(scene, {}, link, devices);
  haptics::TraceRing rings[3]{haptics::TraceRing(1024), haptics::TraceRing(1024),
                              haptics::TraceRing(1024)};
  for (std::size_t i = 0; i < 3; ++i) peer.trace(&rings[i], i);
  for (auto now = 1000ms; now < 2000ms; now += 1ms) peer.servo_step(now);
  const double rates[3]{1000, 700, 250};
  for (std::size_t i = 0; i < 3; ++i) {
    haptics::ServoSnapshot step;
    double steps = 0;
    while (rings[i].pop(step)) ++steps;
    EXPECT_NEAR(steps, rates[i], 1.0) << i;
  }
  peer.servo_step_of(1, 2000ms);
  haptics::ServoSnapshot step;
  EXPECT_FALSE(rings[0].pop(step));
  ASSERT_TRUE(rings[1].pop(step)) << "it alone, due or not";
  EXPECT_EQ(step.time, 2000ms);
}

/// Names of all threads of this process, as `ps -L` shows them.
std::multiset<std::string> names_of_threads() {
  std::multiset<std::string> names;
  for (const auto& task : std::filesystem::directory_iterator("/proc/self/task")) {
    std::ifstream file(task.path() / "comm");
    std::string name;
    if (std::getline(file, name)) names.insert(name);
  }
  return names;
}

TEST(PeerThreads, HaveNamesOfTheirLoopAndTheirPeer) {
  Place first(1), last(65'535);
  PeerThreads threads(first.peer, kClock, {});
  ServoThread servo(kClock);
  PeerThreadsOptions shared;
  shared.servo = &servo;
  PeerThreads others(last.peer, kClock, shared);
  const std::multiset<std::string> names = names_of_threads();
  for (const char* name : {"rk-servo 1", "rk-read 1", "rk-write 1", "rk-model 1", "rk-servo",
                           "rk-read 65535", "rk-write 65535", "rk-model 65535"})
    EXPECT_EQ(names.count(name), 1u) << name;
  EXPECT_EQ(names.count("rk-pulse"), 2u) << "one a servo thread";
}

TEST(ThreadName, IsCutWhereTheSystemTakesNoMore) {
  name_thread(pthread_self(), "a name of twenty-six bytes");
  EXPECT_EQ(names_of_threads().count("a name of twent"), 1u);
  name_thread(pthread_self(), "peer_tests");
}

TEST(PeerThreads, ShareOneServoThread) {
  ServoThread servo(kClock);
  std::vector<std::unique_ptr<Place>> places;
  std::vector<std::unique_ptr<PeerThreads>> threads;
  PeerThreadsOptions options;
  options.servo = &servo;
  for (std::uint16_t i = 1; i <= 8; ++i) {
    places.push_back(std::make_unique<Place>(i));
    threads.push_back(std::make_unique<PeerThreads>(places.back()->peer, kClock, options));
  }
  for (auto& place : places) EXPECT_TRUE(place->link.settled(2, 1));
  // Groups are joined without a servo step, which may be a period away.
  const nanoseconds late = kClock.now() + 10s;
  for (auto& each : threads) {
    while (each->servo_duty().steps() == 0 && kClock.now() < late) std::this_thread::yield();
    each->stop();
    EXPECT_EQ(each->servo(), &servo);
    EXPECT_EQ(each->real_time(), servo.real_time());
    EXPECT_GT(each->servo_duty().steps(), 0u);
  }
}

#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
std::size_t address_space() {
  std::size_t pages = 0;
  std::ifstream("/proc/self/statm") >> pages;
  return pages * 4096;
}

// Runs in a child process: stacks of 256 MiB, with room for exactly `stacks` of them.
void start_with_room_for(std::size_t stacks) {
  constexpr std::size_t kStack = std::size_t{256} << 20;
  Place place;
  pthread_attr_t attributes;
  pthread_attr_init(&attributes);
  pthread_attr_setstacksize(&attributes, kStack);
  pthread_setattr_default_np(&attributes);
  const rlim_t room = address_space() + stacks * kStack + kStack / 2;
  const rlimit limit{room, room};
  setrlimit(RLIMIT_AS, &limit);
  try {
    PeerThreads threads(place.peer, kClock, {.lock_memory = false});
  } catch (const std::system_error& error) {
    std::fprintf(stderr, "refused: %s", error.what());
    std::_Exit(3);
  }
  std::_Exit(0);
}

TEST(PeerThreadsDeathTest, StopRunningThreadsWhereOneCannotStart) {
  GTEST_FLAG_SET(death_test_style, "threadsafe");
  for (const std::size_t stacks : {0, 1, 2, 3}) {
    EXPECT_EXIT(start_with_room_for(stacks), ::testing::ExitedWithCode(3),
                "refused: a thread of the peer cannot be started; raise ulimit -u");
  }
  EXPECT_EXIT(start_with_room_for(5), ::testing::ExitedWithCode(0), "");
}
#endif

}  // namespace
}  // namespace reckon::peer::peer_threads_test
