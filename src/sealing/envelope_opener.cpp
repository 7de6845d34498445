// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/peer/sealing/envelope_opener.hpp"

#include <algorithm>
#include <utility>

namespace reckon::peer {

using std::chrono::nanoseconds;

EnvelopeOpener::EnvelopeOpener(const GroupKey& key, const Sealer& own, const ExercisePlaces& places)
    : key_(key), own_(own), places_(places) {
  prepare_sealing();
}

// All checks without cryptography.
SealedVerdict EnvelopeOpener::check(const EnvelopeHeader& header, std::size_t& epoch,
                                    nanoseconds now) const noexcept {
  if (header.suite != key_.suite) return SealedVerdict::other_suite;
  if (header.stream >= kSealingStreams) return SealedVerdict::no_stream;
  if (header.sealer.boot == own_.boot) return SealedVerdict::own;
  const auto found = key_.find(header.epoch);
  if (!found) return SealedVerdict::unknown_epoch;
  epoch = *found;
  // Later epochs of our file are accepted at any time: a sender that has them is a member.
  const bool is_over = epoch < epoch_ && (epoch + 1 != epoch_ || now > grace_until_);
  return is_over ? SealedVerdict::old_epoch : SealedVerdict::opened;
}

OpenedDatagram EnvelopeOpener::open(const Datagram& datagram, nanoseconds since, nanoseconds now,
                                    std::span<std::byte> room) noexcept {
  OpenedDatagram result;
  if (!read_envelope(datagram.bytes, result.header)) return result;
  const EnvelopeHeader& header = result.header;
  std::size_t epoch = 0;
  result.verdict = check(header, epoch, now);
  if (result.verdict != SealedVerdict::opened) return result;

  const std::span<std::byte> plain = room.first(datagram.bytes.size() - kEnvelope);
  SealedSender* sender = senders_.find(header.sealer);
  ReplayWindow* window = sender == nullptr ? nullptr : &sender->windows[header.stream];
  if ((window != nullptr && !window->is_fresh(header.count)) || header.count == 0) {
    result.verdict = SealedVerdict::replayed;
    return result;
  }
  if (sender == nullptr) {
    sender = open_unknown(epoch, header, datagram, now, plain);
    result.is_new = sender != nullptr;
  } else if (!open_known(*sender, epoch, header, datagram, plain)) {
    sender = nullptr;
  }
  if (sender == nullptr) {
    result.verdict = SealedVerdict::forged;
    return result;
  }
  result.sender = sender;
  result.plain = plain;
  take(result, epoch, datagram, since, now);
  return result;
}

// The tag is right; only a timely datagram changes the state.
void EnvelopeOpener::take(OpenedDatagram& result, std::size_t epoch, const Datagram& datagram,
                          nanoseconds since, nanoseconds now) noexcept {
  const EnvelopeHeader& header = result.header;
  SealedSender& sender = *result.sender;
  ReplayWindow& window = sender.windows[header.stream];
  result.is_newest = header.count > window.newest();
  const bool is_greeting = header.stream == static_cast<std::uint16_t>(SealingStream::control);
  if (sender.trusted && !is_greeting &&
      !sender.time.is_timely(header.stamp, datagram.received, since)) {
    result.verdict = SealedVerdict::outdated;
    return;
  }
  window.take(header.count);
  sender.heard = now;
  if (!sender.trusted) return;
  if (!is_greeting) sender.time.note(header.stamp, datagram.received);
  if (epoch > epoch_) move_to(epoch, now + kGrace);
}

void EnvelopeOpener::make_key(std::size_t epoch, const EnvelopeHeader& header) noexcept {
  KeyOctets key = derive_key(key_.epochs[epoch].secret, header);
  tried_.set_key(key_.suite, key);
  wipe(key);
}

bool EnvelopeOpener::open_known(SealedSender& sender, std::size_t epoch,
                                const EnvelopeHeader& header, const Datagram& datagram,
                                std::span<std::byte> room) noexcept {
  const Destination to = places_.of(datagram.group);
  if (const SealingKey* key = sender.key_of(header)) return key->open(datagram.bytes, to, room);
  make_key(epoch, header);
  if (!tried_.open(datagram.bytes, to, room)) return false;
  sender.keep(header, tried_);
  return true;
}

SealedSender* EnvelopeOpener::open_unknown(std::size_t epoch, const EnvelopeHeader& header,
                                           const Datagram& datagram, nanoseconds now,
                                           std::span<std::byte> room) noexcept {
  make_key(epoch, header);
  if (!tried_.open(datagram.bytes, places_.of(datagram.group), room)) return nullptr;
  SealedSender& sender = senders_.add(header.sealer, datagram.sender, now);
  sender.keep(header, tried_);
  return &sender;
}

void EnvelopeOpener::move_to(std::size_t epoch, nanoseconds grace_until) noexcept {
  epoch_ = epoch;
  grace_until_ = grace_until;
}

void EnvelopeOpener::follow_time(nanoseconds now, nanoseconds utc) noexcept {
  const std::size_t epoch = key_.epoch_at(utc);
  const bool is_first_look = !std::exchange(has_time_, true);
  if (epoch <= epoch_) return;
  // An opener that starts long after the change needs no grace period for the epoch before.
  const nanoseconds begun = key_.epochs[epoch].from.value_or(std::chrono::seconds(0));
  move_to(epoch,
          is_first_look ? now + kGrace - std::min<nanoseconds>(kGrace, utc - begun) : now + kGrace);
}

}  // namespace reckon::peer
