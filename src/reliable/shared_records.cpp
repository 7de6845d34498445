// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/peer/reliable/shared_records.hpp"

#include <algorithm>
#include <cstring>
#include <utility>

#include "reckon/pdu/codec/codec.hpp"

namespace reckon::peer {
namespace {

using pdu::AssuredKind;
using pdu::KnownSerial;
using pdu::MissingSerials;
using pdu::SharedRecordHead;

/// A peer that lacks writes of another one's list gets ours within this time.
constexpr std::chrono::milliseconds kAnswersWithin{20};
/// A list that equals a received one is not sent, but one is after so many periods: a peer that
/// receives us may not receive the other.
constexpr int kMostPeriods = 4;

/// Counters and serials above do not occur: no peer writes so often.
constexpr std::uint32_t kMostNumber = std::uint32_t{1} << 31;

constexpr std::size_t kHead = pdu::kFixedSize<SharedRecordHead>;

/// Calls visit(row) for each row of a message; false if it is no whole number of rows.
template <class Row>
bool for_each_row(std::span<const std::byte> octets, auto&& visit) {
  constexpr std::size_t kSize = pdu::kFixedSize<Row>;
  if (octets.size() % kSize != 0) return false;
  for (Row row; !octets.empty(); octets = octets.subspan(kSize)) {
    static_cast<void>(pdu::load_record(octets, row));
    visit(row);
  }
  return true;
}

}  // namespace

bool is_record_key(std::string_view key) noexcept {
  return !key.empty() && key.size() <= pdu::kMostRecordKey &&
         std::ranges::none_of(key, [](char letter) {
           return static_cast<unsigned char>(letter) < ' ' || letter == '\x7f';
         });
}

SharedRecords::SharedRecords(std::uint32_t epoch, std::uint64_t seed)
    : epoch_(epoch), timer_(seed) {}

// The table

SharedRecords::Writer* SharedRecords::find_or_add(std::uint32_t epoch) {
  const auto found = std::ranges::find(writers_, epoch, &Writer::epoch);
  if (found != writers_.end()) return &*found;
  if (writers_.size() == kMostWriters) return nullptr;
  writers_.emplace_back().epoch = epoch;
  return &writers_.back();
}

SharedRecords::Record* SharedRecords::find_record(std::string_view key) noexcept {
  const auto found = std::ranges::find(records_, key, &Record::key);
  return found == records_.end() ? nullptr : &*found;
}

std::optional<SharedRecord> SharedRecords::find(std::string_view key) const noexcept {
  const auto found = std::ranges::find(records_, key, &Record::key);
  if (found == records_.end()) return std::nullopt;
  return SharedRecord{found->key, found->value, found->version};
}

bool SharedRecords::merge(const SharedRecord& record, std::uint32_t serial) {
  Record* row = find_record(record.key);
  if (row != nullptr && row->version >= record.version) return true;
  if (row == nullptr) {
    row = records_.size() < kMostRecords ? &records_.emplace_back() : make_room(record.key);
    if (row == nullptr) return false;
    row->key = record.key;
  }
  row->value.assign(record.value.begin(), record.value.end());
  row->version = record.version;
  row->serial = serial;
  row->due = kNever;
  if (!std::exchange(row->is_changed, true)) changes_.push_back(row->key);
  return true;
}

// The smallest keys stay, so that all peers keep the same ones. Null if `key` is none of them.
SharedRecords::Record* SharedRecords::make_room(std::string_view key) {
  const auto last = std::ranges::max_element(records_, {}, &Record::key);
  if (key > last->key) return nullptr;
  ++counts_.refused;
  if (!last->is_changed) changes_.push_back(last->key);
  *last = Record();
  return &*last;
}

WriteResult SharedRecords::write(std::string_view key, std::span<const std::byte> value,
                                 Nanoseconds now) {
  if (!is_record_key(key) || value.size() > pdu::kMostRecordValue) return WriteResult::invalid;
  Writer* writer = find_or_add(epoch_);
  const Record* before = find_record(key);
  if (before == nullptr && records_.size() == kMostRecords) return WriteResult::full;
  const RecordVersion version{before == nullptr ? 1 : before->version.counter + 1, epoch_};
  const bool is_last = version.counter > kMostNumber || serial_ == kMostNumber;
  if (is_last || writer == nullptr || !merge({key, value, version}, serial_ + 1))
    return WriteResult::full;
  writer->serials.add(serial_ + 1, serial_ + 1);
  ++serial_;
  Record& record = *find_record(key);
  record.due = now;
  record.is_first = true;
  pause_ = kFirstPause;
  tell_serials_by(now + pause_);
  next_ = now;
  return WriteResult::written;
}

std::span<const std::string> SharedRecords::take_changes() {
  std::swap(changes_, reported_);
  changes_.clear();
  for (const std::string& key : reported_)
    if (Record* record = find_record(key)) record->is_changed = false;
  return reported_;
}

// In

bool SharedRecords::take(AssuredKind kind, std::span<const std::byte> octets, Nanoseconds now) {
  next_ = now;
  const bool is_good = kind == AssuredKind::shared_record    ? take_record(octets, now)
                       : kind == AssuredKind::record_serials ? take_serials(octets, now)
                       : kind == AssuredKind::record_request ? take_request(octets, now)
                                                             : false;
  if (!is_good) ++counts_.refused;
  if (serials_at_ == kNever && !writers_.empty()) {
    pause_ = kPeriod;
    tell_serials_by(now + kPeriod + timer_.draw(kPeriod / 10));
  }
  return is_good;
}

bool SharedRecords::take_record(std::span<const std::byte> octets, Nanoseconds now) {
  SharedRecordHead head;
  if (!pdu::load_record(octets, head)) return false;
  octets = octets.subspan(kHead);
  const bool fits = octets.size() == std::size_t{head.key_length} + head.value_length &&
                    head.value_length <= pdu::kMostRecordValue;
  if (!fits || head.writer == 0 || head.prior >= head.serial) return false;
  if (head.counter > kMostNumber || head.serial > kMostNumber) return false;
  const auto key_octets = octets.first(head.key_length);
  const std::string_view key(reinterpret_cast<const char*>(key_octets.data()), key_octets.size());
  if (!key.empty() && !is_record_key(key)) return false;
  if (head.writer == epoch_ && head.serial > serial_) return false;
  Writer* writer = find_or_add(head.writer);
  if (writer == nullptr) return false;
  bool is_stored = true;
  const RecordVersion version{head.counter, head.writer};
  if (!key.empty()) {
    const Record* before = find_record(key);
    const bool is_newer = before == nullptr || before->version < version;
    is_stored = merge({key, octets.subspan(key.size()), version}, head.serial);
    if (is_newer && is_stored) ++counts_.changed;
    Record* row = find_record(key);  // another peer has repaired it
    if (row != nullptr && row->version == version && !row->is_first) row->due = kNever;
  }
  if (head.serial >= writer->end_of_repair) writer->end_due = kNever;
  writer->serials.add(head.prior + 1, head.serial);
  watch(*writer, now);
  return is_stored;
}

bool SharedRecords::take_serials(std::span<const std::byte> octets, Nanoseconds now) {
  bool lacks = false;
  const bool is_good = for_each_row<KnownSerial>(octets, [&](const KnownSerial& row) {
    Writer* writer = row.writer == 0 ? nullptr : find_or_add(row.writer);
    const std::uint32_t most = row.writer == epoch_ ? serial_ : kMostNumber;
    if (writer == nullptr || row.serial > row.last || row.last > most) {
      ++counts_.refused;
      return;
    }
    lacks |= row.serial < writer->serials.known() || row.last < writer->serials.last();
    writer->serials.note_exists(row.last);
    watch(*writer, now);
    // A peer that has more is within reach.
    if (row.last <= writer->serials.known() || writer->pause <= Nanoseconds(2 * kAgain)) return;
    writer->pause = kAgain;
    writer->ask_at = std::min(writer->ask_at, now + timer_.draw(kLongestWait));
  });
  if (lacks) {
    pause_ = std::min(pause_, Nanoseconds(kAnswersWithin));
    tell_serials_by(now + timer_.draw(kAnswersWithin));
  } else if (is_as_ours(octets, now) && pause_ >= kPeriod &&
             now - listed_ < kMostPeriods * Nanoseconds(kPeriod)) {
    serials_at_ = now + kPeriod + timer_.draw(kPeriod / 10);
  }
  return is_good;
}

pdu::KnownSerial SharedRecords::row_of(const Writer& writer) const noexcept {
  KnownSerial row{writer.epoch, writer.serials.known(), writer.serials.last()};
  for (const Record& record : records_) {
    const std::uint32_t product = record.serial * 2654435761U;
    if (record.version.writer == writer.epoch) row.digest ^= product + (product >> 16);
  }
  return row;
}

// Whether a list has the same serials as ours. If the records that are left differ all the same, a
// record was replaced by one that is lost: then all of that writer are requested.
bool SharedRecords::is_as_ours(std::span<const std::byte> octets, Nanoseconds now) {
  bool is_same = true;
  std::uint32_t other = 0;  // a writer whose records differ
  static_cast<void>(for_each_row<KnownSerial>(octets, [&](const KnownSerial& row) {
    const auto writer = std::ranges::find(writers_, row.writer, &Writer::epoch);
    const KnownSerial ours = writer == writers_.end() ? KnownSerial() : row_of(*writer);
    is_same &= ours.writer == row.writer && ours.serial == row.serial && ours.last == row.last;
    if (ours.digest != row.digest) other = row.writer;
  }));
  const bool is_whole = octets.size() == writers_.size() * pdu::kFixedSize<KnownSerial>;
  if (!is_same || other == 0) return is_same && is_whole;
  Writer& writer = *find_or_add(other);
  if (writer.ask_at == kNever) writer.ask_at = now + timer_.draw(kLongestWait);
  writer.asks_all = true;
  return false;
}

bool SharedRecords::take_request(std::span<const std::byte> octets, Nanoseconds now) {
  return for_each_row<MissingSerials>(octets, [&](const MissingSerials& row) {
    const auto writer = std::ranges::find(writers_, row.writer, &Writer::epoch);
    if (writer == writers_.end() || row.first == 0 || row.last < row.first) return;
    const WrittenSerials& serials = writer->serials;
    if (writer->asks_all && row.first == 1 && row.last >= serials.last()) {
      writer->asks_all = false;
      watch(*writer, now);
    }
    if (!serials.has_all() && row.first <= serials.known() + 1 && row.last >= serials.highest())
      writer->ask_at = std::max(writer->ask_at, now + Nanoseconds(kAgain));
    repair(row, now);
  });
}

// Requests what is missing of a writer, or ends that.
void SharedRecords::watch(Writer& writer, Nanoseconds now) {
  if (writer.asks_all) return;
  if (writer.serials.has_all()) {
    writer.ask_at = writer.missing_since = kNever;
    writer.pause = kAgain;
  } else {
    if (writer.ask_at == kNever) writer.ask_at = now + timer_.draw(kLongestWait);
    writer.missing_since = std::min(writer.missing_since, now);
  }
}

// Repairs what is left of the missing writes.
void SharedRecords::repair(const MissingSerials& missing, Nanoseconds now) {
  Writer& writer = *find_or_add(missing.writer);
  const auto draw = [&] {
    return writer.epoch == epoch_ ? Nanoseconds::zero() : timer_.draw(kLongestWait);
  };
  const std::uint32_t last = std::min(missing.last, writer.serials.known());
  bool has_last = last < missing.first;
  for (Record& record : records_) {
    const bool is_meant = record.version.writer == missing.writer &&
                          record.serial >= missing.first && record.serial <= missing.last;
    if (!is_meant) continue;
    has_last |= record.serial >= last;
    if (record.due == kNever) record.due = now + draw();
  }
  if (has_last) return;
  if (writer.end_due == kNever) writer.end_due = now + draw();
  writer.end_of_repair = std::max(writer.end_of_repair, last);
}

void SharedRecords::meet(Nanoseconds now) {
  if (!writers_.empty()) tell_serials_by(now + timer_.draw(kAnswersWithin));
}

void SharedRecords::tell_serials_by(Nanoseconds time) noexcept {
  serials_at_ = std::min(serials_at_, time);
  next_ = std::min(next_, time);
}

// Out

std::uint32_t SharedRecords::prior_of(std::uint32_t writer, std::uint32_t serial) const noexcept {
  const auto row = std::ranges::find(writers_, writer, &Writer::epoch);
  std::uint32_t prior = row->serials.before(serial);
  for (const Record& record : records_)
    if (record.version.writer == writer && record.serial < serial)
      prior = std::max(prior, record.serial);
  return prior;
}

std::size_t SharedRecords::store(const SharedRecordHead& head, std::string_view key,
                                 std::span<const std::byte> value,
                                 std::span<std::byte> room) const noexcept {
  static_cast<void>(pdu::store_record(head, room));
  std::memcpy(room.data() + kHead, key.data(), key.size());
  if (!value.empty()) std::memcpy(room.data() + kHead + key.size(), value.data(), value.size());
  return kHead + key.size() + value.size();
}

std::size_t SharedRecords::store_record(Record& record, std::span<std::byte> room) {
  const SharedRecordHead head{record.version.counter,
                              record.version.writer,
                              record.serial,
                              prior_of(record.version.writer, record.serial),
                              static_cast<std::uint8_t>(record.key.size()),
                              0,
                              static_cast<std::uint16_t>(record.value.size())};
  if (!record.is_first) ++counts_.repairs;
  record.due = kNever;
  record.is_first = false;
  return store(head, record.key, record.value, room);
}

std::size_t SharedRecords::store_end(Writer& writer, std::span<std::byte> room) {
  const std::uint32_t end = writer.end_of_repair;
  const SharedRecordHead head{0, writer.epoch, end, prior_of(writer.epoch, end)};
  writer.end_due = kNever;
  writer.end_of_repair = 0;
  return store(head, {}, {}, room);
}

std::size_t SharedRecords::store_request(Nanoseconds now, std::span<std::byte> room) {
  constexpr std::size_t kSize = pdu::kFixedSize<MissingSerials>;
  std::size_t size = 0;
  for (Writer& writer : writers_) {
    if (writer.ask_at > now) continue;
    if (size + kSize * (WrittenSerials::kMostRanges + 1) > room.size()) break;
    if (std::exchange(writer.asks_all, false)) {
      const MissingSerials all{writer.epoch, 1, writer.serials.last()};
      size += pdu::store_record(all, room.subspan(size));
      watch(writer, now);
      continue;
    }
    if (now - writer.missing_since > kGivesUp) {
      ++counts_.missed;
      writer.serials.forget_missing();
      watch(writer, now);
      continue;
    }
    writer.serials.for_each_missing([&](const WrittenSerials::Range& range) {
      const MissingSerials row{writer.epoch, range.first, range.last};
      size += pdu::store_record(row, room.subspan(size));
    });
    writer.ask_at = now + writer.pause;
    writer.pause = std::min<Nanoseconds>(2 * writer.pause, kPeriod);
  }
  counts_.requests += size > 0 ? 1 : 0;
  return size;
}

std::size_t SharedRecords::store_serials(Nanoseconds now, std::span<std::byte> room) {
  constexpr std::size_t kSize = pdu::kFixedSize<KnownSerial>;
  std::size_t size = 0;
  for (; next_writer_ < writers_.size() && size + kSize <= room.size(); ++next_writer_) {
    const Writer& writer = writers_[next_writer_];
    size += pdu::store_record(row_of(writer), room.subspan(size));
  }
  if (next_writer_ < writers_.size()) return size;
  next_writer_ = 0;
  listed_ = now;
  const bool is_at_rest = pause_ >= kPeriod;
  serials_at_ = now + pause_ + (is_at_rest ? timer_.draw(kPeriod / 5) : Nanoseconds::zero());
  pause_ = std::min<Nanoseconds>(2 * pause_, kPeriod);
  return size;
}

std::size_t SharedRecords::take_due(Nanoseconds now, AssuredKind& kind, std::span<std::byte> room) {
  if (now < next_) return 0;
  kind = AssuredKind::shared_record;
  for (Record& record : records_)
    if (record.due <= now) return store_record(record, room);
  for (Writer& writer : writers_)
    if (writer.end_due <= now) return store_end(writer, room);
  kind = AssuredKind::record_request;
  if (const std::size_t size = store_request(now, room); size > 0) return size;
  kind = AssuredKind::record_serials;
  if (serials_at_ <= now) return store_serials(now, room);
  find_next();
  return 0;
}

void SharedRecords::find_next() noexcept {
  next_ = serials_at_;
  for (const Record& record : records_) next_ = std::min(next_, record.due);
  for (const Writer& writer : writers_) next_ = std::min({next_, writer.ask_at, writer.end_due});
}

}  // namespace reckon::peer
