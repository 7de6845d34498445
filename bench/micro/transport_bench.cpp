// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Entity updates end to end, beside bare loops that send and read octets without decoding: encode,
// bundle and send; receive, decode and the table of remote entities. They alternate, in CPU time of
// one thread that does both sides, so that other load affects all equally. Over loopback and over a
// cable between two network namespaces of its own (needs root). Each row first checks that all
// updates arrived and are in the table.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <exception>
#include <map>
#include <stdexcept>
#include <string>

#include "reckon/bench/micro/blocks.hpp"
#include "reckon/bench/micro/transport_updates.hpp"

namespace reckon::peer {
namespace {

/// Measurements that alternate, by name.
class Rows {
 public:
  bench::Blocks& operator[](const char* name) { return rows_[name]; }
  void report(benchmark::State& state) {
    for (auto& [name, blocks] : rows_) blocks.report(state, name);
  }

 private:
  std::map<std::string, bench::Blocks> rows_;
};

void add_stages(Rows& rows, const Stages& ours, double plain) {
  rows["ours9_ns"].add(ours.all());
  rows["ours9_over_bare9"].add(ours.all() / plain);
  rows["encode_bundle_ns"].add(ours.bundle);
  rows["send_ns"].add(ours.send);
  rows["receive_ns"].add(ours.receive);
  rows["decode_table_ns"].add(ours.table);
  rows["link9_over_bare9"].add((ours.send + ours.receive) / plain);
}

void add_offloaded(Rows& rows, const Stages& fast, const Stages& ours, double plain) {
  rows["offload9_ns"].add(fast.all());
  rows["offload9_over_bare9"].add(fast.all() / plain);
  rows["offload_gain"].add(ours.all() / fast.all());
  rows["offload_table_ns"].add(fast.table);
  rows["offload_send_ns"].add(fast.send);
  rows["offload_receive_ns"].add(fast.receive);
  rows["slower_side_Mps"].add(1e3 / std::max(fast.out(), fast.in()));
}

void add_watched(Rows& rows, const Stages& watched) {
  rows["watched9_ns"].add(watched.all());
  rows["watched_table_ns"].add(watched.table);
}

void add_behind(Rows& rows, const Stages& late) {
  rows["newest_table_ns"].add(late.table);
  rows["newest_out_ns"].add(late.out());
  rows["newest_in_ns"].add(late.in());
  rows["newest_slower_side_Mps"].add(1e3 / std::max(late.out(), late.in()));
}

/// Bundles of nine with and without offload, one update in a datagram, and the bare loops of both.
void end_to_end(benchmark::State& state, const Way& way) {
  try {
    Cable::instance();
    BareLoop bare(way, kPerDatagram * kUpdate, next_group()), bare_one(way, kUpdate, next_group());
    Updates bundled(way, next_group(), false, kPerDatagram);
    Updates offloaded(way, next_group(), true, kPerDatagram);
    Updates watched(way, next_group(), true, kPerDatagram);
    Updates behind(way, next_group(), true, kPerDatagram);
    Updates single(way, next_group(), false, 1), single_offloaded(way, next_group(), true, 1);
    Rows rows;
    for (auto _ : state) {
      const double plain = bare.turn() / kPerDatagram;
      const Stages ours = bundled.turn();
      rows["bare9_ns"].add(plain);
      add_stages(rows, ours, plain);
      add_offloaded(rows, offloaded.turn(), ours, plain);
      add_watched(rows, watched.turn_watched());
      add_behind(rows, behind.turn_behind());
      const double alone = bare_one.turn(), one = single.turn().all();
      rows["bare1_ns"].add(alone);
      rows["ours1_ns"].add(one);
      rows["ours1_over_bare1"].add(one / alone);
      rows["offload1_over_bare1"].add(single_offloaded.turn().all() / alone);
    }
    if (!offloaded.sender().offload().segments) throw std::runtime_error("no UDP_SEGMENT here");
    rows.report(state);
    state.counters["newest_taken_share"] = behind.taken_share();
  } catch (const std::exception& failure) {
    state.SkipWithError(failure.what());
  }
}
BENCHMARK_CAPTURE(end_to_end, loopback, kLoopback);
BENCHMARK_CAPTURE(end_to_end, namespaces, kNamespaces);

}  // namespace
}  // namespace reckon::peer
