// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Rates of `reckon inspect` on a capture of 100,000 Entity States, one in a datagram, of 100
// entities: the complete verb, from opening the file (which is in the page cache) to the last octet
// written to /dev/null. One row for each view and output form, derived from the list of views; each
// row checks that all PDUs were counted.
#include <benchmark/benchmark.h>

#include <chrono>
#include <cstdio>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "reckon/pdu/entity/entity_state.hpp"
#include "reckon/pdu/timestamp.hpp"
#include "reckon/peer/capture/capture_file.hpp"
#include "reckon/tests/support/capture_builder.hpp"
#include "reckon/tools/datagrams/pdu_row.hpp"
#include "reckon/tools/inspect/view_list.hpp"
#include "reckon/tools/inspect_program.hpp"

namespace {

using namespace reckon;
using std::chrono::nanoseconds;

constexpr std::uint64_t kFrames = 100'000;
constexpr nanoseconds kStart = std::chrono::seconds(1'700'000'000);

/// Entities that move by their velocity, each with one update in 2 ms.
test::Octets datagram(std::uint64_t frame, nanoseconds time) {
  const auto entity = static_cast<std::uint16_t>(1 + frame % 100);
  const double seconds = std::chrono::duration<double>(time - kStart).count();
  pdu::EntityState pdu;
  pdu.header.timestamp = pdu::to_dis_timestamp(time, true);
  pdu.entity_id = {100, 7, entity};
  pdu.entity_type.kind = pdu::EntityKind::platform;
  pdu.entity_type.domain = pdu::EntityDomain::land;
  pdu.linear_velocity = {3, 4, 0};
  pdu.location = {4437345.6789 + 3 * seconds, 1061234.5 + 4 * seconds, 4443210.0625 + entity};
  pdu.dead_reckoning.algorithm = pdu::DeadReckoningAlgorithm::fpw;
  pdu.marking.set("ENTITY " + std::to_string(entity));
  test::Octets octets;
  test::append_pdu(octets, pdu);
  return octets;
}

/// The capture, written at the first call; deleted at the end of the program.
const std::string& capture_path() {
  static test::CaptureBuilder capture;
  static const std::string path = [] {
    for (std::uint64_t frame = 0; frame < kFrames; ++frame) {
      const nanoseconds time = kStart + frame * std::chrono::microseconds(20);
      capture.add(datagram(frame, time), time);
    }
    return capture.path();
  }();
  return path;
}

void set_rate(benchmark::State& state) {
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(kFrames));
}

// Only libpcap and the frame parser.
void ReadFile(benchmark::State& state) {
  (void)capture_path();  // writes the file
  for (auto _ : state) {
    const auto source = peer::open_capture(capture_path());
    peer::SourceDatagram datagram;
    while (source->next(datagram, {}) == peer::SourceEvent::datagram) {
      benchmark::DoNotOptimize(datagram.bytes.data());
    }
    if (source->report().datagrams != kFrames) state.SkipWithError("not all datagrams were read");
  }
  set_rate(state);
}
BENCHMARK(ReadFile)->Unit(benchmark::kMillisecond);

// With each PDU decoded and examined: the basis of every view.
void ReadFileAndDecode(benchmark::State& state) {
  (void)capture_path();  // writes the file
  for (auto _ : state) {
    const auto source = peer::open_capture(capture_path());
    tools::DatagramInspector inspector;
    peer::SourceDatagram datagram;
    while (source->next(datagram, {}) == peer::SourceEvent::datagram) {
      inspector.inspect(datagram, [](const tools::PduRow& row) {
        benchmark::DoNotOptimize(row.entity_state);
        return true;
      });
    }
    if (inspector.tally().of(tools::PduStatus::ok) != kFrames)
      state.SkipWithError("not all PDUs were good");
  }
  set_rate(state);
}
BENCHMARK(ReadFileAndDecode)->Unit(benchmark::kMillisecond);

using File = std::unique_ptr<std::FILE, decltype(&std::fclose)>;

void Inspect(benchmark::State& state, const std::vector<std::string>& words) {
  const File out(std::fopen("/dev/null", "w"), std::fclose);
  const File err(std::tmpfile(), std::fclose);
  tools::Console console;
  console.out = out.get();
  console.err = err.get();
  std::vector<std::string_view> arguments{"inspect", capture_path()};
  arguments.insert(arguments.end(), words.begin(), words.end());
  for (auto _ : state) {
    std::rewind(err.get());
    if (tools::run_inspect_program(arguments, console) != exit_status(tools::ExitCode::good))
      state.SkipWithError("inspect found faults in a good capture");
  }
  unsigned long long pdus = 0;
  std::rewind(err.get());
  if (std::fscanf(err.get(), "%llu PDUs", &pdus) != 1 || pdus != kFrames)
    state.SkipWithError("not all PDUs were seen");
  set_rate(state);
}

void add(const std::vector<std::string>& words) {
  std::string name = "Inspect";
  for (const std::string& word : words) name += '/' + word;
  benchmark::RegisterBenchmark(name.c_str(), [words](benchmark::State& state) {
    Inspect(state, words);
  })->Unit(benchmark::kMillisecond);
}

[[maybe_unused]] const bool kAdded = [] {
  for (const tools::InspectViewKind& kind : tools::inspect_views()) {
    const std::string view(kind.name);
    add({view});
    add({view, "--json"});
    if (kind.takes_csv) add({view, "--csv"});
  }
  add({"tail", "--full"});
  add({"tail", "--json", "--full"});
  add({"stats", "--where", "id == 100:*:* and kind == platform and speed < 10"});
  return true;
}();

}  // namespace
