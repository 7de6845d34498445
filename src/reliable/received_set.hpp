// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The receiver's side of assured delivery: which records of each sender were taken, so that none is
// taken twice, and the acknowledgements that are due.
#pragma once

#include <array>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "reckon/aoim/groups/epoch_index.hpp"
#include "reckon/pdu/reckon/assured_record.hpp"

namespace reckon::peer {

/// What a record is to its receiver.
enum class AssuredNovelty : std::uint8_t {
  fresh,      ///< not taken before
  duplicate,  ///< taken before
  refused,    ///< so old that it may have been taken, or too far ahead
};

/// An acknowledgement to send.
struct DueReceipt {
  std::uint32_t epoch = 0;    ///< of the sender of the records
  std::uint32_t highest = 0;  ///< sequence
  pdu::AssuredReceipt receipt;
  bool is_for_host = false;  ///< also to the sender's own address
};

/// The windows of all senders. Pure: time is passed in. One thread; allocates only at construction.
class ReceivedSet {
 public:
  /// Sequences of a window, and the furthest that a record moves it.
  static constexpr std::uint32_t kWindow = 256;
  /// After this time without a record, two records that agree begin a window further ahead: their
  /// sender has given up all records before.
  static constexpr std::chrono::seconds kIdle{5};

  /// @param senders most; the records of further ones are refused
  explicit ReceivedSet(std::size_t senders);

  /// Takes a record of a sender; a new sender's window begins with it.
  [[nodiscard]] AssuredNovelty take(std::uint32_t epoch, std::uint32_t sequence,
                                    std::chrono::nanoseconds now) noexcept;
  /// Whether no record waits for this one: it was taken, is for others, or is older than the
  /// window.
  [[nodiscard]] bool needs_no_wait(std::uint32_t epoch, std::uint32_t sequence) const noexcept;
  /// Whether a later record of the sender has come.
  [[nodiscard]] bool has_later(std::uint32_t epoch, std::uint32_t sequence) const noexcept;
  /// Notes that a record exists which is for others: the window follows it.
  void follow(std::uint32_t epoch, std::uint32_t sequence, std::chrono::nanoseconds now) noexcept;
  /// Marks a taken record as refused by the application.
  void refuse(std::uint32_t epoch, std::uint32_t sequence) noexcept;
  /// An acknowledgement to this sender is due.  @param by_host it was sent to this host alone
  void owe(std::uint32_t epoch, bool by_host) noexcept;
  /// Takes a due acknowledgement; false if there is none.
  [[nodiscard]] bool take_receipt(DueReceipt& due) noexcept;
  [[nodiscard]] bool owes() const noexcept { return !owing_.empty(); }
  /// Forgets a sender whose epoch has ended or that fell silent.
  void drop(std::uint32_t epoch) noexcept;

 private:
  using Nanoseconds = std::chrono::nanoseconds;
  /// Bit i of word k: sequence highest - (64 k + i).
  using Map = std::array<std::uint64_t, kWindow / 64>;
  struct Sender {
    std::uint32_t epoch = 0;
    std::uint32_t highest = 0;
    std::uint32_t far = 0;  ///< last record too far ahead
    bool has_far = false;
    bool owes = false, by_host = false;
    Map received{}, refused{}, for_others{};
    Nanoseconds last{};  ///< arrival of the last record within the window
  };

  [[nodiscard]] Sender* find(std::uint32_t epoch) noexcept;
  [[nodiscard]] Sender* find_or_add(std::uint32_t epoch, std::uint32_t sequence,
                                    Nanoseconds now) noexcept;
  [[nodiscard]] bool reach(Sender& sender, std::uint32_t sequence, Nanoseconds now) noexcept;

  std::vector<Sender> senders_;
  std::vector<std::uint32_t> owing_;  ///< epochs
  aoim::EpochIndex places_;
};

}  // namespace reckon::peer
