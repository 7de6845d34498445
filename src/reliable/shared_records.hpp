// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Records that are equal at all peers: a key has one value, and the latest version wins. Every peer
// may write every key. A record outlives its writer while a peer has it.
//
// Each write has a serial of its writer. Peers compare what they have by serials: one that lacks
// some requests them, and any peer that has them repairs. A write that a later version has replaced
// is not repaired.
#pragma once

#include <chrono>
#include <compare>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "reckon/pdu/codec/enumerations.hpp"
#include "reckon/pdu/reckon/shared_record_messages.hpp"
#include "reckon/peer/reliable/repair_timer.hpp"
#include "reckon/peer/reliable/written_serials.hpp"

namespace reckon::peer {

/// Whether a key has 1 to 63 octets without control characters.
[[nodiscard]] bool is_record_key(std::string_view key) noexcept;

/// Order of the versions of a key.
struct RecordVersion {
  std::uint32_t counter = 0;
  std::uint32_t writer = 0;  ///< epoch
  auto operator<=>(const RecordVersion&) const = default;
};

/// A record, as a view.
struct SharedRecord {
  std::string_view key;
  std::span<const std::byte> value;
  RecordVersion version;
};

/// Result of a write.
enum class WriteResult : std::uint8_t {
  written,
  invalid,  ///< no key of is_record_key(), or a value of more than pdu::kMostRecordValue octets
  full,     ///< kMostRecords other keys, or kMostWriters
};

/// Sums since the start.
struct SharedRecordCounts {
  std::uint64_t changed = 0;   ///< records of others that replaced an older version or none
  std::uint64_t requests = 0;  ///< sent
  std::uint64_t repairs = 0;   ///< records sent for a request
  std::uint64_t refused = 0;   ///< damaged messages, and records or writers without room
  std::uint64_t missed = 0;    ///< writers of which writes were given up after kGivesUp
};

/// The records of one peer. Pure: time is passed in. One thread. Allocates when a record or a
/// writer is new and when a longer value arrives, at most 1.2 MB in all. If peers write more than
/// kMostRecords keys at the same time, all keep the smallest ones.
class SharedRecords {
 public:
  static constexpr std::size_t kMostRecords = 1024, kMostWriters = 256;
  /// Longest wait before a request and before a repair: eight round trips of 1 ms.
  static constexpr std::chrono::milliseconds kLongestWait{8};
  /// Period of the serials, and the waits after a write, which double from the first.
  static constexpr std::chrono::milliseconds kPeriod{500}, kFirstPause{4};
  /// Requests are repeated after this time, which doubles up to kPeriod.
  static constexpr std::chrono::milliseconds kAgain{20};
  /// Missing writes are given up after this time, as if no peer had them.
  static constexpr std::chrono::seconds kGivesUp{30};
  /// Most octets of a message.
  static constexpr std::size_t kMostOctets = 1200;

  /// @param epoch of this peer  @param seed of the random waits
  SharedRecords(std::uint32_t epoch, std::uint64_t seed);

  /// Writes a record; it is sent with the next take_due(). An empty value is a value too.
  WriteResult write(std::string_view key, std::span<const std::byte> value,
                    std::chrono::nanoseconds now);
  /// Nothing if nobody has written this key.
  [[nodiscard]] std::optional<SharedRecord> find(std::string_view key) const noexcept;
  [[nodiscard]] std::size_t size() const noexcept { return records_.size(); }
  /// The keys whose records have changed since the last call, each once; valid until the next call.
  /// A key without a record was removed, because there were too many.
  [[nodiscard]] std::span<const std::string> take_changes();

  /// Takes a message of another peer. @return false if it is damaged or there is no room, which
  /// counts in `refused`
  bool take(pdu::AssuredKind kind, std::span<const std::byte> octets, std::chrono::nanoseconds now);
  /// A peer has joined: it gets our serials soon.
  void meet(std::chrono::nanoseconds now);

  /// The next message that is due, for all peers. Call it until it returns 0.
  /// @param room at least kMostOctets  @return octets of the message
  [[nodiscard]] std::size_t take_due(std::chrono::nanoseconds now, pdu::AssuredKind& kind,
                                     std::span<std::byte> room);
  /// When the next one may be due; nanoseconds::max() if there are no records.
  [[nodiscard]] std::chrono::nanoseconds next_step() const noexcept { return next_; }
  [[nodiscard]] const SharedRecordCounts& counts() const noexcept { return counts_; }

 private:
  using Nanoseconds = std::chrono::nanoseconds;
  static constexpr Nanoseconds kNever = Nanoseconds::max();

  struct Record {
    std::string key;
    std::vector<std::byte> value;
    RecordVersion version;
    std::uint32_t serial = 0;
    Nanoseconds due = kNever;  // of the next transmission
    bool is_changed = false;
    bool is_first = false;  // a transmission of our own new write
  };
  struct Writer {
    std::uint32_t epoch = 0;
    WrittenSerials serials;
    bool asks_all = false;  // the next request names all writes
    Nanoseconds ask_at = kNever, pause = kAgain, missing_since = kNever;
    // The serials after the last record that is left, of which a request asked.
    std::uint32_t end_of_repair = 0;
    Nanoseconds end_due = kNever;
  };

  [[nodiscard]] Writer* find_or_add(std::uint32_t epoch);
  [[nodiscard]] Record* find_record(std::string_view key) noexcept;
  [[nodiscard]] std::uint32_t prior_of(std::uint32_t writer, std::uint32_t serial) const noexcept;
  bool take_record(std::span<const std::byte> octets, Nanoseconds now);
  bool take_serials(std::span<const std::byte> octets, Nanoseconds now);
  bool take_request(std::span<const std::byte> octets, Nanoseconds now);
  bool merge(const SharedRecord& record, std::uint32_t serial);
  [[nodiscard]] Record* make_room(std::string_view key);
  void watch(Writer& writer, Nanoseconds now);
  void repair(const pdu::MissingSerials& missing, Nanoseconds now);
  [[nodiscard]] std::size_t store(const pdu::SharedRecordHead& head, std::string_view key,
                                  std::span<const std::byte> value,
                                  std::span<std::byte> room) const noexcept;
  [[nodiscard]] std::size_t store_record(Record& record, std::span<std::byte> room);
  [[nodiscard]] std::size_t store_end(Writer& writer, std::span<std::byte> room);
  [[nodiscard]] std::size_t store_request(Nanoseconds now, std::span<std::byte> room);
  [[nodiscard]] std::size_t store_serials(Nanoseconds now, std::span<std::byte> room);
  void tell_serials_by(Nanoseconds time) noexcept;
  void find_next() noexcept;
  [[nodiscard]] pdu::KnownSerial row_of(const Writer& writer) const noexcept;
  [[nodiscard]] bool is_as_ours(std::span<const std::byte> octets, Nanoseconds now);

  std::uint32_t epoch_;
  RepairTimer timer_;
  std::uint32_t serial_ = 0;  // of our last write
  std::vector<Record> records_;
  std::vector<Writer> writers_;
  std::vector<std::string> changes_, reported_;
  Nanoseconds serials_at_ = kNever, pause_ = kFirstPause;
  std::size_t next_writer_ = 0;  // of a list of serials that needs several messages
  Nanoseconds listed_{0};        // the last list was sent
  Nanoseconds next_ = kNever;
  SharedRecordCounts counts_;
};

}  // namespace reckon::peer
