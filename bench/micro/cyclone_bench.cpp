// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Entity updates through CycloneDDS and through this library, in alternation: 1,000 keys, best
// effort, multicast over loopback in a network namespace, batches below the MTU. CPU of the whole
// process, because Cyclone has threads of its own; this library has none here. This library puts
// updates into the table of remote entities; Cyclone's are read from a reader that keeps the last
// of each key.
#include <benchmark/benchmark.h>
#include <cyclone_update.h>
#include <dds/dds.h>

#include <array>
#include <chrono>
#include <exception>
#include <string>
#include <thread>

#include "reckon/bench/micro/blocks.hpp"
#include "reckon/bench/micro/transport_updates.hpp"
#include "reckon/peer/threads/cpu_time.hpp"

namespace reckon::peer {
namespace {

double process_cpu_ns() { return static_cast<double>(process_cpu_time().count()); }

// Two domains of one process that are one domain on the wire.
std::string configuration() {
  return "<General><Interfaces><NetworkInterface name=\"lo\" multicast=\"true\"/></Interfaces>"
         "<AllowMulticast>true</AllowMulticast><MaxMessageSize>1372B</MaxMessageSize>"
         "<FragmentSize>1344B</FragmentSize></General>"
         "<Discovery><ExternalDomainId>77</ExternalDomainId></Discovery>"
         "<Internal><SocketReceiveBufferSize min=\"4MB\"/></Internal>";
}

class Cyclone {
 public:
  Cyclone() {
    for (std::size_t i = 0; i < 2; ++i) {
      const auto id = static_cast<dds_domainid_t>(100 + i);
      domains_[i] = dds_create_domain(id, configuration().c_str());
      parties_[i] = dds_create_participant(id, nullptr, nullptr);
      topics_[i] = dds_create_topic(parties_[i], &reckon_bench_EntityUpdate_desc, "updates",
                                    nullptr, nullptr);
    }
    dds_qos_t* qos = dds_create_qos();
    dds_qset_reliability(qos, DDS_RELIABILITY_BEST_EFFORT, 0);
    dds_qset_history(qos, DDS_HISTORY_KEEP_LAST, 1);
    dds_write_set_batch(true);
    writer_ = dds_create_writer(parties_[0], topics_[0], qos, nullptr);
    reader_ = dds_create_reader(parties_[1], topics_[1], qos, nullptr);
    dds_delete_qos(qos);
    check(writer_ > 0 && reader_ > 0, "CycloneDDS gives no writer or no reader");
    for (int i = 0; i < 500 && !matched(); ++i) rest();
    check(matched(), "CycloneDDS: writer and reader do not find each other");
    static_cast<void>(turn());
  }
  ~Cyclone() {
    for (const dds_entity_t domain : domains_) dds_delete(domain);
  }
  Cyclone(const Cyclone&) = delete;
  Cyclone& operator=(const Cyclone&) = delete;

  /// CPU for each received update [ns], over a turn.
  double turn() {
    const double begin = process_cpu_ns();
    std::size_t came = 0;
    for (std::size_t round = 0; round < kRounds; ++round) {
      for (std::uint32_t i = 0; i < kEntities; ++i) {
        sample_.id = i;
        dds_write(writer_, &sample_);
      }
      dds_write_flush(writer_);
      std::size_t of_round = 0;
      for (int tries = 0; tries < 50 && of_round < kEntities; ++tries) {
        const std::size_t more = take();
        if (more == 0) rest();
        of_round += more;
      }
      came += of_round;
    }
    share_ = static_cast<double>(came) / static_cast<double>(kRounds * kEntities);
    check(came > 0, "CycloneDDS: nothing came through");
    return (process_cpu_ns() - begin) / static_cast<double>(came);
  }
  /// Share received in the last turn.
  [[nodiscard]] double share() const { return share_; }

 private:
  static void rest() { std::this_thread::sleep_for(std::chrono::milliseconds(2)); }
  [[nodiscard]] bool matched() const {
    dds_publication_matched_status_t status{};
    return dds_get_publication_matched_status(writer_, &status) == 0 && status.current_count > 0;
  }
  std::size_t take() {
    std::array<void*, 256> samples{};
    std::array<dds_sample_info_t, 256> infos;
    const dds_return_t count = dds_take(reader_, samples.data(), infos.data(), samples.size(),
                                        static_cast<std::uint32_t>(samples.size()));
    if (count <= 0) return 0;
    dds_return_loan(reader_, samples.data(), count);
    return static_cast<std::size_t>(count);
  }

  std::array<dds_entity_t, 2> domains_{}, parties_{}, topics_{};
  dds_entity_t writer_ = 0, reader_ = 0;
  reckon_bench_EntityUpdate sample_{};
  double share_ = 0;
};

void beside_cyclone(benchmark::State& state) {
  try {
    Cable::instance();
    Updates plain(kLoopback, next_group(), false, kPerDatagram);
    Updates offloaded(kLoopback, next_group(), true, kPerDatagram);
    Cyclone cyclone;
    bench::Blocks ours, fast, theirs, ratio, fast_ratio, came;
    for (auto _ : state) {
      const double mine = plain.turn().all(), quick = offloaded.turn().all();
      const double other = cyclone.turn();
      ours.add(mine);
      fast.add(quick);
      theirs.add(other);
      ratio.add(other / mine);
      fast_ratio.add(other / quick);
      came.add(cyclone.share());
    }
    ours.report(state, "ours_ns");
    fast.report(state, "ours_offload_ns");
    theirs.report(state, "cyclone_ns");
    ratio.report(state, "cyclone_over_ours");
    fast_ratio.report(state, "cyclone_over_offload");
    came.report(state, "cyclone_share_come");
  } catch (const std::exception& failure) {
    state.SkipWithError(failure.what());
  }
}
BENCHMARK(beside_cyclone)->Iterations(60);

}  // namespace
}  // namespace reckon::peer
