// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The residual form of an Entity State: of each number of its motion only the lowest bits, as many
// as the dead-reckoned prediction of a receiver can be wrong by. What seldom changes stays in the
// key, a plain Entity State now and then. About 26 octets of 144.
//
// The sender counts on a receiver having any of the last kWindow updates or so, not the last one:
// loss of some costs nothing beyond what was lost. A check of 16 bits over the whole state tells a
// receiver that has none of them; it then waits for the next key.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "reckon/pdu/compression/state_numbers.hpp"

namespace reckon::deadreckon {

/// Octets that any body fits into.
inline constexpr std::size_t kMostResidual = 64;

/// Where an entity was, in quanta, and how it moved in world axes: what a prediction starts from.
struct ResidualReference {
  pdu::StateNumbers numbers;
  std::array<double, 3> velocity{};      ///< world axes [position quanta / s]
  std::array<double, 3> acceleration{};  ///< world axes [position quanta / s^2]
};

/// The sending end of one entity in one group. One thread; no allocation; below 1 KiB.
class ResidualEncoder {
 public:
  /// Updates that a receiver may miss in a row, at least, and twice as many at most.
  static constexpr unsigned kWindow = 8;

  explicit ResidualEncoder(const pdu::StateScale& scale = {}) noexcept : scale_(scale) {}

  /// Notes that `state` goes out plain, as the key of what follows. False where its motion cannot
  /// be stated in quanta: then everything goes plain.
  bool note_key(const pdu::EntityState& state) noexcept;

  /// Writes the body of `state`. Octets written; 0 where it has to go plain, as a key: there is no
  /// key yet, something besides the motion has changed, a number is out of range, or who has the
  /// last state would not come to the same numbers. Rounds to quanta: give it what pdu::quantise()
  /// made, and it is exact. About 90 ns.
  [[nodiscard]] std::size_t encode(const pdu::EntityState& state,
                                   std::span<std::byte, kMostResidual> out) noexcept;

 private:
  // Least and most of the numbers that are predicted by themselves: the turning ones.
  struct Extremes {
    std::array<std::int32_t, 9> least{}, most{};
  };
  struct Widths {
    std::array<unsigned, 5> code{};
    unsigned turning = 0;  // a bit for each axis whose turn rate is sent
    bool fit = true;
  };
  void note(const ResidualReference& sent) noexcept;
  // Of velocity and way: what who has the last state predicts [quanta].
  [[nodiscard]] Widths widths_for(const ResidualReference& now,
                                  const std::array<double, 3>& velocity_from_last,
                                  const std::array<double, 3>& way_from_last) const noexcept;
  [[nodiscard]] bool restores(const Widths& widths, const pdu::StateNumbers& now,
                              const std::array<double, 3>& velocity,
                              const std::array<double, 3>& way) const noexcept;

  pdu::StateScale scale_;
  pdu::EntityState key_;
  std::uint64_t key_hash_ = 0;
  bool has_key_ = false;
  unsigned noted_ = 0;  // updates in the younger half of the window
  ResidualReference last_;
  std::array<ResidualReference, 2> first_;  // of the younger and of the older half
  std::array<Extremes, 2> extremes_;        // of the same
};

/// What became of a body.
enum class ResidualVerdict : std::uint8_t {
  good,
  no_key,     ///< no plain Entity State of this entity yet, or all too old: wait for the next
  malformed,  ///< no body
};

/// The receiving end of one entity. One thread; no allocation, never throws; below 1 KiB.
class ResidualDecoder {
 public:
  explicit ResidualDecoder(const pdu::StateScale& scale = {}) noexcept : scale_(scale) {}

  /// A plain Entity State came: the key from now on. Its variable parameters are not kept.
  void note_plain(const pdu::EntityState& state) noexcept;

  /// Restores a state into `out`, which is touched only where the verdict is good. `timestamp` of
  /// the PDU around the body, at most 1.5 s after the state's. Any octets may come. About 50 ns.
  [[nodiscard]] ResidualVerdict decode(std::span<const std::byte> body, std::uint32_t timestamp,
                                       pdu::EntityState& out) noexcept;

 private:
  pdu::StateScale scale_;
  pdu::EntityState key_;
  std::uint64_t key_hash_ = 0;
  bool has_key_ = false;
  ResidualReference last_;
};

}  // namespace reckon::deadreckon
