// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// A coupling study over sockets, compared sample for sample with the same study in one process.
#include "reckon/bench/coupling/udp_sample_link.hpp"

#include <gtest/gtest.h>

#include <array>
#include <future>
#include <random>
#include <stdexcept>
#include <string>
#include <vector>

#include "reckon/bench/baselines/coupling_simulation.hpp"

namespace reckon::bench {
namespace {

const peer::IpEndpoint kLoopback = peer::IpEndpoint::v4(0x7F000001, 0);

SampleQueue queue_of(const CouplingRun& run, CouplingSide side) {
  return {run.network, run.device.period, run.seed, side};
}

// One side in a thread of its own, as if it were a process.
std::vector<CouplingTrace> play(const CouplingRun& run, CouplingSide side, UdpSampleLink& link,
                                std::uint32_t samples) {
  CouplingPeer peer(run, side, link);
  std::vector<CouplingTrace> trace;
  for (std::uint32_t k = 0; k < samples; ++k) {
    peer.step();
    if (peer.has_hand()) trace.push_back({peer.position(), peer.force()});
  }
  return trace;
}

std::array<std::vector<CouplingTrace>, 2> over_sockets(const CouplingRun& run,
                                                       std::uint32_t samples) {
  UdpSampleLink first(kLoopback, queue_of(run, CouplingSide::first));
  UdpSampleLink second(kLoopback, queue_of(run, CouplingSide::second));
  first.connect(second.local());
  second.connect(first.local());
  auto other = std::async(std::launch::async,
                          [&] { return play(run, CouplingSide::second, second, samples); });
  auto own = play(run, CouplingSide::first, first, samples);
  return {std::move(own), other.get()};
}

TEST(UdpSampleLink, GivesEveryModeTheTraceOfOneProcess) {
  for (const auto counterpart : {Counterpart::hand, Counterpart::server})
    for (const CouplingMode mode : kCouplingModes) {
      CouplingRun run;
      run.mode = mode;
      run.counterpart = counterpart;
      run.environment = Environment(EnvironmentKind::linear, 400);
      run.network = peer::delayed_by(0.02, 0.5, 0.2);
      run.network.reorder = 0.1;
      run.update_hz = 100;
      run.duration = 1.5;
      run.keep_trace = true;
      const CouplingOutcome inside = simulate(run);
      ASSERT_GT(inside.peak_force, 0.1) << "the hands must meet";
      EXPECT_EQ(over_sockets(run, 1500), inside.trace) << name_of(mode);
    }
}

TEST(UdpSampleLink, NamesTheMissingSide) {
  CouplingRun run;
  UdpSampleLink link(kLoopback, queue_of(run, CouplingSide::first), std::chrono::milliseconds(1));
  link.connect(link.local());
  try {
    (void)link.receive(1);
    FAIL();
  } catch (const std::runtime_error& error) {
    EXPECT_NE(std::string(error.what()).find("sample 0 of the other side"), std::string::npos);
  }
}

TEST(SampleDatagram, RestoresTheWrittenSamples) {
  const CouplingSample sample{7, 0.1, -0.2, 3.5, 400, 1e-3, 2e-3, 3e-3};
  const std::array<SampleRecord, 2> records{to_record(7, sample), to_record(6, std::nullopt)};
  SampleDatagram datagram;
  const std::size_t size = encode_samples(records, datagram);
  ASSERT_EQ(size, 40U + 2 * (8 + 64));
  const SampleRecords read = decode_samples(std::span(datagram).first(size));
  ASSERT_EQ(read.count, 2U);
  EXPECT_EQ(from_record(read.records[0]), sample);
  EXPECT_EQ(read.records[1].number, 6U);
  EXPECT_FALSE(from_record(read.records[1]));
}

TEST(SampleDatagram, RefusesTruncatedOrForeignOctets) {
  const std::array<SampleRecord, 2> records{to_record(1, CouplingSample{}),
                                            to_record(0, CouplingSample{})};
  SampleDatagram datagram;
  const std::size_t size = encode_samples(records, datagram);
  for (std::size_t cut = 0; cut < size; ++cut)
    EXPECT_LT(decode_samples(std::span(datagram).first(cut)).count, 2U) << cut;
  std::mt19937 random(1);
  for (int i = 0; i < 20'000; ++i) {  // must not read beyond its end for any content
    SampleDatagram noise = datagram;
    for (int k = 0; k < 4; ++k) noise[random() % size] = static_cast<std::byte>(random());
    EXPECT_LE(decode_samples(std::span(noise).first(random() % (size + 1))).count, 2U);
  }
}

}  // namespace
}  // namespace reckon::bench
