// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Cost of a sealed exercise: an update beside one in plain DIS, over sockets; the envelope alone;
// and the refusal of forged datagrams. Rows with forgeries and restarts count events that must be
// 0. Numbers: docs/security.md.
#include <benchmark/benchmark.h>
#include <unistd.h>

#include <array>
#include <memory>
#include <set>
#include <tuple>
#include <vector>

#include "reckon/bench/micro/blocks.hpp"
#include "reckon/bench/timing/cpu_ns.hpp"
#include "reckon/pdu/bundle.hpp"
#include "reckon/pdu/pdu_types.hpp"
#include "reckon/peer/network/udp_multicast.hpp"
#include "reckon/peer/sealing/sealed_link.hpp"
#include "reckon/tests/src/sealing/sealing_samples.hpp"

namespace {

using namespace reckon;
using namespace reckon::peer::samples;
using peer::EnvelopeOpener;
using peer::EnvelopeSealer;
using peer::SealedVerdict;

constexpr std::size_t kUpdates = 9;  // Entity States of a full bundle

peer::UdpMulticastOptions on_loopback() {
  peer::UdpMulticastOptions options;
  options.interface = "lo";
  return options;
}

// Two ends of a loopback group, plain or sealed.
class Ends {
 public:
  Ends(std::uint16_t offset, bool is_sealed)
      : group_(peer::IpEndpoint::v4(0xefc04e01, port(offset))) {
    for (std::size_t i = 0; i < 2; ++i) {
      udp_[i] = std::make_unique<peer::UdpMulticast>(on_loopback(), clock_);
      links_[i] = udp_[i].get();
      if (is_sealed) {
        peer::SealedLinkOptions options;
        options.key = group_key(1, fast_suite());
        options.base = group_;
        options.application = static_cast<std::uint16_t>(i);
        sealed_[i] = std::make_unique<peer::SealedLink>(*udp_[i], options, clock_);
        links_[i] = sealed_[i].get();
      }
      if (links_[i]->join(group_)) throw std::runtime_error("no multicast on lo");
    }
    for (int i = 0; i < 60; ++i) meet(i < 40);
  }

  // One bundle in each direction: encoded, sent, received, decoded. False if one was lost.
  bool exchange() { return carry(0, 1) && carry(1, 0); }

 private:
  static std::uint16_t port(std::uint16_t offset) {
    return static_cast<std::uint16_t>(20000 + (getpid() + offset) % 20000);
  }

  // Time for greetings, and for datagrams sent meanwhile.
  void meet(bool speaks) {
    std::array<peer::Datagram, 16> batch;
    for (peer::Link* link : links_) {
      if (speaks) link->send(group_, std::array<std::byte, 8>{});
      link->wait(std::chrono::milliseconds(5));
      link->receive(batch);
    }
  }

  bool carry(std::size_t from, std::size_t to) {
    std::array<std::byte, kUpdates * 144> octets;
    for (std::size_t i = 0; i < kUpdates; ++i) {
      state_.entity_id.entity = static_cast<std::uint16_t>(i + 1);
      state_.location.x = static_cast<double>(++turn_);
      static_cast<void>(encode(state_, std::span(octets).subspan(144 * i, 144)));
    }
    if (!links_[from]->send(group_, octets)) return false;
    std::array<peer::Datagram, 16> batch;
    for (int tries = 0; tries < 10; ++tries) {
      if (links_[to]->receive(batch) > 0) return read(batch[0].bytes);
      links_[to]->wait(std::chrono::seconds(1));
    }
    return false;
  }

  static bool read(std::span<const std::byte> octets) {
    std::size_t updates = 0;
    for (const pdu::BundledPdu& bundled : pdu::BundleReader(octets)) {
      pdu::EntityState state;
      if (decode(bundled.bytes, state) == pdu::DecodeError::none) ++updates;
      benchmark::DoNotOptimize(state);
    }
    return updates == kUpdates;
  }

  peer::SteadyClock clock_;
  peer::GroupAddress group_;
  std::array<std::unique_ptr<peer::UdpMulticast>, 2> udp_;
  std::array<std::unique_ptr<peer::SealedLink>, 2> sealed_;
  std::array<peer::Link*, 2> links_{};
  pdu::EntityState state_;
  std::uint64_t turn_ = 0;
};

/// CPU time of one update, over a block that is short enough to be rarely interrupted.
double update_ns(Ends& ends, bool& whole) {
  constexpr int kExchanges = 200;
  const double begin = bench::cpu_ns();
  for (int i = 0; i < kExchanges; ++i) whole = ends.exchange() && whole;
  return (bench::cpu_ns() - begin) / (2.0 * kExchanges * kUpdates);
}

// CPU of sender, kernel and receiver for one update at 9 in a datagram, in alternation.
void SealedBesidePlain(benchmark::State& state) {
  Ends plain(0, false), sealed(1, true);
  reckon::bench::Blocks plain_ns, sealed_ns, ratio;
  bool whole = true;
  for (auto _ : state) {
    const double without = update_ns(plain, whole);
    const double with = update_ns(sealed, whole);
    plain_ns.add(without);
    sealed_ns.add(with);
    ratio.add(with / without);
  }
  if (!whole) return state.SkipWithError("a bundle was lost");
  plain_ns.report(state, "plain_ns");
  sealed_ns.report(state, "sealed_ns");
  ratio.report(state, "ratio");
}
BENCHMARK(SealedBesidePlain)->Unit(benchmark::kMillisecond);

// A datagram of `size` octets in total, with the objects that seal and open it.
struct Envelope {
  explicit Envelope(const benchmark::State& state)
      : key(group_key(1,
                      state.range(1) == 0 ? peer::SealingSuite::xchacha20_poly1305 : fast_suite())),
        sealer(key, 1, 1),
        opener(key, {}),
        plain(static_cast<std::size_t>(state.range(0)) - peer::kEnvelope, std::byte{42}) {}

  SealedVerdict open(const Octets& datagram) {
    return opener.open(arrived(datagram, from, 1s), nanoseconds::min(), 1s, room).verdict;
  }

  peer::GroupKey key;
  EnvelopeSealer sealer;
  EnvelopeOpener opener;
  Octets plain;
  nanoseconds now = 1s;
  peer::IpEndpoint from = address(1);
  std::vector<std::byte> room = std::vector<std::byte>(peer::kMaxDatagram);
};

void Seal(benchmark::State& state) {
  Envelope e(state);
  for (auto _ : state)
    benchmark::DoNotOptimize(
        e.sealer.seal(peer::SealingStream::datagrams, 0, group_of(), e.now += 10us, e.plain, e.room)
            .data());
}

void Open(benchmark::State& state) {
  Envelope e(state);
  constexpr std::size_t kMany = 4096;
  std::vector<Octets> datagrams(kMany);
  std::size_t next = kMany;
  for (auto _ : state) {
    if (next == kMany) {
      state.PauseTiming();
      for (Octets& datagram : datagrams) datagram = sealed(e.sealer, e.plain);
      next = 0;
      state.ResumeTiming();
    }
    if (e.open(datagrams[next++]) != SealedVerdict::opened)
      return state.SkipWithError("not opened");
  }
}

/// Opens one genuine datagram, then times the refusal of `bad` with `verdict`.
void refuse(benchmark::State& state, Envelope& e, const Octets& bad, SealedVerdict verdict) {
  if (e.open(sealed(e.sealer, e.plain)) != SealedVerdict::opened || e.open(bad) != verdict)
    return state.SkipWithError("another verdict");
  for (auto _ : state) benchmark::DoNotOptimize(e.open(bad));
}

void RefuseForged(benchmark::State& state) {
  Envelope e(state);
  Octets bad = sealed(e.sealer, e.plain);
  bad.back() ^= std::byte{1};
  refuse(state, e, bad, SealedVerdict::forged);
}

void RefuseUnknownBoot(benchmark::State& state) {
  Envelope e(state);
  Octets bad = sealed(e.sealer, e.plain);
  bad[8] ^= std::byte{1};
  refuse(state, e, bad, SealedVerdict::forged);
}

void RefuseReplay(benchmark::State& state) {
  Envelope e(state);
  const Octets taken = sealed(e.sealer, e.plain);
  static_cast<void>(e.open(taken));
  refuse(state, e, taken, SealedVerdict::replayed);
}

void RefusePlain(benchmark::State& state) {
  Envelope e(state);
  refuse(state, e, Octets(static_cast<std::size_t>(state.range(0)), std::byte{7}),
         SealedVerdict::plain);
}

void sizes(benchmark::internal::Benchmark* bench) {
  bench->ArgNames({"octets", "aes"});
  for (const int octets : {144, 208, 1400})
    for (const int suite : {1, 0}) bench->Args({octets, suite});
}
BENCHMARK(Seal)->Apply(sizes);
BENCHMARK(Open)->Apply(sizes);
BENCHMARK(RefuseForged)->Apply(sizes);
BENCHMARK(RefuseUnknownBoot)->Apply(sizes);
BENCHMARK(RefuseReplay)->Apply(sizes);
BENCHMARK(RefusePlain)->Apply(sizes);

// Flipped, cut, spliced, moved to another epoch, boot, stream and count, replayed. An iteration is
// 100,000: for ten million use --benchmark_filter=Forgeries --benchmark_min_time=10.
void Forgeries(benchmark::State& state) {
  constexpr std::uint64_t kForgeries = 100'000;
  const peer::GroupKey key = group_key(2, fast_suite());
  std::uint64_t made = 0, taken = 0;
  std::uint32_t seed = 0;
  for (auto _ : state) {
    Forger forger(key, 208, ++seed);
    EnvelopeOpener opener(key, {});
    taken += taken_of(forger, opener, kForgeries);
    made += kForgeries;
  }
  state.counters["made"] = static_cast<double>(made);
  state.counters["taken"] = static_cast<double>(taken);
  if (taken > 0) state.SkipWithError("a forgery was taken");
}
BENCHMARK(Forgeries)->Unit(benchmark::kMillisecond);

// 100,000 restarts of one member: (epoch, sealer, salt, stamp, stream, count) identifies key and
// nonce.
void Restarts(benchmark::State& state) {
  constexpr int kRestarts = 1000;
  const peer::GroupKey key = group_key(1, fast_suite());
  std::set<std::tuple<std::uint16_t, peer::Sealer, std::uint64_t, std::uint32_t, std::uint16_t,
                      std::uint64_t>>
      used;
  const Octets plain(8);
  std::size_t datagrams = 0;
  for (auto _ : state) {
    for (int i = 0; i < kRestarts; ++i) {
      EnvelopeSealer sealer(key, 1, 1);
      for (int k = 0; k < 4; ++k, ++datagrams) {
        const auto stream =
            k % 2 == 0 ? peer::SealingStream::datagrams : peer::SealingStream::control;
        const auto header = *peer::read_envelope(sealed(sealer, plain, stream));
        used.emplace(header.epoch, header.sealer, header.salt, header.stamp, header.stream,
                     header.count);
      }
    }
  }
  state.counters["restarts"] = static_cast<double>(state.iterations()) * kRestarts;
  state.counters["nonces_reused"] = static_cast<double>(datagrams - used.size());
  if (used.size() != datagrams) state.SkipWithError("a nonce was used twice");
}
BENCHMARK(Restarts)->Iterations(100)->Unit(benchmark::kMillisecond);

}  // namespace
