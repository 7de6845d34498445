// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Two letters between a program and the model loop: the program's requests, and the events for the
// program. Neither side ever waits. While a letter is in use, further content is collected for the
// next one; only the newest update of an entity is kept.
#pragma once

#include <array>
#include <atomic>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "reckon/aoim/cells/position.hpp"
#include "reckon/aoim/groups/peer_id.hpp"
#include "reckon/deadreckon/motion/articulation.hpp"
#include "reckon/haptics/bodies/body_exchange.hpp"
#include "reckon/pdu/codec/enumerations.hpp"
#include "reckon/peer/federation/known_body.hpp"
#include "reckon/peer/reliable/undelivered.hpp"
#include "reckon/peer/world/entity_description.hpp"
#include "reckon/peer/world/interaction_sender.hpp"
#include "reckon/peer/world/remote_entities.hpp"
#include "reckon/peer/world/removal.hpp"
#include "reckon/peer/world/state_table.hpp"

namespace reckon::peer {

/// Requests of a program, in order.
struct Wishes {
  struct Register {
    EntityNumber number;
    EntityDescription description;
  };
  struct Move {
    EntityNumber number;
    EntityTruth truth;
  };
  struct Appearance {
    EntityNumber number;
    std::uint32_t appearance;
  };
  struct Parts {
    EntityNumber number;
    deadreckon::PartState parts;
  };
  struct Say {
    std::size_t offset, size;  ///< of the PDU in `octets`
    std::optional<aoim::Position> place;
    std::uint64_t assured = 0;  ///< tag of an assured message; 0: best effort
    bool ordered = false;       ///< see Order::per_source
  };
  struct Own {
    std::uint32_t body;
    bool acquire;  ///< false: divest
  };
  struct Record {
    std::string key;
    std::vector<std::byte> value;
  };
  std::vector<Record> records;
  std::vector<Register> registered;
  std::vector<Move> moved;
  std::vector<Appearance> appearances;
  std::vector<Parts> parts;
  std::vector<EntityNumber> removed;
  std::vector<Say> said;
  std::vector<std::byte> octets;
  std::vector<Own> owned;
  std::vector<haptics::BodyOrder> orders;

  [[nodiscard]] bool empty() const noexcept {
    return registered.empty() && moved.empty() && appearances.empty() && parts.empty() &&
           removed.empty() && said.empty() && owned.empty() && orders.empty() && records.empty();
  }
  void clear() noexcept {
    registered.clear();
    moved.clear();
    appearances.clear();
    parts.clear();
    removed.clear();
    said.clear();
    octets.clear();
    owned.clear();
    orders.clear();
    records.clear();
  }
};

/// Events since the last letter.
struct News {
  struct Heard {
    pdu::PduType type;
    std::size_t offset, size;  ///< of the PDU in `octets`
    InteractionSender sender;
  };
  struct Removed {
    pdu::EntityId id;
    Removal cause;
  };
  struct Record {
    std::string key;
    std::vector<std::byte> value;
    aoim::PeerId writer;
    bool is_ours = false;
    bool is_removed = false;  ///< there were too many
  };
  std::chrono::nanoseconds now{0}, utc{0};  ///< of the pass in which it was sent
  pdu::EntityId simulation;                 ///< of this peer, which may have been renamed
  std::vector<RemoteCopy> states;           ///< as of now
  std::vector<Removed> removed;             ///< one that is in `states` too has returned since
  std::vector<Heard> heard;
  std::vector<Undelivered> undelivered;
  std::vector<std::byte> octets;
  std::vector<KnownBody> bodies;       ///< all moving objects as of now, if the program reads them
  std::vector<std::uint32_t> refused;  ///< bodies whose orders had no effect
  std::vector<Record> records;         ///< that have changed
  std::vector<std::string> refused_records;  ///< keys of records without room
  std::uint64_t dropped = 0;                 ///< PDUs lost so far because the program did not read

  void clear() noexcept {
    states.clear();
    removed.clear();
    heard.clear();
    undelivered.clear();
    octets.clear();
    refused.clear();
    records.clear();
    refused_records.clear();
  }
};

/// A letter that one side fills and the other empties, in two alternating copies: while the reader
/// has one, the writer fills the other. One thread a side, neither waits.
///
///   if (box.is_free()) fill(box.letter()), box.send();           // writer
///   if (Letter* letter = box.take()) read(*letter), letter->clear(), box.give_back();  // reader
template <class Letter>
class LetterBox {
 public:
  /// Makes both copies from `values`.
  explicit LetterBox(const auto&... values) : copies_{Letter(values...), Letter(values...)} {}

  /// Writer: whether the last letter was given back, so that letter() may be filled and sent.
  [[nodiscard]] bool is_free() const noexcept {
    return sent_.load(std::memory_order_acquire) == nullptr;
  }
  /// Writer: the copy that the reader does not have; it comes back empty.
  [[nodiscard]] Letter& letter() noexcept { return copies_[next_]; }
  /// Writer, if is_free().
  void send() noexcept {
    sent_.store(&copies_[next_], std::memory_order_release);
    next_ = 1 - next_;
  }
  /// Reader: the letter, null if there is none. It belongs to the reader until give_back().
  [[nodiscard]] Letter* take() const noexcept { return sent_.load(std::memory_order_acquire); }
  void give_back() noexcept { sent_.store(nullptr, std::memory_order_release); }

 private:
  std::array<Letter, 2> copies_;
  std::size_t next_ = 0;
  std::atomic<Letter*> sent_{nullptr};
};

}  // namespace reckon::peer
