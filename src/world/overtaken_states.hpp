// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Among pending datagrams, only the newest state of an entity is used. If updates come faster than
// they are taken, an entity therefore costs one update, however many of its states are pending.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "reckon/pdu/bundle.hpp"
#include "reckon/peer/world/arrival.hpp"

namespace reckon::peer {

/// A datagram to be read, with its metadata.
struct ArrivedDatagram {
  std::span<const std::byte> octets;
  Arrival arrival;
};

/// Finds Entity States that a later datagram has overtaken. The later state is a whole one of the
/// same entity, from the same sender in the same epoch and row of channels, stamped later by less
/// than a second. The overtaken state would be shown for no time at all. States that carry more
/// than a pose are never overtaken: states with records (force models, energy accounts); with
/// `bodies_in_part` states with parts, which a later one may omit; states with the deactivated bit;
/// and states whose stamps are equal, out of order, or of a clock that jumps. If there are more
/// than kMostSenders at a time, all states of the further ones are taken.
///
/// One thread; allocates only at construction. Some 15 ns for each examined state.
class OvertakenStates {
 public:
  /// Most PDUs of a datagram that are examined; below the MTU there are no more of 144 octets.
  static constexpr std::size_t kMostPdus = 64;
  static constexpr std::size_t kMostSenders = 64;

  /// @param exercise number of the exercise  @param datagrams most at a time; below 65,536
  OvertakenStates(std::uint8_t exercise, std::size_t datagrams, bool bodies_in_part = false);

  /// Examines datagrams in the order of their arrival, at most as many as stated at construction.
  void look(std::span<const ArrivedDatagram> datagrams) noexcept;
  /// Bit i is set if PDU i of this datagram of the last look is overtaken.
  [[nodiscard]] std::uint64_t of(std::size_t datagram) const noexcept {
    return found_[datagram].overtaken;
  }
  /// True if the datagram contains nothing else to take, except perhaps a trailer.
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
  // The newest known state of an entity and a sender.
  struct Newest {
    std::uint64_t key = 0;  // 48 bits of the entity, 16 of the sender
    std::uint32_t timestamp = 0;
    std::uint16_t look = 0;  // in which it was found; places of earlier looks are free
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
