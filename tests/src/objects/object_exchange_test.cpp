// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Transfer of objects between hosts that lose datagrams, join late, fail, and lie.
#include "reckon/peer/objects/object_exchange.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <optional>
#include <tuple>

#include "reckon/tests/src/support/object_hosts.hpp"

namespace reckon::test {
namespace {

using namespace std::chrono_literals;
using peer::FetchState;
using peer::object_of;

peer::ImpairmentLaw lossy(double loss) {
  peer::ImpairmentLaw law;
  law.loss = loss;
  law.delay = 100us;
  return law;
}

class ObjectTransfer : public testing::TestWithParam<double> {};

// 10 MiB to A and B at once, to C after 0.5 s and to D after the end. Unavoidable are 2.6 passes:
// one for A and B, the 0.6 that C missed, and one for D, each over the share that arrives.
TEST_P(ObjectTransfer, TakesFewMoreOctetsThanUnavoidable) {
  const double loss = GetParam();
  constexpr std::array<double, 4> kJoins{0.0, 0.0, 0.5, 4.0};
  ObjectHosts hosts(5, lossy(loss), 7);
  const std::string octets = random_octets(10 << 20);
  const auto source = object_of(octets);
  hosts.serve(0, source);
  std::array<std::optional<MemoryFetch>, 4> fetches;
  std::array<double, 4> took{-1, -1, -1, -1};
  const auto begin = hosts.clock().now();
  hosts.run(12s, [&] {
    const double time = std::chrono::duration<double>(hosts.clock().now() - begin).count();
    for (std::size_t i = 0; i < fetches.size(); ++i) {
      if (!fetches[i] && time >= kJoins[i])
        fetches[i].emplace(hosts.host(i + 1), source->hash(), octets.size());
      if (took[i] < 0 && fetches[i] && fetches[i]->is_complete()) took[i] = time - kJoins[i];
    }
    return std::ranges::all_of(took, [](double one) { return one >= 0; });
  });
  // Measured 1.031 to 1.059; the headers alone are 1.034.
  const double passes = static_cast<double>(hosts.octets_sent()) / static_cast<double>(10 << 20);
  EXPECT_LE(passes, 1.1 * 2.6 / (1 - loss));
  // NORM with 32 parity segments needs 1.86, 1.86, 1.37 and 1.27 s at 30 %, and more is allowed.
  const std::array<double, 4> bars{2.33, 2.33, 1.71, 1.59};
  for (std::size_t i = 0; i < took.size(); ++i) {
    EXPECT_GT(took[i], 0) << i;
    EXPECT_LE(took[i], bars[i]) << i;
    ASSERT_TRUE(fetches[i]);
    EXPECT_EQ(fetches[i]->store.octets(), octets) << i;
  }
}

INSTANTIATE_TEST_SUITE_P(Losses, ObjectTransfer, testing::Values(0.0, 0.05, 0.1, 0.2, 0.3));

TEST(ObjectTransfer, WorksForEachLength) {
  for (const std::size_t size : {0, 1, 1279, 1280, 1281, 81919, 81920, 81921, 3276800, 3358720}) {
    ObjectHosts hosts(2, lossy(0.2));
    const std::string octets = random_octets(size);
    hosts.serve(0, object_of(octets));
    const MemoryFetch one(hosts.host(1), object_of(octets)->hash(), size);
    EXPECT_GT(hosts.run(10s, [&] { return one.is_complete(); }), 0) << size;
    EXPECT_EQ(one.store.octets(), octets) << size;
  }
}

TEST(ObjectTransfer, OfSeveralObjectsSharesTheRate) {
  ObjectHosts hosts(3, lossy(0.05));
  std::vector<std::string> all;
  for (std::uint64_t i = 0; i < 4; ++i) {
    all.push_back(random_octets(1 << 20, i));
    hosts.serve(0, object_of(all.back()));
  }
  std::vector<std::unique_ptr<MemoryFetch>> fetches;
  for (std::size_t i = 0; i < 8; ++i)
    fetches.push_back(std::make_unique<MemoryFetch>(
        hosts.host(1 + i / 4), object_of(all[i % 4])->hash(), all[i % 4].size()));
  const double took = hosts.run(10s, [&] {
    return std::ranges::all_of(fetches, [](const auto& one) { return one->is_complete(); });
  });
  EXPECT_GT(took, 4.0 * (1 << 20) / 12.5e6) << "no faster than the rate";
  EXPECT_LT(took, 1.2);
  for (std::size_t i = 0; i < 8; ++i) EXPECT_EQ(fetches[i]->store.octets(), all[i % 4]);
}

TEST(ObjectTransfer, IsServedByOneOfManyHolders) {
  ObjectHosts hosts(9, lossy(0.0));
  const std::string octets = random_octets(2 << 20);
  for (std::size_t i = 0; i < 8; ++i) hosts.serve(i, object_of(octets));
  const MemoryFetch one(hosts.host(8), object_of(octets)->hash(), octets.size());
  EXPECT_GT(hosts.run(5s, [&] { return one.is_complete(); }), 0);
  // A second server may have begun within the delay of the network.
  EXPECT_LT(static_cast<double>(hosts.octets_sent()), 1.1 * (2 << 20));
}

TEST(ObjectTransfer, GoesOnWhenTheServerFails) {
  for (const bool cut_only : {false, true}) {
    ObjectHosts hosts(4, lossy(0.1));
    const std::string octets = random_octets(6 << 20);
    const auto source = object_of(octets);
    hosts.serve(0, source);
    const MemoryFetch one(hosts.host(2), source->hash(), octets.size());
    const MemoryFetch other(hosts.host(3), source->hash(), octets.size());
    hosts.run(200ms, [] { return false; });
    EXPECT_GT(one.fetch->received().count(), 1000u);
    hosts.serve(1, source);
    if (cut_only) {
      for (std::size_t i = 1; i < 4; ++i) hosts.network().impair(i, 0, lossy(1.0));
    } else {
      hosts.kill(0);
    }
    const double took = hosts.run(10s, [&] { return one.is_complete() && other.is_complete(); });
    EXPECT_GT(took, 0) << cut_only;
    EXPECT_LT(took, 3.5) << cut_only;
    EXPECT_EQ(one.store.octets(), octets);
  }
}

TEST(ObjectTransfer, EndsAfterASecondWithoutAnyDatagram) {
  peer::ImpairmentLaw law = lossy(0.05);
  law.outages = {{300ms, 1s, 0s}};
  ObjectHosts hosts(3, law);
  const std::string octets = random_octets(6 << 20);
  const auto source = object_of(octets);
  hosts.serve(0, source);
  const MemoryFetch one(hosts.host(1), source->hash(), octets.size());
  const double took = hosts.run(10s, [&] { return one.is_complete(); });
  EXPECT_GT(took, 1.3);
  EXPECT_LT(took, 3.3) << "within 2 s after the cut";
}

void receive_all_but(std::uint32_t lost, const peer::ObjectSource& source, peer::ObjectFetch& fetch,
                     std::chrono::nanoseconds now) {
  pdu::ObjectRequest begin;
  std::array<std::byte, 1200> room;
  EXPECT_GT(fetch.take_request(now + 10ms, begin, room), 0u) << "the request that began it";
  for (std::uint32_t i = 0; i < source.layout().chunks(); ++i) {
    std::vector<std::byte> chunk(source.layout().length(i));
    ASSERT_TRUE(source.read_chunk(i, chunk));
    if (i != lost) fetch.take_chunk(100, i + 1, i, chunk, now);
  }
}

TEST(ObjectTransfer, StopsWhenItsReceiversAreGone) {
  ObjectHosts hosts(2, lossy(0.0));
  const std::string octets = random_octets(30 << 20);
  hosts.serve(0, object_of(octets));
  {
    const MemoryFetch one(hosts.host(1), object_of(octets)->hash(), octets.size());
    hosts.run(200ms, [] { return false; });
  }
  hosts.run(4s, [] { return false; });
  EXPECT_LT(static_cast<double>(hosts.octets_sent()), 1.35 * 12.5e6);
}

// 64 receivers, each of which has lost the same chunk.
TEST(ObjectTransfer, OfOneLostChunkTakesFewRequests) {
  for (const double loss : {0.0, 0.05}) {
    double requests = 0, repairs = 0;
    constexpr int kRuns = 50;
    for (int run = 0; run < kRuns; ++run) {
      ObjectHosts hosts(65, lossy(0), static_cast<std::uint64_t>(run) + 1);
      const std::string octets = random_octets(100'000);
      const auto source = object_of(octets);
      hosts.serve(0, source);
      std::vector<std::unique_ptr<MemoryFetch>> fetches;
      for (std::size_t i = 1; i < 65; ++i) {
        fetches.push_back(
            std::make_unique<MemoryFetch>(hosts.host(i), source->hash(), octets.size()));
        receive_all_but(40, *source, *fetches.back()->fetch, hosts.clock().now());
        fetches.back()->fetch->take_status(100, 1000, 0, hosts.clock().now());
      }
      hosts.network().impair(lossy(loss));
      ASSERT_GT(hosts.run(2s,
                          [&] {
                            return std::ranges::all_of(
                                fetches, [](const auto& one) { return one->is_complete(); });
                          }),
                0);
      for (std::size_t i = 1; i < 65; ++i)
        requests += static_cast<double>(hosts.host(i).counts().requests_sent);
      repairs += static_cast<double>(hosts.host(0).counts().chunks_sent);
    }
    EXPECT_LT(requests / kRuns, 4) << loss;
    EXPECT_LT(repairs / kRuns, 3) << loss;
  }
}

// A host that answers with other octets under the same key.
TEST(ObjectTransfer, RefusesForgedChunks) {
  ObjectHosts hosts(3, lossy(0.0));
  const std::string octets = random_octets(500'000);
  const auto source = object_of(octets);
  hosts.serve(0, source);
  const MemoryFetch one(hosts.host(1), source->hash(), octets.size());
  const std::string forged(1280, 'x');
  std::uint32_t index = 0;
  const double took = hosts.run(5s, [&] {
    if (index < 300)
      one.fetch->take_chunk(66, index + 1, index, std::as_bytes(std::span(forged)),
                            hosts.clock().now());
    ++index;
    return one.is_complete();
  });
  EXPECT_GT(took, 0);
  EXPECT_GT(one.fetch->counts().forged, 0u);
  EXPECT_EQ(one.store.octets(), octets);
}

TEST(ObjectTransfer, GivesUpIfEverythingIsForged) {
  ObjectHosts hosts(2, lossy(0.0));
  const auto source = object_of(random_octets(500));
  const MemoryFetch one(hosts.host(1), source->hash(), 500);
  const std::string forged(500, 'x');
  for (std::uint32_t i = 0; i < 1000; ++i) {
    one.fetch->take_chunk(66, i, 0, std::as_bytes(std::span(forged)).first(32), 1s);
    one.fetch->take_chunk(66, i, 1, std::as_bytes(std::span(forged)), 1s);
  }
  EXPECT_EQ(one.fetch->state(), FetchState::forged);
}

TEST(ObjectTransfer, RefusesChunksOfWrongLengthOrPlace) {
  ObjectHosts hosts(2, lossy(0.0));
  const auto source = object_of(random_octets(5000));
  const MemoryFetch one(hosts.host(1), source->hash(), 5000);
  const std::string chunk(1280, 'x');
  const auto octets = std::as_bytes(std::span(chunk));
  for (const auto& [index, length] : {std::pair<std::uint32_t, std::size_t>{0, 31},
                                      {0, 1280},
                                      {1, 0},
                                      {1, 1279},
                                      {4, 1280},
                                      {5, 1280},
                                      {0xFFFFFFFF, 1280}})
    one.fetch->take_chunk(66, 1, index, octets.first(length), 1s);
  EXPECT_EQ(one.fetch->counts().refused, 7u);
  EXPECT_EQ(one.fetch->received().count(), 0u);
}

}  // namespace
}  // namespace reckon::test
