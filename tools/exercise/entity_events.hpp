// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// A line for each remote entity that appears or goes, of all that a peer hears: not only of those
// that a picture has room for.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <map>
#include <vector>

#include "reckon/pdu/codec/records.hpp"
#include "reckon/peer/federation/mailbox.hpp"
#include "reckon/peer/loops/model_loop.hpp"

namespace reckon::tools {

/// Follows the table of remote entities through its changes, which needs
/// PeerOptions::record_changes. One that comes and goes between two calls of report() is not
/// reported. The model loop's thread gathers, another one reports; neither waits for the other.
///
///   peer.model().receive(&events);  // while the loops stand still
///   ...
///   events.report(elapsed, stdout);
class EntityEvents final : public peer::ModelGuest {
 public:
  void begin_pass(peer::ModelLoop& loop) noexcept override;
  void hear(const pdu::PduHeader& header, std::span<const std::byte> octets,
            const peer::InteractionSender& sender) noexcept override;
  void end_pass(peer::ModelLoop& loop) noexcept override;

  /// Writes what has come and gone since the last call as JSON Lines: entities that went first, in
  /// the order of the changes. @param elapsed [s] since the start
  void report(double elapsed, std::FILE* out);
  /// The same with what has not been gathered yet, once the loops stand still.
  void report_rest(peer::ModelLoop& loop, double elapsed, std::FILE* out);

  /// Remote entities that have appeared and not gone.
  [[nodiscard]] std::size_t present() const noexcept { return known_.size(); }

 private:
  struct Heard {
    pdu::EntityId id;
    std::array<char, 12> marking{};
    std::uint64_t updates = 0;
  };
  // With room for a whole table, so that the loop allocates nothing; memory is taken as it is used.
  struct Letter {
    Letter();
    std::vector<Heard> heard;  // that have come or changed
    std::vector<pdu::EntityId> removed;
  };

  peer::LetterBox<Letter> letters_;
  std::map<pdu::EntityId, Heard> known_;  // the reporting thread's
};

}  // namespace reckon::tools
