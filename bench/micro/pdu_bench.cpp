// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Cost of the wire format beside memcpy of the same octets in the same run. Every row first checks
// that the timed code gives the right octets.
#include <benchmark/benchmark.h>

#include <array>
#include <cstring>
#include <span>
#include <string>

#include "reckon/bench/micro/blocks.hpp"
#include "reckon/pdu/bundle.hpp"
#include "reckon/pdu/pdu_types.hpp"
#include "reckon/pdu/print.hpp"
#include "reckon/pdu/timestamp.hpp"
#include "reckon/tests/support/allocation_guard.hpp"

namespace {

using namespace reckon::pdu;

constexpr std::size_t kDatagram = 1352;  // octets, default capacity of one datagram
using Buffer = std::array<std::byte, kDatagram>;

const std::array<std::byte, 64>& four_parameters() {
  static const std::array<std::byte, 64> octets{};
  return octets;
}

EntityState moving_entity(std::size_t variable_parameters) {
  EntityState pdu;
  pdu.entity_id = {100, 7, 3};
  pdu.linear_velocity = {1.0F, 2.0F, 3.0F};
  pdu.location = {4437345.6789, 1061234.5, 4443210.0625};
  pdu.orientation = {0.1F, 0.2F, 0.3F};
  pdu.dead_reckoning.algorithm = DeadReckoningAlgorithm::rvw;
  pdu.dead_reckoning.angular_velocity = {0.01F, 0.02F, 0.03F};
  pdu.marking.set("HAND-1");
  pdu.variable_parameters = std::span(four_parameters()).first(16 * variable_parameters);
  return pdu;
}

void finish(benchmark::State& state, std::size_t octets) {
  state.counters["octets"] = static_cast<double>(octets);
}

void Memcpy(benchmark::State& state) {
  const auto octets = static_cast<std::size_t>(state.range(0));
  Buffer from{};
  Buffer to;
  for (auto _ : state) {
    benchmark::DoNotOptimize(from.data());
    std::memcpy(to.data(), from.data(), octets);
    benchmark::DoNotOptimize(to.data());
    benchmark::ClobberMemory();
  }
  finish(state, octets);
}
BENCHMARK(Memcpy)->Arg(144)->Arg(208)->Arg(1296);

// In the form that the compiler generates for a constant size.
template <std::size_t octets>
void MemcpyOfKnownSize(benchmark::State& state) {
  Buffer from{};
  Buffer to;
  for (auto _ : state) {
    benchmark::DoNotOptimize(from.data());
    std::memcpy(to.data(), from.data(), octets);
    benchmark::DoNotOptimize(to.data());
    benchmark::ClobberMemory();
  }
  finish(state, octets);
}
BENCHMARK(MemcpyOfKnownSize<144>);
BENCHMARK(MemcpyOfKnownSize<208>);

void EntityStateEncode(benchmark::State& state) {
  EntityState pdu = moving_entity(static_cast<std::size_t>(state.range(0)));
  Buffer out;
  EntityState back;
  const std::size_t octets = encode(pdu, out);
  if (decode(out, back) != DecodeError::none || back.entity_id != pdu.entity_id)
    state.SkipWithError("the Entity State did not come back");
  for (auto _ : state) {
    benchmark::DoNotOptimize(&pdu);
    benchmark::ClobberMemory();
    benchmark::DoNotOptimize(encode(pdu, out));
    benchmark::DoNotOptimize(out.data());
    benchmark::ClobberMemory();
  }
  finish(state, octets);
}
BENCHMARK(EntityStateEncode)->ArgName("parameters")->Arg(0)->Arg(4);

void EntityStateDecode(benchmark::State& state) {
  const EntityState pdu = moving_entity(static_cast<std::size_t>(state.range(0)));
  Buffer datagram;
  const std::size_t octets = encode(pdu, datagram);
  EntityState back;
  if (decode(std::span(datagram).first(octets), back) != DecodeError::none ||
      back.location != pdu.location)
    state.SkipWithError("the Entity State did not come back");
  for (auto _ : state) {
    benchmark::DoNotOptimize(datagram.data());
    benchmark::ClobberMemory();
    benchmark::DoNotOptimize(decode(std::span<const std::byte>(datagram).first(octets), back));
    benchmark::DoNotOptimize(&back);
    benchmark::ClobberMemory();
  }
  finish(state, octets);
}
BENCHMARK(EntityStateDecode)->ArgName("parameters")->Arg(0)->Arg(4);

// The limit: encode and decode take at most 5 times memcpy of the same octets. The three alternate
// in short blocks, so that other load on the machine affects all of them equally; the ratios are
// between neighbouring blocks, reported as median and 10th and 90th percentile.
void EntityStateAgainstMemcpy(benchmark::State& state) {
  EntityState pdu = moving_entity(static_cast<std::size_t>(state.range(0)));
  EntityState back;
  Buffer datagram;
  Buffer copy;
  const std::size_t octets = encode(pdu, datagram);
  const std::span<const std::byte> wire = std::span<const std::byte>(datagram).first(octets);
  if (decode(wire, back) != DecodeError::none || back.location != pdu.location)
    state.SkipWithError("the Entity State did not come back");
  reckon::bench::Blocks memcpy_ns, encode_ns, decode_ns, encode_ratio, decode_ratio;
  std::size_t allocations = 0;
  for (auto _ : state) {
    const double base = reckon::bench::nanoseconds_of([&] {
      benchmark::DoNotOptimize(datagram.data());
      std::memcpy(copy.data(), datagram.data(), octets);
      benchmark::DoNotOptimize(copy.data());
    });
    const reckon::test::AllocationGuard guard;
    const double encoding = reckon::bench::nanoseconds_of([&] {
      benchmark::DoNotOptimize(&pdu);
      benchmark::DoNotOptimize(encode(pdu, copy));
      benchmark::DoNotOptimize(copy.data());
    });
    const double decoding = reckon::bench::nanoseconds_of([&] {
      benchmark::DoNotOptimize(datagram.data());
      benchmark::DoNotOptimize(decode(wire, back));
      benchmark::DoNotOptimize(&back);
    });
    allocations += guard.count();
    memcpy_ns.add(base);
    encode_ns.add(encoding);
    decode_ns.add(decoding);
    encode_ratio.add(encoding / base);
    decode_ratio.add(decoding / base);
  }
  if (allocations > 0) state.SkipWithError("something was taken from the heap");
  memcpy_ns.report(state, "memcpy_ns");
  encode_ns.report(state, "encode_ns");
  decode_ns.report(state, "decode_ns");
  encode_ratio.report(state, "encode_ratio");
  decode_ratio.report(state, "decode_ratio");
  finish(state, octets);
}
BENCHMARK(EntityStateAgainstMemcpy)->ArgName("parameters")->Arg(0)->Arg(4);

HapticRecord sphere() {
  HapticRecord record;
  record.kind = ForceModelKind::sphere;
  record.k1 = 800.0F;
  record.radius = 0.01F;
  return record;
}

std::size_t write_attribute(std::span<std::byte> out, const HapticRecord& haptic) {
  AttributeWriter writer(out, Attribute{});
  EnergyAccountRecord energy;
  energy.counterpart = {200, 1, 9};
  if (!writer.begin_set({100, 7, 3}) || !writer.add(haptic) || !writer.add(energy)) return 0;
  return writer.finish();
}

// One haptic entity: a set with its force model and one energy account.
void AttributeWrite(benchmark::State& state) {
  Buffer out;
  HapticRecord haptic = sphere();
  const std::size_t octets = write_attribute(out, haptic);
  if (octets != 136) state.SkipWithError("the Attribute PDU has another size");
  for (auto _ : state) {
    benchmark::DoNotOptimize(&haptic);
    benchmark::ClobberMemory();
    benchmark::DoNotOptimize(write_attribute(out, haptic));
    benchmark::DoNotOptimize(out.data());
    benchmark::ClobberMemory();
  }
  finish(state, octets);
}
BENCHMARK(AttributeWrite);

// Traverses, checks and reads both records.
void AttributeRead(benchmark::State& state) {
  Buffer datagram;
  const std::size_t octets = write_attribute(datagram, sphere());
  float stiffness = 0.0F;
  for (auto _ : state) {
    benchmark::DoNotOptimize(datagram.data());
    benchmark::ClobberMemory();
    Attribute pdu;
    benchmark::DoNotOptimize(decode(datagram, pdu));
    for (const AttributeSet& set : AttributeReader(pdu)) {
      for (const AttributeRecord& record : set.records()) {
        HapticRecord haptic;
        EnergyAccountRecord energy;
        if (decode(record, haptic) == DecodeError::none) stiffness = haptic.k1;
        benchmark::DoNotOptimize(decode(record, energy));
        benchmark::DoNotOptimize(&energy);
      }
    }
    benchmark::DoNotOptimize(stiffness);
  }
  if (stiffness != 800.0F) state.SkipWithError("the force model did not come back");
  finish(state, octets);
}
BENCHMARK(AttributeRead);

std::size_t write_bundle(std::span<std::byte> out, const EntityState& pdu) {
  BundleWriter writer(out);
  while (writer.append(pdu)) {
  }
  if (!writer.append(DatagramTrailer{})) return 0;
  return writer.size();
}

// Nine Entity States and the trailer, 1320 octets.
void BundleWrite(benchmark::State& state) {
  Buffer out;
  EntityState pdu = moving_entity(0);
  const std::size_t octets = write_bundle(out, pdu);
  if (octets != 9 * 144 + 24) state.SkipWithError("the bundle has another size");
  for (auto _ : state) {
    benchmark::DoNotOptimize(&pdu);
    benchmark::ClobberMemory();
    benchmark::DoNotOptimize(write_bundle(out, pdu));
    benchmark::ClobberMemory();
  }
  finish(state, octets);
}
BENCHMARK(BundleWrite);

// Steps through the datagram and decodes all PDUs by the list of types.
void BundleRead(benchmark::State& state) {
  Buffer datagram;
  const std::size_t octets = write_bundle(datagram, moving_entity(0));
  std::size_t pdus = 0;
  for (auto _ : state) {
    benchmark::DoNotOptimize(datagram.data());
    benchmark::ClobberMemory();
    pdus = 0;
    for (const BundledPdu& pdu : BundleReader(std::span<const std::byte>(datagram).first(octets))) {
      const DecodeError error = visit(pdu.bytes, pdu.header, [&](const auto& typed) {
        benchmark::DoNotOptimize(&typed);
        ++pdus;
      });
      benchmark::DoNotOptimize(error);
    }
  }
  if (pdus != 10) state.SkipWithError("not all PDUs were read");
  finish(state, octets);
}
BENCHMARK(BundleRead);

// 56 octets that claim a datum of 2^32 - 1 bits.
void DatumBombRefused(benchmark::State& state) {
  Buffer datagram;
  const std::array<std::byte, 16> datum{};
  Data pdu;
  pdu.variable_datums = {1, datum};
  const std::size_t octets = encode(pdu, datagram);
  store_big_endian(datagram.data() + 44, 0xFFFFFFFFU);
  DecodeError error = DecodeError::none;
  for (auto _ : state) {
    benchmark::DoNotOptimize(datagram.data());
    benchmark::ClobberMemory();
    error = decode(std::span<const std::byte>(datagram).first(octets), pdu);
    benchmark::DoNotOptimize(&pdu);
  }
  if (error != DecodeError::record) state.SkipWithError("the datum was not refused");
  finish(state, octets);
}
BENCHMARK(DatumBombRefused);

void TimestampDifference(benchmark::State& state) {
  std::uint32_t from = 4294967094;
  std::uint32_t to = 500;
  if (difference_units(to, from) != 350) state.SkipWithError("the difference is wrong");
  for (auto _ : state) {
    benchmark::DoNotOptimize(from);
    benchmark::DoNotOptimize(to);
    benchmark::DoNotOptimize(difference(to, from));
  }
}
BENCHMARK(TimestampDifference);

void EntityStateJson(benchmark::State& state) {
  const EntityState pdu = moving_entity(4);
  std::array<char, 8192> text;
  std::size_t length = 0;
  for (auto _ : state) {
    TextSink sink{std::span<char>(text)};
    print_json(pdu, sink);
    length = sink.view().size();
    benchmark::DoNotOptimize(text.data());
    benchmark::ClobberMemory();
  }
  finish(state, length);
}
BENCHMARK(EntityStateJson);

}  // namespace
