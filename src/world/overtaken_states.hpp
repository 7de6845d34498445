// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Newest wins among datagrams that wait: where updates come faster than they are taken, an entity
// costs one update, however many states of it wait.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "reckon/pdu/bundle.hpp"
#include "reckon/peer/world/arrival.hpp"

namespace reckon::peer {

/// A datagram that is to be read, and what is known of it besides its octets.
struct ArrivedDatagram {
  std::span<const std::byte> octets;
  Arrival arrival;
};

/// Finds among datagrams the Entity States that a later one has overtaken: a whole state of the
/// same entity, from the same sender in the same life and by the same row of channels, in a later
/// datagram, stamped later by less than a second. Such a state would be shown for no time at all.
/// Never overtaken are states with which records come (force models, energy accounts), with
/// `bodies_in_part` those that tell of parts, which a later one may leave out, those that say
/// good-bye, and those whose stamps are out of order, equal, or of a clock that leaps: they tell
/// more than a pose. Where there are more than kMostSenders at a time, those of the further ones
/// are taken.
///
/// One thread; allocates only at construction. Some 15 ns a state looked at.
class OvertakenStates {
 public:
  /// PDUs of a datagram that are looked at; below the MTU there are no more of 144 octets.
  static constexpr std::size_t kMostPdus = 64;
  static constexpr std::size_t kMostSenders = 64;

  /// @param exercise whose states count  @param datagrams looked at at a time, at
  /// most; below 65,536
  OvertakenStates(std::uint8_t exercise, std::size_t datagrams, bool bodies_in_part = false);

  /// Looks at datagrams, in the order in which they came; as many as were said at construction.
  void look(std::span<const ArrivedDatagram> datagrams) noexcept;
  /// Of the datagram at this place of the last look: bit i is set where its PDU i is overtaken.
  [[nodiscard]] std::uint64_t of(std::size_t datagram) const noexcept {
    return found_[datagram].overtaken;
  }
  /// True where nothing else is in it that could be taken, but a trailer.
  [[nodiscard]] bool is_whole(std::size_t datagram) const noexcept {
    return found_[datagram].overtaken != 0 && !found_[datagram].has_more;
  }
  /// Overtaken states of the last look.
  [[nodiscard]] std::size_t count() const noexcept { return count_; }

 private:
  static constexpr std::uint16_t kNoSender = 0xFFFF;
  struct Found {
    std::uint64_t overtaken = 0;
    std::uint16_t sender = kNoSender;  // in senders_
    bool has_more = false;
  };
  // The newest state of an entity and a sender, as far as has been looked.
  struct Newest {
    std::uint64_t key = 0;  // 48 bits of the entity, 16 of the sender
    std::uint32_t timestamp = 0;
    std::uint16_t look = 0;  // in which it was found; of former ones the place is free
    std::uint16_t datagram = 0;
  };
  enum class Pdu : std::uint8_t { overtaken, nothing, more };

  void begin_look() noexcept;
  [[nodiscard]] std::uint16_t sender_of(const Arrival& arrival) noexcept;
  [[nodiscard]] Pdu look_at(const pdu::BundledPdu& pdu, std::size_t datagram) noexcept;
  [[nodiscard]] Newest* find(std::uint64_t key) noexcept;

  [[nodiscard]] bool is_plain(const pdu::BundledPdu& pdu) const noexcept;

  std::uint8_t exercise_;
  bool bodies_in_part_;
  std::vector<Found> found_;             // of each datagram
  std::vector<const Arrival*> senders_;  // one of each sender
  std::vector<Newest> newest_;           // open addressing, a power of two
  int shift_;                            // 64 - log2 of their number
  std::uint16_t look_ = 0;
  std::size_t count_ = 0;
};

}  // namespace reckon::peer
