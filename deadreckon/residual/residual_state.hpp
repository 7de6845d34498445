// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The residual form of an Entity State. It has only the lowest bits of each number of the motion,
// enough for the greatest error of a receiver's dead-reckoned prediction. Data that seldom change
// are only in the key state, a plain Entity State that is sent from time to time. About 26 octets
// instead of 144.
//
// The sender assumes that a receiver has at least one of about the last kWindow updates, not
// necessarily the last one, so that a few lost updates do not affect later ones. A check of 16 bits
// over the whole state lets a receiver that has none of them detect this. It then waits for the
// next key state.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "reckon/pdu/compression/state_numbers.hpp"

namespace reckon::deadreckon {

/// Greatest number of octets of a body.
inline constexpr std::size_t kMostResidual = 64;

/// Position of an entity in quanta, and its motion in world axes: the start of a prediction.
struct ResidualReference {
  pdu::StateNumbers numbers;
  std::array<double, 3> velocity{};      ///< world axes [position quanta / s]
  std::array<double, 3> acceleration{};  ///< world axes [position quanta / s^2]
};

/// The sending side of one entity in one group. One thread; no allocation; below 1 KiB.
class ResidualEncoder {
 public:
  /// Number of consecutive updates that a receiver may always miss; at most it may miss twice as
  /// many.
  static constexpr unsigned kWindow = 8;

  explicit ResidualEncoder(const pdu::StateScale& scale = {}) noexcept : scale_(scale) {}

  /// Stores `state`, which is sent plain, as the key state of the following updates. False if its
  /// motion cannot be expressed in quanta: then all states are sent plain.
  bool note_key(const pdu::EntityState& state) noexcept;

  /// Writes the body of `state`. Returns its octets, or 0 if the state must be sent plain, as a key
  /// state: there is no key state yet, data besides the motion have changed, a number is out of
  /// range, or a receiver with the last state would not restore the same numbers. Rounds to quanta;
  /// exact for a state from pdu::quantise(). About 90 ns.
  [[nodiscard]] std::size_t encode(const pdu::EntityState& state,
                                   std::span<std::byte, kMostResidual> out) noexcept;

 private:
  // Least and greatest of the numbers that are predicted as constant: the rotational ones.
  struct Extremes {
    std::array<std::int32_t, 9> least{}, most{};
  };
  struct Widths {
    std::array<unsigned, 5> code{};
    unsigned turning = 0;  // a bit for each axis whose angular velocity is sent
    bool fit = true;
  };
  void note(const ResidualReference& sent) noexcept;
  // Bit widths. The arguments are the predictions of velocity and displacement from the last state
  // [quanta].
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
  unsigned noted_ = 0;  // number of updates in the younger half of the window
  ResidualReference last_;
  std::array<ResidualReference, 2> first_;  // of the younger and of the older half
  std::array<Extremes, 2> extremes_;        // of the same
};

/// Result of decoding a body.
enum class ResidualVerdict : std::uint8_t {
  good,
  no_key,     ///< no key state yet, or the last state is too old: wait for the next key state
  malformed,  ///< not a body
};

/// The receiving side of one entity. One thread; no allocation, never throws; below 1 KiB.
class ResidualDecoder {
 public:
  explicit ResidualDecoder(const pdu::StateScale& scale = {}) noexcept : scale_(scale) {}

  /// Stores a received plain Entity State as the key state, without its variable parameters.
  void note_plain(const pdu::EntityState& state) noexcept;

  /// Restores a state into `out`, which changes only if the verdict is good. `timestamp` is the
  /// timestamp of the PDU that contains the body, at most 1.5 s after the state's. `body` may be
  /// any octets. About 50 ns.
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
