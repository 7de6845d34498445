// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Cost of a datagram that is refused before it is queued, beside one that is queued. Each row first
// checks the result for the datagram. The kernel's share, about a microsecond, is not included.
#include <benchmark/benchmark.h>

#include <array>
#include <chrono>
#include <cstddef>
#include <string_view>
#include <vector>

#include "reckon/pdu/codec/codec.hpp"
#include "reckon/pdu/entity/entity_state.hpp"
#include "reckon/pdu/reckon/datagram_trailer.hpp"
#include "reckon/pdu/timestamp.hpp"
#include "reckon/peer/loops/network_read_loop.hpp"
#include "reckon/peer/network/datagram_balance.hpp"
#include "reckon/peer/network/simulated_network.hpp"
#include "reckon/peer/world/datagram_decoder.hpp"
#include "reckon/peer/world/overtaken_states.hpp"

namespace {

using namespace reckon;
using namespace reckon::peer;

constexpr std::size_t kStateSize = pdu::kFixedSize<pdu::EntityState>;
using Octets = std::array<std::byte, kStateSize>;

/// A link that returns the same datagram at each call, one for each step of `gap`.
class Fire final : public Link {
 public:
  Fire(const Octets& octets, std::chrono::nanoseconds gap) : octets_(octets), gap_(gap) {}

  std::size_t receive(std::span<Datagram> out) noexcept override {
    if (left_ == 0) return 0;
    for (Datagram& datagram : out)
      datagram = {{}, IpEndpoint::v4(0x0a4d0001, 4000), octets_, now_ += gap_};
    left_ -= std::min(left_, out.size());
    return out.size();
  }
  void load(std::size_t count) noexcept { left_ = count; }
  [[nodiscard]] std::chrono::nanoseconds now() const noexcept { return now_; }

  bool send(const IpEndpoint&, std::span<const std::byte>) noexcept override { return true; }
  std::error_code join(const GroupAddress&) noexcept override { return {}; }
  void leave(const GroupAddress&) noexcept override {}
  bool wait(std::chrono::nanoseconds) noexcept override { return left_ > 0; }
  void wake() noexcept override {}
  [[nodiscard]] IpEndpoint local_endpoint() const noexcept override { return {}; }
  [[nodiscard]] std::size_t max_payload() const noexcept override { return 1372; }
  [[nodiscard]] LinkStatistics statistics() const noexcept override { return {}; }

 private:
  Octets octets_;
  std::chrono::nanoseconds gap_;
  std::chrono::nanoseconds now_{std::chrono::seconds(1)};
  std::size_t left_ = 0;
};

Octets state(std::byte version) {
  Octets octets{};
  (void)pdu::encode(pdu::EntityState{}, octets);
  octets[0] = version;
  octets[1] = std::byte{1};
  return octets;
}

/// @param counter that each datagram increments; none: it is queued
void Read(benchmark::State& run, std::byte version, std::chrono::nanoseconds gap,
          std::string_view counter) {
  constexpr std::size_t kDatagrams = 64 * 64;
  Fire link(state(version), gap);
  haptics::SpscRing<GroupCommand> commands(16);
  DatagramRing ring(std::size_t{2} << 20);
  Counters counters;
  NetworkReadLoop loop(link, commands, ring, counters, std::uint8_t{1});
  const auto read = [&] {
    link.load(kDatagrams);
    loop.step(link.now() + kDatagrams * gap);
    while (ring.front() != nullptr) ring.pop();
  };
  read();
  const Counter* grows = counters.find(counter);
  const std::uint64_t before = grows != nullptr ? grows->value() : 0;
  read();
  if (grows != nullptr && grows->value() - before != kDatagrams)
    return run.SkipWithError("refused by another rule");
  for (auto _ : run) read();
  run.counters["each_s"] = benchmark::Counter(
      kDatagrams, benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
}

constexpr std::chrono::microseconds kFlood{10}, kHonest{100};

BENCHMARK_CAPTURE(Read, junk_refused, std::byte{0x7F}, kHonest, "refused_version_in");
BENCHMARK_CAPTURE(Read, muted, std::byte{7}, kFlood, "muted_in");
BENCHMARK_CAPTURE(Read, queued, std::byte{7}, kHonest, "");

/// Waiting states of as many entities as are in a datagram: all but those of the last datagram are
/// overtaken. Cost of each state that is skipped, without its kernel, link and ring.
void Overtaken(benchmark::State& run) {
  constexpr std::size_t kWaiting = 512;
  const auto states = static_cast<std::size_t>(run.range(0));
  std::vector<std::vector<std::byte>> octets(kWaiting);
  std::vector<ArrivedDatagram> waiting(kWaiting);
  for (std::size_t i = 0; i < kWaiting; ++i) {
    octets[i].resize(states * kStateSize);
    for (std::size_t n = 0; n < states; ++n) {
      pdu::EntityState state;
      state.entity_id = {7, 1, static_cast<std::uint16_t>(n + 1)};
      state.header.timestamp = pdu::to_dis_timestamp(std::chrono::milliseconds(i), true);
      (void)pdu::encode(state, std::span(octets[i]).subspan(n * kStateSize));
    }
    waiting[i].octets = octets[i];
  }
  Counters counters;
  DatagramDecoder decoder(1, counters);
  OvertakenStates overtaken(1, kWaiting);
  const auto look = [&] {
    overtaken.look(waiting);
    for (std::size_t i = 0; i < kWaiting; ++i)
      if (overtaken.is_whole(i)) decoder.leave_out(states, false);
  };
  look();
  if (overtaken.count() != (kWaiting - 1) * states)
    return run.SkipWithError("others were left out");
  for (auto _ : run) look();
  run.counters["each_s"] = benchmark::Counter(
      static_cast<double>(overtaken.count()),
      benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
}
BENCHMARK(Overtaken)->Arg(1)->Arg(9);

/// Cost of a datagram in the balance: a loop notes 1,000 of them, and the owner of the balance
/// collects them. `balanced` times only the collection, else only the notes are timed.
void Tapped(benchmark::State& run, bool balanced) {
  constexpr std::uint32_t kNoted = 1000;
  std::array<std::byte, pdu::kDatagramTrailerSize> octets;
  DatagramTap tap;
  DatagramBalance balance(tap);
  std::uint32_t number = 0;
  const auto note = [&] {
    for (std::uint32_t i = 0; i < kNoted; ++i) {
      pdu::store_big_endian(octets.data() + 12, ++number);
      tap.note(DatagramTap::Loop::read, DatagramFate::arrived, {}, octets);
    }
  };
  pdu::DatagramTrailer trailer;
  trailer.epoch = 1;
  if (pdu::encode(trailer, octets) != octets.size()) return run.SkipWithError("no trailer");
  for (auto _ : run) {
    if (balanced) run.PauseTiming();
    note();
    balanced ? run.ResumeTiming() : run.PauseTiming();
    balance.look();
    if (!balanced) run.ResumeTiming();
  }
  const BalanceReport report = balance.report({}, true);
  if (report.missed > 0 || report.stretches.size() != 1 || report.stretches[0].arrived != number)
    return run.SkipWithError("not all were counted");
  run.counters["each_s"] = benchmark::Counter(
      kNoted, benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
}
BENCHMARK_CAPTURE(Tapped, noted, false);
BENCHMARK_CAPTURE(Tapped, balanced, true);

}  // namespace
