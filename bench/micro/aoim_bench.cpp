// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Cost of the AOIM layer for each update (the CPU column; one iteration = one update), beside its
// benefit: octets and datagrams per update, added delay, groups joined, and updates delivered from
// beyond the radius of interest.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <numeric>
#include <random>
#include <vector>

#include "reckon/aoim/area_of_interest_manager.hpp"
#include "reckon/aoim/interest/focus_cover.hpp"
#include "reckon/pdu/bundle.hpp"
#include "reckon/pdu/reckon/haptic_record.hpp"

namespace {

using namespace reckon;
using namespace reckon::aoim;
using std::chrono::milliseconds;
using std::chrono::nanoseconds;

constexpr std::size_t kEntities = 256;
constexpr double kRadius = 200.0;

pdu::Presence presence() {
  pdu::Presence own;
  own.simulation = {7, 1};
  own.epoch = 11;
  return own;
}

std::vector<pdu::EntityState> entities() {
  std::vector<pdu::EntityState> states(kEntities);
  for (std::size_t i = 0; i < kEntities; ++i) {
    states[i].entity_id = {7, 1, static_cast<std::uint16_t>(i + 1)};
  }
  return states;
}

std::array<std::byte, pdu::kHapticRecordLength> haptic_record() {
  std::array<std::byte, pdu::kHapticRecordLength> octets{};
  (void)pdu::store_record(pdu::HapticRecord{}, octets);
  return octets;
}

/// Counts datagrams that are sent; the first ones are decoded, so that the rows time real bundles.
struct Wire {
  std::uint64_t datagrams = 0, octets = 0, broken = 0;
  void operator()(GroupIndex, std::span<const std::byte> datagram) {
    ++datagrams;
    octets += datagram.size();
    if (datagrams > 1000) return;
    for (const pdu::BundledPdu& bundled : pdu::BundleReader(datagram)) {
      broken += bundled.error != pdu::DecodeError::none ? 1 : 0;
    }
  }
};

void report(benchmark::State& state, const Wire& wire, std::uint64_t updates) {
  if (wire.broken > 0) state.SkipWithError("a bundle cannot be read back");
  state.SetItemsProcessed(static_cast<std::int64_t>(updates));
  state.counters["bytes_per_update"] =
      static_cast<double>(wire.octets) / static_cast<double>(updates);
  state.counters["updates_per_datagram"] =
      static_cast<double>(updates) /
      static_cast<double>(std::max<std::uint64_t>(1, wire.datagrams));
}

/// Encodes, routes and aggregates one update: `deadline_ms` 0 = a datagram for each, else bundled
/// by size.
void route_and_aggregate(benchmark::State& state) {
  AreaOfInterestManager manager({}, presence());
  auto states = entities();
  const auto record = haptic_record();
  const bool bundled = state.range(0) != 0;
  const std::span<const std::byte> records =
      state.range(1) != 0 ? std::span<const std::byte>(record) : std::span<const std::byte>();
  const std::size_t places = static_cast<std::size_t>(state.range(2));
  Wire wire;
  std::uint64_t updates = 0;
  nanoseconds now{0};
  for (auto _ : state) {
    const std::size_t i = updates++ % kEntities;
    now += std::chrono::microseconds(1);
    const Position position{400.0 * static_cast<double>(i % places), 0.0, 0.0};
    manager.send(aoim::kCellTier, aoim::StatePayload{states[i], records}, position,
                 bundled ? now + milliseconds(5) : now);
    if (!bundled || updates % 8 == 0) manager.step(now, wire);
  }
  manager.flush(now, wire);
  report(state, wire, updates);
}
BENCHMARK(route_and_aggregate)
    ->ArgNames({"bundled", "haptic", "cells"})
    ->Args({0, 0, 1})
    ->Args({1, 0, 1})
    ->Args({1, 0, 8})
    ->Args({0, 1, 1})
    ->Args({1, 1, 1});

/// Lower bound: the same octets encoded directly into a datagram of 8.
void encode_alone(benchmark::State& state) {
  auto states = entities();
  std::array<std::byte, 8 * 144> buffer;
  Wire wire;
  std::uint64_t updates = 0;
  for (auto _ : state) {
    const std::size_t slot = updates % 8;
    benchmark::DoNotOptimize(
        pdu::encode(states[updates++ % kEntities], std::span(buffer).subspan(144 * slot)));
    if (slot == 7) wire({}, buffer);
  }
  report(state, wire, updates);
}
BENCHMARK(encode_alone);

/// Order in which entities send.
enum Order : std::int64_t {
  kInTurn,
  kShuffled,   ///< their octets come from one place after the other, as from an encoder
  kScattered,  ///< shuffled, and each from a place of its own: most reads of them miss the caches
};

std::vector<std::vector<std::byte>> encoded_updates(std::size_t count, std::int64_t order) {
  std::vector<std::uint32_t> numbers(count);
  std::iota(numbers.begin(), numbers.end(), 0);
  std::mt19937_64 random(1);
  if (order == kShuffled) std::shuffle(numbers.begin(), numbers.end(), random);
  std::vector<std::vector<std::byte>> updates(count);
  for (std::size_t i = 0; i < count; ++i) {
    pdu::EntityState one;
    one.entity_id = {7, static_cast<std::uint16_t>(1 + (numbers[i] >> 16)),
                     static_cast<std::uint16_t>(numbers[i])};
    updates[i].resize(pdu::wire_size(one));
    (void)pdu::encode(one, updates[i]);
  }
  if (order == kScattered) std::shuffle(updates.begin(), updates.end(), random);
  return updates;
}

/// Cost for a peer with many entities: each of them sends once within one step, through one group;
/// then the bundles are sent.
void add_in_one_step(benchmark::State& state) {
  const auto count = static_cast<std::size_t>(state.range(0));
  const std::vector<std::vector<std::byte>> updates = encoded_updates(count, state.range(1));
  Aggregator aggregator{AggregatorConfig{}};
  Wire wire;
  nanoseconds now{0};
  for (auto _ : state) {
    now += milliseconds(2);
    for (const auto& update : updates) aggregator.add(GroupIndex{1}, update, now);
    aggregator.flush_due(now, wire);
  }
  const auto asked = static_cast<std::uint64_t>(state.iterations()) * count;
  report(state, wire, asked);
  state.counters["ns_per_update"] = benchmark::Counter(
      static_cast<double>(asked), benchmark::Counter::kIsRate | benchmark::Counter::kInvert);
  state.counters["refused_share"] =
      static_cast<double>(aggregator.counts().refused) / static_cast<double>(asked);
}
BENCHMARK(add_in_one_step)
    ->ArgNames({"entities", "order"})
    ->ArgsProduct({{100, 1000, 10000, 100000}, {kInTurn, kShuffled, kScattered}});

void route(benchmark::State& state) {
  GridConfig config;
  config.scheme = state.range(0) == 0 ? CellScheme::square : CellScheme::hexagonal;
  const CellGrid grid(config);
  double x = 0.0;
  for (auto _ : state) benchmark::DoNotOptimize(grid.group(Position{x += 1.7, -0.3 * x, 0.0}));
}
BENCHMARK(route)->ArgName("hexagonal")->Arg(0)->Arg(1);

/// The same through a peer's manager, with its foci while one moves.
void route_by_manager(benchmark::State& state) {
  AreaOfInterestConfig config;
  config.grid.scheme = state.range(0) == 0 ? CellScheme::square : CellScheme::hexagonal;
  const AreaOfInterestManager manager(config, presence());
  double x = 0.0;
  for (auto _ : state) benchmark::DoNotOptimize(manager.route(Position{x += 1.7, -0.3 * x, 0.0}));
}
BENCHMARK(route_by_manager)->ArgName("hexagonal")->Arg(0)->Arg(1);

void set_foci_of_manager(benchmark::State& state) {
  AreaOfInterestConfig config;
  config.grid.scheme = CellScheme::square;
  config.grid.cell_size = static_cast<double>(state.range(0));
  AreaOfInterestManager manager(config, presence());
  Focus focus{{0, 0, 0}, 14.0, kRadius};
  std::int64_t steps = 0;
  for (auto _ : state) {
    focus.position.x += 0.28;
    const auto change = manager.listen(aoim::kCellTier, {&focus, 1}, ++steps * milliseconds(20));
    benchmark::DoNotOptimize(change.join.size());
  }
}
BENCHMARK(set_foci_of_manager)->ArgName("cell_m")->Arg(50)->Arg(200);

/// Checks a datagram and one of its entities at the receiver.
void receive(benchmark::State& state) {
  AreaOfInterestManager manager({}, presence());
  const Focus focus{{0, 0, 0}, 0.0, kRadius};
  manager.listen(aoim::kCellTier, {&focus, 1}, nanoseconds(0));
  AggregatorConfig config;
  config.epoch = 22;
  Aggregator sender(config);
  const GroupIndex group = manager.route(focus.position);
  std::vector<std::vector<std::byte>> datagrams;
  const auto states = entities();
  for (int i = 0; i < 512; ++i) {
    sender.add(group, states[0], {}, nanoseconds(0));
    sender.flush_due(nanoseconds(0), [&](GroupIndex, std::span<const std::byte> datagram) {
      datagrams.emplace_back(datagram.begin(), datagram.end());
    });
  }
  std::size_t next = 0;
  for (auto _ : state) {
    benchmark::DoNotOptimize(manager.receive(group, datagrams[next++ % 512], nanoseconds(0)));
    benchmark::DoNotOptimize(manager.sight().judge({50, 60, 0}, 0.0, 1, false));
  }
}
BENCHMARK(receive);

/// Subscription of one moving focus: ns, groups joined, traffic delivered over traffic wanted.
void subscribe(benchmark::State& state) {
  GridConfig config;
  config.scheme = state.range(0) == 0 ? CellScheme::square : CellScheme::hexagonal;
  config.cell_size = static_cast<double>(state.range(1));
  const CellGrid grid(config);
  SubscriptionConfig uncapped;
  uncapped.maximum_groups = config.pool;
  Subscription subscription(grid, uncapped);
  Focus focus{{0, 0, 0}, 14.0, kRadius};
  std::mt19937_64 random(1);
  double groups = 0.0, joins = 0.0, heading = 0.0;
  std::int64_t steps = 0;
  for (auto _ : state) {
    heading += 0.02 * (static_cast<double>(random() % 201) / 100.0 - 1.0);
    focus.position.x += 0.28 * std::cos(heading);
    focus.position.y += 0.28 * std::sin(heading);
    const auto change = subscription.update({&focus, 1}, ++steps * milliseconds(20));
    groups += static_cast<double>(subscription.joined().size());
    joins += static_cast<double>(change.join.size());
  }
  const bool square = config.scheme == CellScheme::square;
  const double area = config.cell_size * config.cell_size * (square ? 1.0 : 1.5 * std::sqrt(3.0));
  const double mean = groups / static_cast<double>(steps);
  state.counters["groups"] = mean;
  state.counters["over_delivery"] = mean * area / (std::acos(-1.0) * kRadius * kRadius);
  state.counters["joins_per_s"] = joins / (0.02 * static_cast<double>(steps));
}
BENCHMARK(subscribe)
    ->ArgNames({"hexagonal", "cell_m"})
    ->Args({0, 100})
    ->Args({0, 200})
    ->Args({0, 400})
    ->Args({1, 62})
    ->Args({1, 125})
    ->Args({1, 250});

/// A few foci that cover many entities, scattered over 100 km or in one crowd.
void cover_foci(benchmark::State& state) {
  std::mt19937_64 random(3);
  const double extent = state.range(1) == 0 ? 5e4 : 50.0;
  std::uniform_real_distribution<double> along(-extent, extent);
  std::vector<Focus> entities(static_cast<std::size_t>(state.range(0)));
  for (Focus& entity : entities) entity = {{along(random), along(random), 0.0}, 10.0, kRadius};
  FocusCover cover(125.0);
  std::size_t foci = 0;
  for (auto _ : state) {
    foci = cover.cover(entities).size();
    benchmark::DoNotOptimize(foci);
  }
  if (foci == 0 || foci > FocusCover::kMostFoci) state.SkipWithError("not covered");
  state.counters["foci"] = static_cast<double>(foci);
}
BENCHMARK(cover_foci)
    ->ArgNames({"entities", "crowd"})
    ->Args({100, 0})
    ->Args({10000, 0})
    ->Args({10000, 1})
    ->Args({100000, 0});

}  // namespace
