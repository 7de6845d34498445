// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Cost of a datagram for a whole peer with all its threads and wake-ups, beside a bare thread that
// blocks in recvmmsg and ignores the data. Both receive the same datagrams of nine updates on
// loopback, in a network namespace of its own (needs root), in alternation. CPU of threads from the
// kernel's accounting; the cost of a peer without traffic is subtracted and reported in a column of
// its own.
#include <benchmark/benchmark.h>
#include <net/if.h>
#include <pthread.h>
#include <sched.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <exception>
#include <filesystem>
#include <fstream>
#include <memory>
#include <optional>
#include <stop_token>
#include <string>
#include <thread>
#include <vector>

#include "reckon/bench/micro/blocks.hpp"
#include "reckon/bench/micro/transport_ways.hpp"
#include "reckon/bench/studies/latency/stepped_hand.hpp"
#include "reckon/deadreckon/wire_conversion.hpp"
#include "reckon/pdu/codec/codec.hpp"
#include "reckon/pdu/timestamp.hpp"
#include "reckon/peer/joined_peer.hpp"
#include "reckon/peer/threads/servo_thread.hpp"

namespace reckon::peer {
namespace {

using std::chrono::milliseconds;
using std::chrono::nanoseconds;

constexpr nanoseconds kTurn = milliseconds(500);
constexpr nanoseconds kIntroduction = milliseconds(50);  // of all entities: allocates the rows once
constexpr std::string_view kScene =
    "[scene]\norigin = {latitude = \"47 deg\", longitude = \"8 deg\", height = \"430 m\"}\n"
    "[network]\ninterop = true\ngroup = \"239.192.79.7\"\nport = 3107\n"
    "[aoim]\nradius = \"100 km\"\ncell = \"10 km\"\n";

/// CPU time so far [ns] of the threads of this process whose names begin with `prefix`.
double cpu_of_threads(std::string_view prefix) {
  double sum = 0;
  for (const auto& entry : std::filesystem::directory_iterator("/proc/self/task")) {
    std::string name;
    std::getline(std::ifstream(entry.path() / "comm"), name);
    double spent = 0;
    if (name.starts_with(prefix)) std::ifstream(entry.path() / "schedstat") >> spent;
    sum += spent;
  }
  return sum;
}

/// Datagrams of nine Entity States, of 1,000 entities in turn, sent at an even pace by eight hosts:
/// a peer would mute a single host with that rate.
class Traffic {
 public:
  explicit Traffic(const SceneFile& scene)
      : frame_(scene.origin.latitude, scene.origin.longitude, scene.origin.height),
        exercise_(scene.network.exercise) {
    const GroupAddress& group = scene.network.group;
    to_.sin_family = AF_INET;
    to_.sin_port = htons(group.port);
    std::copy_n(group.octets.begin(), 4, reinterpret_cast<std::uint8_t*>(&to_.sin_addr));
    for (std::uint32_t i = 0; i < sockets_.size(); ++i) {
      sockets_[i] = socket(AF_INET, SOCK_DGRAM, 0);
      sockaddr_in from{};
      from.sin_family = AF_INET;
      from.sin_addr.s_addr = htonl(0x7f000002u + i);
      check(bind(sockets_[i], reinterpret_cast<sockaddr*>(&from), sizeof from) == 0, "bind");
      const ip_mreqn out{{}, {}, static_cast<int>(if_nametoindex("lo"))};
      check(setsockopt(sockets_[i], IPPROTO_IP, IP_MULTICAST_IF, &out, sizeof out) == 0,
            "multicast if");
    }
  }
  ~Traffic() { std::ranges::for_each(sockets_, close); }
  Traffic(const Traffic&) = delete;
  Traffic& operator=(const Traffic&) = delete;

  /// Sends for `length`; returns the number of datagrams.
  std::size_t send(double per_second, nanoseconds length) {
    const auto gap =
        std::chrono::duration_cast<nanoseconds>(std::chrono::duration<double>(1 / per_second));
    const auto begin = std::chrono::steady_clock::now();
    std::size_t count = 0;
    for (nanoseconds due{0}; due < length; due += gap, ++count) {
      std::this_thread::sleep_until(begin + due);
      send_next(sockets_[count % sockets_.size()]);
    }
    return count;
  }

 private:
  void send_next(int from) {
    std::array<std::byte, kPerDatagram * kUpdate> octets;
    for (std::size_t i = 0; i < kPerDatagram; ++i) {
      deadreckon::KinematicState at;
      at.algorithm = pdu::DeadReckoningAlgorithm::fpw;
      at.position = {10.0 * (next_ % 32), 10.0 * (next_ / 32), 0};
      at.velocity = {10, 0, 0};
      pdu::EntityState state;
      state.header.exercise_id = exercise_;
      state.header.timestamp = pdu::to_dis_timestamp(SteadyClock().utc_now(), true);
      state.entity_id = {7, 1, static_cast<std::uint16_t>(next_ + 1)};
      state.entity_type = {pdu::EntityKind::platform, pdu::EntityDomain::air};
      check(deadreckon::to_wire(at, frame_, state) == deadreckon::ConversionError::none, "to_wire");
      check(pdu::encode(state, std::span(octets).subspan(i * kUpdate, kUpdate)) == kUpdate,
            "encode");
      next_ = static_cast<std::uint16_t>((next_ + 1) % kEntities);
    }
    sendto(from, octets.data(), octets.size(), 0, reinterpret_cast<sockaddr*>(&to_), sizeof to_);
  }

  deadreckon::LocalFrame frame_;
  std::uint8_t exercise_;
  std::array<int, 8> sockets_{};
  sockaddr_in to_{};
  std::uint16_t next_ = 0;
};

/// A thread in recvmmsg.
class BareReceiver {
 public:
  explicit BareReceiver(const SceneFile& scene) {
    socket_ = socket(AF_INET, SOCK_DGRAM, 0);
    const int one = 1, room = kBuffer;
    setsockopt(socket_, SOL_SOCKET, SO_REUSEADDR, &one, sizeof one);
    setsockopt(socket_, SOL_SOCKET, SO_RCVBUFFORCE, &room, sizeof room);
    const timeval patience{0, 50'000};
    setsockopt(socket_, SOL_SOCKET, SO_RCVTIMEO, &patience, sizeof patience);
    sockaddr_in at{};
    at.sin_family = AF_INET;
    at.sin_port = htons(scene.network.group.port);
    std::copy_n(scene.network.group.octets.begin(), 4,
                reinterpret_cast<std::uint8_t*>(&at.sin_addr));
    check(bind(socket_, reinterpret_cast<sockaddr*>(&at), sizeof at) == 0, "bind");
    const ip_mreqn in{at.sin_addr, {}, static_cast<int>(if_nametoindex("lo"))};
    check(setsockopt(socket_, IPPROTO_IP, IP_ADD_MEMBERSHIP, &in, sizeof in) == 0, "join");
    thread_ = std::thread([this] { receive(); });
    pthread_setname_np(thread_.native_handle(), "bare");
  }
  ~BareReceiver() {
    stop_ = true;
    thread_.join();
    close(socket_);
  }
  BareReceiver(const BareReceiver&) = delete;
  BareReceiver& operator=(const BareReceiver&) = delete;

  [[nodiscard]] std::size_t received() const { return received_; }

 private:
  void receive() {
    std::vector<std::array<std::byte, 2048>> buffers(kDatagrams);
    std::array<iovec, kDatagrams> vectors{};
    std::array<mmsghdr, kDatagrams> messages{};
    for (std::size_t i = 0; i < kDatagrams; ++i) {
      vectors[i] = {buffers[i].data(), buffers[i].size()};
      messages[i].msg_hdr.msg_iov = &vectors[i];
      messages[i].msg_hdr.msg_iovlen = 1;
    }
    while (!stop_) {
      const int got = recvmmsg(socket_, messages.data(), kDatagrams, MSG_WAITFORONE, nullptr);
      if (got > 0) received_ += static_cast<std::size_t>(got);
    }
  }

  int socket_;
  std::atomic<bool> stop_{false};
  std::atomic<std::size_t> received_{0};
  std::thread thread_;
};

/// Objects near the peers under test.
enum class Near : std::uint8_t {
  no_device,  ///< one peer without a device
  nothing,    ///< one peer with a device far from everything
  each_other  ///< two peers with hands in reach of each other
};

/// Running peers of a plain DIS exercise that receive everything.
class HearingPeers {
 public:
  HearingPeers(const SceneFile& scene, Near near) {
    for (std::size_t i = 0; i < (near == Near::each_other ? 2 : 1); ++i) {
      hands_[i].emplace(Eigen::Vector3d(0.1 * static_cast<double>(i), 0, 500));
      joined_[i].emplace(options_of(scene, i, near == Near::no_device ? nullptr : &*hands_[i]));
      joined_[i]->run();
      ++count_;
    }
  }
  [[nodiscard]] std::size_t count() const { return count_; }
  /// By all of them.
  [[nodiscard]] std::uint64_t received() const {
    std::uint64_t sum = 0;
    for (std::size_t i = 0; i < count_; ++i)
      sum += joined_[i]->peer().counters().find("datagrams_in")->value();
    return sum;
  }

 private:
  static FederateOptions options_of(const SceneFile& scene, std::size_t index,
                                    haptics::HapticDevice* device) {
    FederateOptions options;
    options.name = index == 0 ? "wake" : "other";
    options.scene = scene;
    options.interface = "lo";
    options.loops = FederateLoops::threads;
    if (device != nullptr) options.devices.push_back({.device = device, .marking = {}});
    return options;
  }
  std::array<std::optional<bench::SteppedHand>, 2> hands_;
  std::array<std::optional<JoinedPeer>, 2> joined_;
  std::size_t count_ = 0;
};

struct Spent {
  double cpu_ns = 0;
  std::size_t sent = 0, received = 0;
};

/// CPU of the threads with this name while the traffic runs, and until it has been read.
template <typename Receiver>
Spent spend(const Receiver& receiver, std::string_view threads, Traffic& traffic, double rate) {
  const std::uint64_t before = receiver.received();
  const double begin = cpu_of_threads(threads);
  Spent spent;
  if (rate > 0) {
    spent.sent = traffic.send(rate, kTurn);
  } else {
    std::this_thread::sleep_for(kTurn);
  }
  std::this_thread::sleep_for(milliseconds(20));
  spent.cpu_ns = cpu_of_threads(threads) - begin;
  spent.received = receiver.received() - before;
  return spent;
}

void whole_peer(benchmark::State& state, Near near) try {
  static_cast<void>(Cable::instance());  // a namespace of our own
  const double rate = static_cast<double>(state.range(0));
  const SceneFile scene = parse_scene_file(kScene, "wake_bench");
  Traffic traffic(scene);
  bench::Blocks bare_us, peer_us, over_bare, idle_percent;
  std::size_t sent = 0, received = 0;
  for (auto _ : state) {
    double bare = 0;
    {
      const BareReceiver receiver(scene);
      const Spent spent = spend(receiver, "bare", traffic, rate);
      bare = spent.cpu_ns / static_cast<double>(std::max<std::size_t>(spent.received, 1));
    }
    const HearingPeers peers(scene, near);
    std::this_thread::sleep_for(milliseconds(near == Near::each_other ? 1500 : 200));
    traffic.send(5'000, kIntroduction);
    const double idle = spend(peers, "rk-", traffic, 0).cpu_ns;
    const Spent spent = spend(peers, "rk-", traffic, rate);
    sent += spent.sent * peers.count();
    received += spent.received;
    const double each =
        (spent.cpu_ns - idle) / static_cast<double>(std::max<std::size_t>(spent.received, 1));
    bare_us.add(1e-3 * bare);
    peer_us.add(1e-3 * each);
    over_bare.add(each / bare);
    idle_percent.add(100 * idle / static_cast<double>(peers.count()) /
                     std::chrono::duration<double, std::nano>(kTurn + milliseconds(20)).count());
  }
  bare_us.report(state, "bare_us");
  peer_us.report(state, "peer_us");
  over_bare.report(state, "over_bare");
  idle_percent.report(state, "idle_percent");
  state.counters["unread"] = 1.0 - static_cast<double>(received) / static_cast<double>(sent);
} catch (const std::exception& error) {
  state.SkipWithError(error.what());
}

/// A thread that steps a device each millisecond, at the priority of a servo, and does nothing
/// else.
class BareServo {
 public:
  BareServo()
      : thread_([this](const std::stop_token& stop) {
          const sched_param priority{ServoThread::kPriority};
          pthread_setschedparam(pthread_self(), SCHED_FIFO, &priority);
          const SteadyClock clock;
          for (auto due = std::chrono::steady_clock::now(); !stop.stop_requested();
               due += milliseconds(1)) {
            std::this_thread::sleep_until(due);
            const nanoseconds now = clock.now();
            benchmark::DoNotOptimize(hand_.read(now));
            hand_.write(Eigen::Vector3d::Zero(), now);
          }
        }) {
    pthread_setname_np(thread_.native_handle(), "bare");
  }

 private:
  bench::SteppedHand hand_{Eigen::Vector3d(0, 0, 500)};
  std::jthread thread_;
};

/// CPU of the threads with this name in a turn without traffic [% of a core].
double idle_percent_of(std::string_view threads) {
  std::this_thread::sleep_for(milliseconds(200));
  const double begin = cpu_of_threads(threads);
  std::this_thread::sleep_for(kTurn);
  return 100 * (cpu_of_threads(threads) - begin) /
         std::chrono::duration<double, std::nano>(kTurn).count();
}

// The servo of a peer whose hand rests far from everything, beside that thread.
void resting_servo(benchmark::State& state) try {
  static_cast<void>(Cable::instance());
  const SceneFile scene = parse_scene_file(kScene, "wake_bench");
  bench::Blocks bare_percent, servo_percent, over_bare;
  for (auto _ : state) {
    double bare = 0;
    {
      const BareServo servo;
      bare = idle_percent_of("bare");
    }
    const HearingPeers peers(scene, Near::nothing);
    const double servo = idle_percent_of("rk-servo");
    bare_percent.add(bare);
    servo_percent.add(servo);
    over_bare.add(servo / bare);
  }
  bare_percent.report(state, "bare_percent");
  servo_percent.report(state, "servo_percent");
  over_bare.report(state, "over_bare");
} catch (const std::exception& error) {
  state.SkipWithError(error.what());
}

void at_each_rate(benchmark::internal::Benchmark* bench) {
  bench->Arg(500)->Arg(5'000)->Arg(50'000)->UseRealTime();
}

BENCHMARK_CAPTURE(whole_peer, no_device, Near::no_device)->Apply(at_each_rate);
BENCHMARK_CAPTURE(whole_peer, device, Near::nothing)->Apply(at_each_rate);
BENCHMARK_CAPTURE(whole_peer, touch, Near::each_other)->Apply(at_each_rate);
BENCHMARK(resting_servo)->UseRealTime();

}  // namespace
}  // namespace reckon::peer
