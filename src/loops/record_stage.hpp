// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The shared records of a peer: takes the messages of others and sends its own.
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>

#include "reckon/aoim/area_of_interest_manager.hpp"
#include "reckon/peer/counters/counters.hpp"
#include "reckon/peer/loops/assured_stage.hpp"
#include "reckon/peer/loops/entity_sender.hpp"
#include "reckon/peer/reliable/shared_records.hpp"

namespace reckon::peer {

/// Thread of the model loop. Allocates when records are written or received.
class RecordStage final : public AssuredUser {
 public:
  /// References outlive this.
  RecordStage(Counters& counters, std::uint32_t epoch, const aoim::AreaOfInterestManager& aoim,
              AssuredStage& assured);

  /// Writes a record; false if there is no room. See SharedRecords::write().
  bool write(std::string_view key, std::span<const std::byte> value, const Pass& pass) {
    const bool is_written = records_.write(key, value, pass.now) == WriteResult::written;
    if (!is_written) refused_.add();
    return is_written;
  }
  [[nodiscard]] SharedRecords& records() noexcept { return records_; }
  [[nodiscard]] std::uint32_t epoch() const noexcept { return epoch_; }
  /// ID of the peer with this epoch; 0:0 if there is none.
  [[nodiscard]] aoim::PeerId peer_of(std::uint32_t epoch) const noexcept {
    return aoim_.presence().id_of(epoch).value_or(aoim::PeerId{});
  }

  /// Sends what is due.
  void step(const Pass& pass);
  [[nodiscard]] std::chrono::nanoseconds next_step() const noexcept { return records_.next_step(); }

  [[nodiscard]] bool take_record(const UserRecord& record) noexcept override;
  void settle(const AssuredReport&) noexcept override {}

 private:
  void publish_counts() noexcept;

  std::uint32_t epoch_;
  const aoim::AreaOfInterestManager& aoim_;
  AssuredStage& assured_;
  SharedRecords records_;
  std::size_t peers_ = 0;
  std::chrono::nanoseconds now_{0};
  Counter &taken_, &requested_, &repaired_, &refused_, &missed_;
  SharedRecordCounts published_;
};

}  // namespace reckon::peer
