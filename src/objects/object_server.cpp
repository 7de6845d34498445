// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/peer/objects/object_server.hpp"

#include <algorithm>
#include <utility>

#include "reckon/peer/objects/missing_chunks.hpp"

namespace reckon::peer {
namespace {

double seconds_of(std::chrono::nanoseconds time) {
  return std::chrono::duration<double>(time).count();
}

/// Whether serial `one` was sent after `other`, across the wrap.
bool is_after(std::uint32_t one, std::uint32_t other) {
  return static_cast<std::int32_t>(one - other) > 0;
}

}  // namespace

ObjectServer::ObjectServer(std::uint32_t epoch, double rate, std::uint64_t seed)
    : epoch_(epoch), rate_(rate), timer_(seed) {}

void ObjectServer::add(std::shared_ptr<const ObjectSource> source) {
  const std::uint64_t key = key_of(source->hash());
  for (const Served& served : served_)
    if (served.key == key) return;
  served_.emplace_back();
  served_.back().source = std::move(source);
  served_.back().key = key;
}

void ObjectServer::take_request(const pdu::ObjectRequest& request,
                                std::span<const std::byte> missing, Nanoseconds now) {
  const auto found = std::ranges::find_if(
      served_, [&](const Served& one) { return one.source->hash() == request.object; });
  if (found == served_.end() || found->source->layout().size() != request.size) return;
  const bool is_ours = request.server == epoch_ || (request.server == 0 && found->serves);
  if (is_ours) return serve(*found, request, missing, now);
  const bool other_lives = request.server != 0 || now - found->heard < kSilent;
  const Nanoseconds patience = other_lives ? Nanoseconds(kSilent) : Nanoseconds::zero();
  Waiting& waiting = found->waiting;
  if (waiting.until == kNever) waiting.until = now + patience + timer_.draw(kLongestWait);
  waiting.request = request;
  waiting.missing.assign(missing.begin(), missing.end());
}

void ObjectServer::serve(Served& served, const pdu::ObjectRequest& request,
                         std::span<const std::byte> missing, Nanoseconds now) {
  const std::uint32_t chunks = served.source->layout().chunks();
  if (!served.serves) {
    served.serves = true;
    served.pending = ChunkMap(chunks);
    served.serials.assign(chunks, 0);
    served.cursor = 0;
    served.status_at = now;
  }
  served.waiting.until = kNever;
  served.requested = now;
  served.pause = kFirstPause;
  const bool knows = request.server == epoch_ && (request.flags & pdu::kSeenKnown) != 0;
  for_each_missing(request, missing, chunks, [&](std::uint32_t first, std::uint32_t count) {
    for (std::uint32_t i = first; i < first + count; ++i) {
      const std::uint32_t sent = served.serials[i];
      const bool is_under_way = knows && sent != 0 && is_after(sent, request.seen);
      if (!is_under_way) served.pending.add(i);
    }
  });
  const Nanoseconds pause = served.pending.count() > 0 ? Nanoseconds(kStatusPeriod) : served.pause;
  served.status_at = std::min(served.status_at, now + pause);
}

void ObjectServer::stop(Served& served) noexcept {
  served.serves = false;
  served.pending = ChunkMap();
  served.serials = {};
  served.status_at = kNever;
}

void ObjectServer::take_status(std::uint32_t epoch, const DueStatus& status,
                               Nanoseconds now) noexcept {
  const auto served = std::ranges::find(served_, status.key, &Served::key);
  if (served == served_.end()) return;
  const bool sends = status.pending > 0 || epoch != served->other ||
                     status.serial != served->other_serial;
  served->other = epoch;
  served->other_serial = status.serial;
  if (!sends) return;
  served->heard = now;
  served->waiting.until = kNever;
  if (served->serves && epoch < epoch_) stop(*served);
}

// Answers the requests that nobody has answered, and ends what nobody requests.
void ObjectServer::advance(Nanoseconds now) {
  for (Served& served : served_) {
    if (served.waiting.until <= now)
      serve(served, served.waiting.request, served.waiting.missing, now);
    if (!served.serves) continue;
    if (served.pending.count() > 0 && now - served.requested > kUnwanted)
      served.pending = ChunkMap(served.pending.chunks());
    if (now - served.requested > kForgets) stop(served);
  }
  const double most = std::max(rate_ * seconds_of(kBurst), 2.0 * pdu::kChunkOctets);
  credit_ = std::min(most, credit_ + rate_ * seconds_of(now - credited_));
  credited_ = now;
}

bool ObjectServer::take_chunk(Nanoseconds now, DueChunk& due) {
  advance(now);
  for (std::size_t i = 0; i < served_.size(); ++i) {
    turn_ = (turn_ + 1) % served_.size();
    Served& served = served_[turn_];
    if (!served.serves || served.pending.count() == 0) continue;
    std::uint32_t index = served.pending.next(served.cursor, true);
    if (index == served.pending.chunks()) index = served.pending.next(0, true);
    const std::size_t length = served.source->layout().length(index);
    if (credit_ < static_cast<double>(length)) return false;
    credit_ -= static_cast<double>(length);
    served.pending.remove(index);
    if (++serial_ == 0) ++serial_;
    served.serials[index] = serial_;
    served.cursor = index + 1;
    if (served.pending.count() == 0) served.status_at = now;
    due = {served.source.get(), index, serial_};
    return true;
  }
  return false;
}

bool ObjectServer::take_status(Nanoseconds now, DueStatus& due) noexcept {
  for (Served& served : served_) {
    if (served.status_at > now) continue;
    if (served.pending.count() > 0) {
      served.status_at = now + kStatusPeriod;
    } else {
      served.status_at = now + served.pause;
      served.pause = std::min<Nanoseconds>(2 * served.pause, kLastPause);
    }
    due = {served.key, serial_, served.pending.count()};
    return true;
  }
  return false;
}

std::chrono::nanoseconds ObjectServer::next_step(Nanoseconds now) const noexcept {
  Nanoseconds next = kNever;
  for (const Served& served : served_) {
    next = std::min({next, served.status_at, served.waiting.until});
    if (!served.serves || served.pending.count() == 0) continue;
    const double lacks = static_cast<double>(pdu::kChunkOctets) - credit_;
    const auto wait = std::chrono::duration<double>(std::max(0.0, lacks) / rate_);
    next = std::min(next, std::max(now, credited_ + std::chrono::duration_cast<Nanoseconds>(wait)));
  }
  return next;
}

}  // namespace reckon::peer
