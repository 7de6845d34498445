// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/aoim/leader/snapshot_reader.hpp"

#include <algorithm>

#include "reckon/aoim/leader/snapshot_server.hpp"

namespace reckon::aoim {
namespace {

// A snapshot that has begun and pauses this long has lost its last parts.
constexpr std::chrono::milliseconds kPause{60};

}  // namespace

using std::chrono::nanoseconds;

SnapshotReader::Reading* SnapshotReader::find(CellId cell) noexcept {
  const auto found = std::find_if(readings_.begin(), readings_.end(),
                                  [cell](const Reading& reading) { return reading.cell == cell; });
  return found == readings_.end() ? nullptr : &*found;
}

bool SnapshotReader::reads(CellId cell) const noexcept {
  return const_cast<SnapshotReader*>(this)->find(cell) != nullptr;
}

void SnapshotReader::begin(CellId cell, nanoseconds now) {
  drop(cell);
  Reading reading;
  reading.cell = cell;
  reading.since = reading.next_ask = now;
  readings_.push_back(reading);
}

void SnapshotReader::drop(CellId cell) {
  std::erase_if(readings_, [cell](const Reading& reading) { return reading.cell == cell; });
}

void SnapshotReader::give_up(CellId cell, nanoseconds now) noexcept {
  Reading* reading = find(cell);
  if (reading == nullptr) return;
  reading->since = now - config_.give_up;
  reading->next_ask = nanoseconds::max();
}

bool SnapshotReader::receive(const pdu::CellSnapshot& part, std::uint32_t leader, nanoseconds now) {
  Reading* reading = find({part.column, part.row});
  const bool fits = part.parts >= 1 && part.parts <= SnapshotServer::kMostParts &&
                    part.part < part.parts && part.serial != 0;
  if (reading == nullptr || !fits) return false;
  const bool continues = reading->leader == leader && reading->serial == part.serial &&
                         reading->parts.parts() == part.parts;
  if (!continues) {
    reading->leader = leader;
    reading->serial = part.serial;
    reading->parts.begin(part.parts);
  }
  reading->next_ask = now + kPause;
  if (!reading->parts.take(part.part)) return false;
  if (reading->parts.missing() == 0) drop(reading->cell);
  return true;
}

std::size_t SnapshotReader::fill(pdu::CellRole& role, std::size_t from, nanoseconds now) {
  Reading* reading = find({role.column, role.row});
  if (reading == nullptr || (from == 0 && now < reading->next_ask)) return 0;
  reading->next_ask = now + config_.ask_again;
  role.flags |= pdu::kRoleAsks;
  if (reading->serial == 0) return 0;
  const PartRequest missing = reading->parts.request(from);
  role.serial = reading->serial;
  role.first_part = static_cast<std::uint16_t>(missing.first);
  role.parts = missing.parts;
  return reading->parts.behind(missing);
}

bool SnapshotReader::take_given_up(nanoseconds now, CellId& cell) {
  const auto late = std::find_if(readings_.begin(), readings_.end(), [&](const Reading& reading) {
    return now - reading.since >= config_.give_up;
  });
  if (late == readings_.end()) return false;
  cell = late->cell;
  readings_.erase(late);
  return true;
}

nanoseconds SnapshotReader::next_step() const noexcept {
  nanoseconds next = nanoseconds::max();
  for (const Reading& reading : readings_) {
    next = std::min({next, reading.next_ask, reading.since + config_.give_up});
  }
  return next;
}

}  // namespace reckon::aoim
