// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Cost of a thousand joined groups: for each datagram, and for each change.
#include <benchmark/benchmark.h>

#include <array>
#include <exception>
#include <random>
#include <utility>
#include <vector>

#include "reckon/bench/micro/blocks.hpp"
#include "reckon/bench/micro/transport_ways.hpp"
#include "reckon/bench/timing/cpu_ns.hpp"

namespace reckon::peer {
namespace {

/// A receiver in a number of groups, and a sender to one of them, or to each in turn.
class Groups {
 public:
  explicit Groups(std::size_t count)
      : pool_(next_pool()),
        sender_(options(), clock_),
        receiver_(options(), clock_),
        octets_(1296) {
    for (std::size_t i = 0; i < count; ++i) check(!receiver_.join(pool_.address(i)), "join");
  }
  /// CPU of a datagram [ns], over 64 datagrams sent to `spread` groups.
  double round(std::size_t spread) {
    const double begin = bench::cpu_ns();
    for (std::size_t i = 0; i < kDatagrams; ++i) sender_.send(pool_.address(i % spread), octets_);
    for (std::size_t got = 0; got < kDatagrams;) {
      const std::size_t count = receiver_.receive(batch_);
      check(count > 0, "a datagram was lost");
      got += count;
    }
    return (bench::cpu_ns() - begin) / kDatagrams;
  }
  /// CPU of leaving and of joining one of them again [ns].
  std::pair<double, double> change(std::size_t index) {
    const GroupAddress group = pool_.address(index);
    const double begin = bench::cpu_ns();
    receiver_.leave(group);
    const double left = bench::cpu_ns();
    check(!receiver_.join(group), "join");
    return {left - begin, bench::cpu_ns() - left};
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

/// Cost of changes, for either kind and in total.
struct Changes {
  /// CPU of leaving and of joining [ns].
  void add(const std::pair<double, double>& one) {
    leave.add(one.first * 1e-3);
    join.add(one.second * 1e-3);
    change.add(one.first * 1e-3);
    change.add(one.second * 1e-3);
  }
  void report(benchmark::State& state) {
    join.report(state, "join_us");
    leave.report(state, "leave_us");
    change.report(state, "change_us");
  }
  bench::Blocks join, leave, change;
};

/// Cost of a thousand joined groups: for each datagram, and for each change.
void thousand_groups(benchmark::State& state) {
  try {
    Cable::instance();
    Groups one(1), many(1000), sixty_four(64);
    bench::Blocks one_ns, many_ns, ratio, spread_ratio;
    Changes changes;
    std::size_t next = 0;
    for (auto _ : state) {
      const double alone = one.round(1), among = many.round(1);
      one_ns.add(alone);
      many_ns.add(among);
      ratio.add(among / alone);
      spread_ratio.add(many.round(64) / sixty_four.round(64));
      changes.add(many.change(next++ % 1000));
    }
    one_ns.report(state, "one_group_ns");
    many_ns.report(state, "of_1000_ns");
    ratio.report(state, "of_1000_over_one");
    spread_ratio.report(state, "spread_of_1000_over_of_64");
    changes.report(state);
  } catch (const std::exception& failure) {
    state.SkipWithError(failure.what());
  }
}
BENCHMARK(thousand_groups);

/// A change of any of them. The kernel searches for a membership from the newest to the oldest,
/// twice when one is left. So the row above, where the oldest is left each time, is the most
/// expensive order.
void any_of_thousand_groups(benchmark::State& state) {
  try {
    Cable::instance();
    Groups many(1000);
    std::mt19937_64 random(1);
    Changes changes;
    for (auto _ : state) {
      many.round(64);  // datagrams arrive between changes
      changes.add(many.change(random() % 1000));
    }
    changes.report(state);
  } catch (const std::exception& failure) {
    state.SkipWithError(failure.what());
  }
}
BENCHMARK(any_of_thousand_groups);

}  // namespace
}  // namespace reckon::peer
