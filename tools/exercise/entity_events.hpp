// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Prints a line for each remote entity that appears or goes. It covers all entities that a peer
// receives, also beyond the capacity of a view.
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

/// Follows the table of remote entities by its changes; needs PeerOptions::record_changes. An
/// entity that comes and goes between two calls of report() is not reported. The model loop's
/// thread gathers the changes, another thread reports them; neither waits for the other.
///
/// peer.model().set_guest(&events);  // while the loops are stopped
///   ...
///   events.report(elapsed, stdout);
class EntityEvents final : public peer::ModelGuest {
 public:
  /// @param entities most rows of the table: [network] entities of the scene
  explicit EntityEvents(std::size_t entities) : letters_(entities) {}

  void begin_pass(peer::ModelLoop& loop) noexcept override;
  void receive(const pdu::PduHeader& header, std::span<const std::byte> octets,
               const peer::InteractionSender& sender) noexcept override;
  void end_pass(peer::ModelLoop& loop) noexcept override;

  /// Writes the entities that came and went since the last call as JSON Lines: first the ones that
  /// went, in the order of the changes. @param elapsed [s] since the start
  void report(double elapsed, std::FILE* out);
  /// The same, including changes that are not gathered yet. Only after the loops have stopped.
  void report_rest(peer::ModelLoop& loop, double elapsed, std::FILE* out);

  /// Remote entities that have appeared and not gone.
  [[nodiscard]] std::size_t present() const noexcept { return known_.size(); }

 private:
  struct Heard {
    pdu::EntityId id;
    std::array<char, 12> marking{};
    std::uint64_t updates = 0;
  };
  // Has room for a whole table, so that the loop allocates nothing; pages are used only as it
  // fills.
  struct Letter {
    explicit Letter(std::size_t entities);
    std::vector<Heard> heard;  // new or changed
    std::vector<pdu::EntityId> removed;
  };

  peer::LetterBox<Letter> letters_;
  std::map<pdu::EntityId, Heard> known_;  // used by the reporting thread
};

}  // namespace reckon::tools
