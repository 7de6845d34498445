// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Entity updates end to end, beside bare loops that send and read octets and look at none: encode,
// bundle and send; receive, decode and the table of remote entities. Rivals take turns, in CPU time
// of one thread that does both sides, so that load elsewhere hits all alike. Over loopback and over
// a cable between two network namespaces of its own (needs root). First each row looks whether all
// arrived and the table has it.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <exception>
#include <stdexcept>

#include "reckon/bench/blocks.hpp"
#include "reckon/bench/transport_updates.hpp"

namespace reckon::peer {
namespace {

/// Bundles of nine with and without offload, one update a datagram, and the bare loops of both.
void end_to_end(benchmark::State& state, const Way& way) {
  try {
    Cable::instance();
    BareLoop bare(way, kPerDatagram * kUpdate, next_group()), bare_one(way, kUpdate, next_group());
    Updates bundled(way, next_group(), false, kPerDatagram);
    Updates offloaded(way, next_group(), true, kPerDatagram);
    Updates behind(way, next_group(), true, kPerDatagram);
    Updates single(way, next_group(), false, 1);
    bench::Blocks bare_ns, bare_one_ns, ours_ns, ratio, gain, offload_ns, one_ratio, one_ns;
    bench::Blocks bundle, send, receive, table, fast_send, fast_receive, rate, carried, fast_ratio;
    bench::Blocks behind_table, behind_rate;
    for (auto _ : state) {
      const double plain = bare.turn() / kPerDatagram;
      const Stages ours = bundled.turn();
      const Stages fast = offloaded.turn();
      const Stages late = behind.turn_behind();
      const double alone = bare_one.turn();
      const double one = single.turn().all();
      bare_ns.add(plain);
      bare_one_ns.add(alone);
      ours_ns.add(ours.all());
      ratio.add(ours.all() / plain);
      bundle.add(ours.bundle);
      send.add(ours.send);
      receive.add(ours.receive);
      table.add(ours.table);
      carried.add((ours.send + ours.receive) / plain);
      offload_ns.add(fast.all());
      fast_ratio.add(fast.all() / plain);
      gain.add(ours.all() / fast.all());
      fast_send.add(fast.send);
      fast_receive.add(fast.receive);
      rate.add(1e3 / std::max(fast.out(), fast.in()));
      behind_table.add(late.table);
      behind_rate.add(1e3 / std::max(late.out(), late.in()));
      one_ns.add(one);
      one_ratio.add(one / alone);
    }
    if (!offloaded.sender().offload().segments) throw std::runtime_error("no UDP_SEGMENT here");
    bare_ns.report(state, "bare9_ns");
    ours_ns.report(state, "ours9_ns");
    ratio.report(state, "ours9_over_bare9");
    bundle.report(state, "encode_bundle_ns");
    send.report(state, "send_ns");
    receive.report(state, "receive_ns");
    table.report(state, "decode_table_ns");
    carried.report(state, "link9_over_bare9");
    offload_ns.report(state, "offload9_ns");
    fast_send.report(state, "offload_send_ns");
    fast_receive.report(state, "offload_receive_ns");
    fast_ratio.report(state, "offload9_over_bare9");
    gain.report(state, "offload_gain");
    rate.report(state, "slower_side_Mps");
    behind_table.report(state, "newest_table_ns");
    behind_rate.report(state, "newest_slower_side_Mps");
    state.counters["newest_taken_share"] = behind.taken_share();
    bare_one_ns.report(state, "bare1_ns");
    one_ns.report(state, "ours1_ns");
    one_ratio.report(state, "ours1_over_bare1");
  } catch (const std::exception& failure) {
    state.SkipWithError(failure.what());
  }
}
BENCHMARK_CAPTURE(end_to_end, loopback, kLoopback);
BENCHMARK_CAPTURE(end_to_end, namespaces, kNamespaces);

}  // namespace
}  // namespace reckon::peer
