// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Entity updates end to end, beside bare loops that send and read octets and look at none: encode,
// bundle and send; receive, decode and the table of remote entities. Rivals take turns, in CPU time
// of one thread that does both sides, so that load elsewhere hits all alike. Over loopback and over
// a cable between two network namespaces of its own (needs root). First each row looks whether all
// arrived and the table has it.
#include <benchmark/benchmark.h>
#include <fcntl.h>
#include <netinet/in.h>
#include <sched.h>
#include <sys/socket.h>
#include <unistd.h>

#include <array>
#include <chrono>
#include <cmath>
#include <cstdlib>
#include <ctime>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include "reckon/bench/blocks.hpp"
#include "reckon/deadreckon/wire_conversion.hpp"
#include "reckon/pdu/timestamp.hpp"
#include "reckon/peer/loops/aoim_setup.hpp"
#include "reckon/peer/loops/network_write_loop.hpp"
#include "reckon/peer/network/udp_multicast.hpp"
#include "reckon/peer/world/datagram_decoder.hpp"
#include "reckon/peer/world/remote_entities.hpp"

namespace reckon::peer {
namespace {

using std::chrono::milliseconds;
using std::chrono::nanoseconds;
using std::chrono::seconds;

constexpr nanoseconds kUtc = std::chrono::hours(500'000);
constexpr std::size_t kUpdate = 144, kPerDatagram = 9, kDatagrams = 64;
constexpr std::size_t kRounds = 8;  // in a turn, so that the caches are its own
constexpr std::uint16_t kEntities = 1000;
constexpr std::size_t kBuffer = std::size_t{8} << 20;  // a round fits

double cpu_ns() {
  timespec spent{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &spent);
  return static_cast<double>(spent.tv_sec) * 1e9 + static_cast<double>(spent.tv_nsec);
}

void check(bool good, const char* what) {
  if (!good) throw std::runtime_error(what);
}

/// Two namespaces with a cable from a0 to b0, and loopback in the first. The calling thread moves
/// into the first, for good: nothing leaves it.
class Cable {
 public:
  Cable() {
    check(unshare(CLONE_NEWNET) == 0, "needs root for network namespaces");
    near_ = open("/proc/thread-self/ns/net", O_RDONLY);
    std::thread([this] {
      if (unshare(CLONE_NEWNET) == 0) far_ = open("/proc/thread-self/ns/net", O_RDONLY);
      std::system(("ip link set lo up && ip link add b0 type veth peer name a0 netns " +
                   std::to_string(getpid()) +
                   " && ip addr add 10.66.0.2/24 dev b0 && "
                   "ip link set b0 up")
                      .c_str());
    }).join();
    check(far_ >= 0 && std::system("ip link set lo up && ip addr add 10.66.0.1/24 dev a0 && "
                                   "ip link set a0 up") == 0,
          "no cable: is iproute2 there?");
  }
  void enter(bool far) const { check(setns(far ? far_ : near_, CLONE_NEWNET) == 0, "setns"); }
  static const Cable& instance() {
    static const Cable cable;
    return cable;
  }

 private:
  int near_ = -1, far_ = -1;
};

/// Where a row runs.
struct Way {
  const char *sender, *receiver;
  bool far;
};
constexpr Way kLoopback{"lo", "lo", false}, kNamespaces{"a0", "b0", true};

UdpMulticastOptions options_of(const char* interface, bool offload) {
  UdpMulticastOptions options;
  options.interface = interface;
  options.receive_buffer = kBuffer;
  options.batch = 64;
  options.offload = offload;
  return options;
}

/// sendto and recvmmsg, and nothing else.
class BareLoop {
 public:
  BareLoop(const Way& way, std::size_t size, const GroupAddress& group) : octets_(size) {
    sender_ = socket(AF_INET, SOCK_DGRAM, 0);
    const ip_mreqn out{{}, {}, index_of(way.sender)};
    check(setsockopt(sender_, IPPROTO_IP, IP_MULTICAST_IF, &out, sizeof out) == 0, "multicast if");
    to_.sin_family = AF_INET;
    to_.sin_port = htons(group.port);
    std::copy_n(group.octets.begin(), 4, reinterpret_cast<std::uint8_t*>(&to_.sin_addr));
    Cable::instance().enter(way.far);
    receiver_ = socket(AF_INET, SOCK_DGRAM, 0);
    const int room = kBuffer, none = 0;
    setsockopt(receiver_, SOL_SOCKET, SO_RCVBUFFORCE, &room, sizeof room);
    setsockopt(receiver_, IPPROTO_IP, IP_MULTICAST_ALL, &none, sizeof none);
    check(bind(receiver_, reinterpret_cast<sockaddr*>(&to_), sizeof to_) == 0, "bind");
    const ip_mreqn in{to_.sin_addr, {}, index_of(way.receiver)};
    check(setsockopt(receiver_, IPPROTO_IP, IP_ADD_MEMBERSHIP, &in, sizeof in) == 0, "join");
    Cable::instance().enter(false);
    for (std::size_t i = 0; i < kDatagrams; ++i) {
      vectors_[i] = {buffers_[i].data(), buffers_[i].size()};
      messages_[i].msg_hdr.msg_iov = &vectors_[i];
      messages_[i].msg_hdr.msg_iovlen = 1;
    }
  }
  ~BareLoop() {
    close(sender_);
    close(receiver_);
  }
  BareLoop(const BareLoop&) = delete;
  BareLoop& operator=(const BareLoop&) = delete;

  /// CPU of a datagram [ns], of a turn.
  double turn() {
    const double begin = cpu_ns();
    for (std::size_t i = 0; i < kRounds; ++i) round();
    return (cpu_ns() - begin) / (kRounds * kDatagrams);
  }

 private:
  void round() {
    for (std::size_t i = 0; i < kDatagrams; ++i) {
      sendto(sender_, octets_.data(), octets_.size(), 0, reinterpret_cast<sockaddr*>(&to_),
             sizeof to_);
    }
    std::size_t got = 0;
    while (got < kDatagrams) {
      const int count = recvmmsg(receiver_, messages_.data(), kDatagrams, MSG_DONTWAIT, nullptr);
      check(count > 0, "a bare datagram was lost");
      got += static_cast<std::size_t>(count);
    }
  }

  static int index_of(const std::string& name) {
    for (const NetworkInterface& found : list_interfaces()) {
      if (found.name == name) return static_cast<int>(found.index);
    }
    throw std::runtime_error("no interface " + name);
  }
  int sender_, receiver_;
  sockaddr_in to_{};
  std::vector<std::byte> octets_;
  std::array<std::array<std::byte, 2048>, kDatagrams> buffers_;
  std::array<iovec, kDatagrams> vectors_{};
  std::array<mmsghdr, kDatagrams> messages_{};
};

/// What updates took at each stage [ns].
struct Stages {
  double bundle = 0, send = 0, receive = 0, table = 0;
  [[nodiscard]] double all() const { return out() + in(); }
  [[nodiscard]] double out() const { return bundle + send; }
  [[nodiscard]] double in() const { return receive + table; }
};

/// The library's own parts, from an owner's states to the table of another peer.
class Updates {
 public:
  Updates(const Way& way, const GroupAddress& group, bool offload, std::size_t per_datagram)
      : group_(group),
        per_datagram_(per_datagram),
        scene_(parse_scene_file("[aoim]\nradius = \"100 km\"\ncell = \"10 km\"\n", "bench")),
        frame_(0.8, 0.1, 400),
        pool_(scene_.network.group, scene_.aoim.pool),
        aggregator_(bundling()),
        sender_(options_of(way.sender, offload), clock_),
        aoim_(aoim_config(scene_), presence(scene_, frame_, pool_, {{1, 1}, "me", 5, 0, false})),
        remote_(frame_, aoim_, {0.01, scene_.convergence, {}, kEntities}, counters_),
        states_(kEntities) {
    Cable::instance().enter(way.far);
    receiver_.emplace(options_of(way.receiver, offload), clock_);
    check(!receiver_->join(group), "join");
    Cable::instance().enter(false);
    const std::array<aoim::Focus, 1> here{{{{0, 0, 0}, 0.0, scene_.aoim.radius}}};
    static_cast<void>(aoim_.set_foci(here, nanoseconds(0)));
    for (std::uint16_t i = 0; i < kEntities; ++i) {
      deadreckon::KinematicState state;
      state.algorithm = pdu::DeadReckoningAlgorithm::fpw;
      state.position = {10.0 * (i % 32), 10.0 * (i / 32), 0};
      state.velocity = {10, 0, 0};
      states_[i].header.exercise_id = scene_.network.exercise;
      states_[i].entity_id = {7, 1, static_cast<std::uint16_t>(i + 1)};
      states_[i].entity_type = {pdu::EntityKind::platform, pdu::EntityDomain::air};
      check(deadreckon::to_wire(state, frame_, states_[i]) == deadreckon::ConversionError::none,
            "to_wire");
    }
    while (heard_ < kEntities) turn();
    check(remote_.rows().size() == kEntities, "the table lacks entities");
    check(receiver_->statistics().kernel_drops == 0, "the kernel dropped some");
  }

  [[nodiscard]] const UdpMulticast& sender() const { return sender_; }

  /// CPU of an update [ns], of a turn.
  Stages turn() {
    Stages sum;
    for (std::size_t i = 0; i < kRounds; ++i) round(sum);
    const double count = static_cast<double>(kRounds * updates());
    for (double* stage : {&sum.bundle, &sum.send, &sum.receive, &sum.table}) {
      *stage /= count;
    }
    return sum;
  }

 private:
  [[nodiscard]] std::size_t updates() const { return per_datagram_ * kDatagrams; }

  void round(Stages& taken) {
    const double begin = cpu_ns();
    for (std::size_t i = 0; i < updates(); ++i) add_next();
    aggregator_.flush_due(now_, [this](aoim::GroupIndex, std::span<const std::byte> octets) {
      check(ring_.push(group_, {}, octets), "ring");
    });
    const double bundled = cpu_ns();
    check(write_.step() == kDatagrams, "other datagrams than asked for");
    const double sent = cpu_ns();
    taken.bundle += bundled - begin;
    taken.send += sent - bundled;
    take(taken);
  }

  aoim::AggregatorConfig bundling() const {
    aoim::AggregatorConfig config;
    config.payload_limit = 1372;
    config.reserved = 0;
    config.exercise_id = scene_.network.exercise;
    return config;
  }
  // Once around they are 200 ms older.
  void add_next() {
    if (next_ == kEntities) next_ = 0, now_ += milliseconds(200);
    pdu::EntityState& state = states_[next_++];
    state.header.timestamp = pdu::to_dis_timestamp(kUtc + now_, true);
    static_cast<void>(aggregator_.add(aoim::GroupIndex{1}, state, {},
                                      {now_, static_cast<std::uint32_t>(per_datagram_)}));
  }
  void take(Stages& taken) {
    for (std::size_t left = updates(); left > 0;) {
      const double begin = cpu_ns();
      const std::size_t count = receiver_->receive(batch_);
      const double received = cpu_ns();
      check(count > 0, "a datagram was lost");
      for (std::size_t i = 0; i < count; ++i) {
        const std::span<const Inbound> updates = decoder_.decode(batch_[i].bytes, {1, 1});
        remote_.prefetch(updates);
        for (const Inbound& update : updates) {
          check(remote_.take(update, {now_, kUtc + now_, now_, 0, {}, {}}, servo_), "refused");
          --left;
          ++heard_;
        }
      }
      taken.receive += received - begin;
      taken.table += cpu_ns() - received;
    }
  }

  SteadyClock clock_;
  GroupAddress group_;
  std::size_t per_datagram_;
  SceneFile scene_;
  deadreckon::LocalFrame frame_;
  GroupPool pool_;
  Counters counters_, out_counters_;
  aoim::Aggregator aggregator_;
  UdpMulticast sender_;
  std::optional<UdpMulticast> receiver_;
  aoim::AreaOfInterestManager aoim_;
  RemoteEntities remote_;
  DatagramDecoder decoder_{1, counters_};
  DatagramRing ring_{std::size_t{2} << 20};  // as a peer has
  NetworkWriteLoop write_{sender_, ring_, out_counters_};
  haptics::ServoSnapshot servo_;
  std::vector<pdu::EntityState> states_;
  std::array<Datagram, 64> batch_;
  std::size_t next_ = 0, heard_ = 0;
  nanoseconds now_ = seconds(1);
};

GroupAddress next_group() {
  static std::uint32_t number = 0;
  return IpEndpoint::v4(0xefc04f01u + number++, 3100);
}

/// Bundles of nine with and without offload, one update a datagram, and the bare loops of both.
void end_to_end(benchmark::State& state, const Way& way) {
  try {
    Cable::instance();
    BareLoop bare(way, kPerDatagram * kUpdate, next_group()), bare_one(way, kUpdate, next_group());
    Updates bundled(way, next_group(), false, kPerDatagram);
    Updates offloaded(way, next_group(), true, kPerDatagram);
    Updates single(way, next_group(), false, 1);
    bench::Blocks bare_ns, bare_one_ns, ours_ns, ratio, gain, offload_ns, one_ratio, one_ns;
    bench::Blocks bundle, send, receive, table, fast_send, fast_receive, rate, carried, fast_ratio;
    for (auto _ : state) {
      const double plain = bare.turn() / kPerDatagram;
      const Stages ours = bundled.turn();
      const Stages fast = offloaded.turn();
      const double alone = bare_one.turn();
      const double one = single.turn().all();
      bare_ns.add(plain);
      bare_one_ns.add(alone);
      ours_ns.add(ours.all());
      ratio.add(ours.all() / plain);
      bundle.add(ours.bundle);
      send.add(ours.send);
      receive.add(ours.receive);
      table.add(ours.table);
      carried.add((ours.send + ours.receive) / plain);
      offload_ns.add(fast.all());
      fast_ratio.add(fast.all() / plain);
      gain.add(ours.all() / fast.all());
      fast_send.add(fast.send);
      fast_receive.add(fast.receive);
      rate.add(1e3 / std::max(fast.out(), fast.in()));
      one_ns.add(one);
      one_ratio.add(one / alone);
    }
    if (!offloaded.sender().offload().segments) throw std::runtime_error("no UDP_SEGMENT here");
    bare_ns.report(state, "bare9_ns");
    ours_ns.report(state, "ours9_ns");
    ratio.report(state, "ours9_over_bare9");
    bundle.report(state, "encode_bundle_ns");
    send.report(state, "send_ns");
    receive.report(state, "receive_ns");
    table.report(state, "decode_table_ns");
    carried.report(state, "link9_over_bare9");
    offload_ns.report(state, "offload9_ns");
    fast_send.report(state, "offload_send_ns");
    fast_receive.report(state, "offload_receive_ns");
    fast_ratio.report(state, "offload9_over_bare9");
    gain.report(state, "offload_gain");
    rate.report(state, "slower_side_Mps");
    bare_one_ns.report(state, "bare1_ns");
    one_ns.report(state, "ours1_ns");
    one_ratio.report(state, "ours1_over_bare1");
  } catch (const std::exception& failure) {
    state.SkipWithError(failure.what());
  }
}
BENCHMARK_CAPTURE(end_to_end, loopback, kLoopback);
BENCHMARK_CAPTURE(end_to_end, namespaces, kNamespaces);

/// A receiver in so many groups, and a sender to one of them, or to each in turn.
class Groups {
 public:
  explicit Groups(std::size_t count)
      : pool_(next_pool()),
        sender_(options(), clock_),
        receiver_(options(), clock_),
        octets_(1296) {
    for (std::size_t i = 0; i < count; ++i) check(!receiver_.join(pool_.address(i)), "join");
  }
  /// CPU of a datagram [ns], 64 of them sent to so many groups.
  double round(std::size_t spread) {
    const double begin = cpu_ns();
    for (std::size_t i = 0; i < kDatagrams; ++i) sender_.send(pool_.address(i % spread), octets_);
    for (std::size_t got = 0; got < kDatagrams;) {
      const std::size_t count = receiver_.receive(batch_);
      check(count > 0, "a datagram was lost");
      got += count;
    }
    return (cpu_ns() - begin) / kDatagrams;
  }
  /// CPU of leaving and of joining one of them again [ns].
  std::pair<double, double> change(std::size_t index) {
    const GroupAddress group = pool_.address(index);
    const double begin = cpu_ns();
    receiver_.leave(group);
    const double left = cpu_ns();
    check(!receiver_.join(group), "join");
    return {left - begin, cpu_ns() - left};
  }

 private:
  static GroupPool next_pool() {
    static std::uint32_t number = 0;
    return {IpEndpoint::v4(0xefc10000u + 2048 * number++, 3200), 1000};
  }
  static UdpMulticastOptions options() {
    UdpMulticastOptions options = options_of("lo", false);
    options.max_groups = 1024;
    return options;
  }

  SteadyClock clock_;
  GroupPool pool_;
  UdpMulticast sender_, receiver_;
  std::vector<std::byte> octets_;
  std::array<Datagram, 64> batch_;
};

/// What a thousand groups cost that are joined: each datagram, and each change.
void thousand_groups(benchmark::State& state) {
  try {
    Cable::instance();
    Groups one(1), many(1000), sixty_four(64);
    bench::Blocks one_ns, many_ns, ratio, spread_ratio, join, leave;
    std::size_t next = 0;
    for (auto _ : state) {
      const double alone = one.round(1), among = many.round(1);
      one_ns.add(alone);
      many_ns.add(among);
      ratio.add(among / alone);
      spread_ratio.add(many.round(64) / sixty_four.round(64));
      const auto [left, joined] = many.change(next++ % 1000);
      leave.add(left * 1e-3);
      join.add(joined * 1e-3);
    }
    one_ns.report(state, "one_group_ns");
    many_ns.report(state, "of_1000_ns");
    ratio.report(state, "of_1000_over_one");
    spread_ratio.report(state, "spread_of_1000_over_of_64");
    join.report(state, "join_us");
    leave.report(state, "leave_us");
  } catch (const std::exception& failure) {
    state.SkipWithError(failure.what());
  }
}
BENCHMARK(thousand_groups);

}  // namespace
}  // namespace reckon::peer
