// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Cost of every PDU type on its golden sample: two rows for each type of the list. Each row first
// checks that the sample is reproduced octet for octet, and that nothing was allocated on the heap.
// bench/micro/wire_costs.py makes one table of them.
#include <benchmark/benchmark.h>

#include <span>
#include <string>
#include <vector>

#include "reckon/pdu/pdu_types.hpp"
#include "reckon/pdu/type_names.hpp"
#include "reckon/tests/support/allocation_guard.hpp"
#include "reckon/tests/support/wire_samples.hpp"

namespace {

using namespace reckon::pdu;
using Octets = std::vector<std::byte>;

template <typename T>
Octets sample_of() {
  return reckon::test::sample_octets(snake_name(T::kPduType));
}

template <typename T>
bool comes_back(const Octets& sample) {
  T pdu;
  Octets again(sample.size());
  return decode(std::span(sample), pdu) == DecodeError::none &&
         encode(pdu, again) == sample.size() && again == sample;
}

void finish(benchmark::State& state, std::size_t octets, std::size_t allocations) {
  if (allocations > 0) state.SkipWithError("something was taken from the heap");
  state.counters["octets"] = static_cast<double>(octets);
}

template <typename T>
void Decode(benchmark::State& state) {
  Octets sample = sample_of<T>();
  if (!comes_back<T>(sample)) state.SkipWithError("the sample did not come back");
  T pdu;
  std::size_t allocations = 0;
  for (auto _ : state) {
    benchmark::DoNotOptimize(sample.data());
    benchmark::ClobberMemory();
    const reckon::test::AllocationGuard guard;
    benchmark::DoNotOptimize(decode(std::span<const std::byte>(sample), pdu));
    allocations += guard.count();
    benchmark::DoNotOptimize(&pdu);
    benchmark::ClobberMemory();
  }
  finish(state, sample.size(), allocations);
}

template <typename T>
void Encode(benchmark::State& state) {
  const Octets sample = sample_of<T>();
  if (!comes_back<T>(sample)) state.SkipWithError("the sample did not come back");
  T pdu;
  if (decode(std::span(sample), pdu) != DecodeError::none) state.SkipWithError("no such PDU");
  Octets out(sample.size());
  std::size_t allocations = 0;
  for (auto _ : state) {
    benchmark::DoNotOptimize(&pdu);
    benchmark::ClobberMemory();
    const reckon::test::AllocationGuard guard;
    benchmark::DoNotOptimize(encode(pdu, out));
    allocations += guard.count();
    benchmark::DoNotOptimize(out.data());
    benchmark::ClobberMemory();
  }
  finish(state, sample.size(), allocations);
}

template <typename... T>
bool add_rows(TypeList<T...>) {
  const auto add = []<typename Pdu>(std::type_identity<Pdu>) {
    const std::string name(snake_name(Pdu::kPduType));
    benchmark::RegisterBenchmark(("Decode/" + name).c_str(), Decode<Pdu>);
    benchmark::RegisterBenchmark(("Encode/" + name).c_str(), Encode<Pdu>);
  };
  (add(std::type_identity<T>{}), ...);
  return true;
}

[[maybe_unused]] const bool kAdded = add_rows(PduTypes{});

}  // namespace
