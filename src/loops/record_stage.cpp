// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/peer/loops/record_stage.hpp"

#include <array>

namespace reckon::peer {
namespace {

/// Messages of one pass: a long repair must not delay the updates of entities.
constexpr int kMostOfPass = 8;

}  // namespace

RecordStage::RecordStage(Counters& counters, std::uint32_t epoch,
                         const aoim::AreaOfInterestManager& aoim, AssuredStage& assured)
    : epoch_(epoch),
      aoim_(aoim),
      assured_(assured),
      records_(epoch, epoch),
      taken_(counters.make("records_in", "shared records of others that were new or newer")),
      requested_(counters.make("records_requested", "requests for missing shared records")),
      repaired_(counters.make("records_repaired", "shared records sent for a request")),
      refused_(counters.make("records_refused",
                             "shared records without room, and damaged messages of them")),
      missed_(counters.make("records_missed",
                            "writers with writes that no peer had any more within 30 s")) {
  assured_.set_records(this);
}

bool RecordStage::take_record(const UserRecord& record) noexcept {
  return records_.take(record.kind, record.octets, now_);
}

void RecordStage::step(const Pass& pass) {
  now_ = pass.now;
  const std::size_t peers = aoim_.presence().peers().size();
  if (peers > peers_) records_.meet(pass.now);
  peers_ = peers;
  if (pass.now < records_.next_step()) return;
  std::array<std::byte, SharedRecords::kMostOctets> octets;
  pdu::AssuredKind kind = pdu::AssuredKind::none;
  for (int i = 0; i < kMostOfPass; ++i) {
    const std::size_t size = records_.take_due(pass.now, kind, octets);
    if (size == 0) break;
    assured_.send_once(kind, std::span(octets).first(size), 0, pass);
  }
  publish_counts();
}

void RecordStage::publish_counts() noexcept {
  const SharedRecordCounts& counts = records_.counts();
  taken_.add(counts.changed - published_.changed);
  requested_.add(counts.requests - published_.requests);
  repaired_.add(counts.repairs - published_.repairs);
  refused_.add(counts.refused - published_.refused);
  missed_.add(counts.missed - published_.missed);
  published_ = counts;
}

}  // namespace reckon::peer
