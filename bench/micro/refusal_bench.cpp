// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Cost of refusing a datagram that was built to be expensive: the codec alone, and the row of the
// inspector with its sentence. Each row first checks the rule that refuses the datagram and that
// the codec does not allocate. Bounds: docs/robustness.md.
#include <benchmark/benchmark.h>

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "reckon/pdu/pdu_types.hpp"
#include "reckon/tests/support/allocation_guard.hpp"
#include "reckon/tools/datagrams/pdu_row.hpp"

namespace {

using namespace reckon;

using Octets = std::vector<std::byte>;

/// A Data PDU of 40 octets and `datums` empty variable datums, the last with a declared length of
/// 2^32 - 1 bits.
Octets datum_bomb(std::size_t datums) {
  Octets octets(40 + 8 * datums);
  (void)encode(pdu::Data{}, octets);
  pdu::store_big_endian(octets.data() + 8, static_cast<std::uint16_t>(octets.size()));
  pdu::store_big_endian(octets.data() + 36, static_cast<std::uint32_t>(datums));
  pdu::store_big_endian(octets.data() + octets.size() - 4, std::uint32_t{0xFFFFFFFF});
  return octets;
}

/// A PDU of 56 octets: its only datum declares 2^32 - 1 bits, and 8 octets are there.
Octets small_bomb() {
  Octets octets = datum_bomb(1);
  octets.resize(56);
  pdu::store_big_endian(octets.data() + 8, std::uint16_t{56});
  return octets;
}

/// The first octets of an Entity State with the declared length `length`.
Octets entity_state(std::size_t size, std::uint16_t length) {
  Octets octets(pdu::kFixedSize<pdu::EntityState>);
  (void)encode(pdu::EntityState{}, octets);
  pdu::store_big_endian(octets.data() + 8, length);
  octets.resize(size);
  return octets;
}

/// Reads the datagram like a receiver and returns the refusal of its first PDU.
pdu::DecodeError refuse(const Octets& octets) {
  auto error = pdu::DecodeError::none;
  for (const pdu::BundledPdu& bundled : pdu::BundleReader(octets)) {
    error = bundled.error;
    if (error == pdu::DecodeError::none)
      error = pdu::visit(bundled.bytes, bundled.header, [](const auto&) {});
    if (error != pdu::DecodeError::none) break;
  }
  return error;
}

void Codec(benchmark::State& state, const Octets& octets, std::string_view rule) {
  const test::AllocationGuard guard;
  const pdu::DecodeError error = refuse(octets);
  const std::size_t heap = guard.peak_octets();
  if (heap != 0) return state.SkipWithError("the codec took heap");
  if (pdu::rule(error) != rule) return state.SkipWithError("refused by another rule");
  for (auto _ : state) benchmark::DoNotOptimize(refuse(octets));
  state.counters["octets"] = static_cast<double>(octets.size());
  state.counters["heap"] = static_cast<double>(heap);
}

void Inspector(benchmark::State& state, const Octets& octets, std::string_view rule) {
  peer::SourceDatagram datagram;
  datagram.bytes = octets;
  tools::DatagramInspector inspector;
  std::string_view found;
  const auto inspect = [&] {
    inspector.inspect(datagram, [&](const tools::PduRow& row) {
      found = row.rule;
      return false;
    });
  };
  const test::AllocationGuard guard;
  inspect();
  const std::size_t heap = guard.peak_octets();
  if (found != rule) return state.SkipWithError("refused by another rule");
  for (auto _ : state) inspect();
  state.counters["octets"] = static_cast<double>(octets.size());
  state.counters["heap"] = static_cast<double>(heap);
}

struct Case {
  std::string name;
  Octets octets;
  std::string_view rule;
};

const std::vector<Case>& cases() {
  static const std::vector<Case> kCases{
      {"datum_bomb", small_bomb(), "E-RECORD"},
      {"datum_bomb_of_65504_octets", datum_bomb(8183), "E-RECORD"},
      {"1_octet", entity_state(1, 144), "E-TRUNCATED"},
      {"2_octets", entity_state(2, 144), "E-TRUNCATED"},
      {"length_0", entity_state(144, 0), "E-LENGTH"},
      {"length_65535", entity_state(144, 65535), "E-TRUNCATED"}};
  return kCases;
}

[[maybe_unused]] const bool kRegistered = [] {
  for (const Case& row : cases()) {
    benchmark::RegisterBenchmark(("Codec/" + row.name).c_str(), Codec, row.octets, row.rule);
    benchmark::RegisterBenchmark(("Inspector/" + row.name).c_str(), Inspector, row.octets,
                                 row.rule);
  }
  return true;
}();

}  // namespace
