// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/tools/datagrams/sealed_datagrams.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "reckon/pdu/reckon/unicast_frame.hpp"
#include "reckon/peer/sealing/envelope_sealer.hpp"
#include "reckon/tools/command_line/console.hpp"
#include "reckon/tools/terminal/text_table.hpp"

namespace reckon::tools {
namespace {

// A capture can name any number of senders; above this number they are a flood.
constexpr std::size_t kMostKinds = 1024;
constexpr std::size_t kMostKeys = 4096;

bool is_greeting(const peer::EnvelopeHeader& header) {
  return header.stream == static_cast<std::uint16_t>(peer::SealingStream::control);
}

}  // namespace

SealedDatagrams::SealedDatagrams(const std::string& key_file) {
  if (key_file.empty()) return;
  try {
    key_ = peer::load_group_key(key_file);
  } catch (const peer::KeyFileError& error) {
    throw UsageError(error.what());
  }
}

const peer::SealingKey* SealedDatagrams::key_of(const peer::EnvelopeHeader& header) {
  if (!key_ || header.suite != key_->suite) return nullptr;
  const auto epoch = key_->find(header.epoch);
  if (!epoch) return nullptr;
  const Name name{header.sealer, header.epoch, header.stream};
  const std::uint64_t salt = peer::key_salt(header);
  const auto known = keys_.find(name);
  if (known != keys_.end() && known->second.salt == salt) return &known->second.key;
  if (keys_.size() == kMostKeys) keys_.clear();
  peer::KeyOctets octets = peer::derive_key(key_->epochs[*epoch].secret, header);
  Kept& kept = keys_[name];
  kept.salt = salt;
  kept.key.set_key(header.suite, octets);
  peer::wipe(octets);
  return &kept.key;
}

// A capture does not state the exercise of a sealed datagram, and the tag covers it. If the
// exercise of the sender is known, only that one is tried; else all are tried, beginning with the
// exercise of the last opened datagram of any sender.
bool SealedDatagrams::unseal_for_any(const peer::SealingKey& key, const peer::GroupAddress& group,
                                     std::span<const std::byte> sealed, std::span<std::byte> plain,
                                     Count& count) {
  const auto opens = [&](std::uint8_t exercise) {
    return key.open(sealed, peer::destination_of(group, exercise), plain);
  };
  if (count.exercise) return opens(*count.exercise);
  for (unsigned i = 0; i <= std::numeric_limits<std::uint8_t>::max(); ++i) {
    const auto exercise = static_cast<std::uint8_t>(exercise_ + i);
    if (!opens(exercise)) continue;
    count.exercise = exercise_ = exercise;
    return true;
  }
  return false;
}

// `front`: octets before the envelope, which state group and exercise.
bool SealedDatagrams::unseal(const peer::EnvelopeHeader& header, peer::SourceDatagram& datagram,
                             std::size_t front, Count& count) {
  const peer::SealingKey* key = key_of(header);
  if (key == nullptr || datagram.portion != peer::Portion::whole) return false;
  plain_.resize(datagram.bytes.size() - peer::kEnvelope);
  std::copy_n(datagram.bytes.begin(), front, plain_.begin());
  const std::span<const std::byte> sealed = datagram.bytes.subspan(front);
  const std::span<std::byte> plain = std::span(plain_).subspan(front);
  if (const auto frame = pdu::unicast_frame_of(datagram.bytes)) {
    const auto to = peer::listed_destination(frame->group, frame->header.exercise_id);
    if (!key->open(sealed, to, plain)) return false;
  } else if (!unseal_for_any(*key, datagram.group, sealed, plain, count)) {
    return false;
  }
  datagram.bytes = plain_;
  return true;
}

SealedDatagrams::Count& SealedDatagrams::count_of(const peer::EnvelopeHeader& header) {
  Kind kind{header.sealer, header.suite, header.epoch};
  if (counts_.size() >= kMostKinds && !counts_.contains(kind)) kind = {{}, header.suite, 0};
  return counts_[kind];
}

bool SealedDatagrams::open(peer::SourceDatagram& datagram) {
  if (peer::is_headless(datagram.portion)) return true;
  const auto frame = pdu::unicast_frame_of(datagram.bytes);
  const std::size_t front = frame ? frame->header.length : 0;
  const auto header = peer::read_envelope(datagram.bytes.subspan(front));
  if (!header) return true;
  Count& count = count_of(*header);
  const bool is_open = unseal(*header, datagram, front, count);
  ++count.datagrams;
  if (!is_open) ++unread_;
  if (is_open) ++count.opened;
  const bool is_read = is_open && !is_greeting(*header);
  if (is_open && !is_read) ++count.greetings;
  return is_read;
}

std::string SealedDatagrams::summary() const {
  std::string text;
  for (const auto& [kind, count] : counts_) {
    text +=
        fmt::format("sealed: {} of {}:{} (boot {:016x}), {}, epoch {}",
                    counted(count.datagrams, "datagram"), kind.sealer.site, kind.sealer.application,
                    kind.sealer.boot, peer::word_of_suite(kind.suite), kind.epoch);
    if (count.greetings > 0) text += fmt::format(", {}", counted(count.greetings, "greeting"));
    if (key_ && count.opened < count.datagrams)
      text += fmt::format(", {} not readable with this key", count.datagrams - count.opened);
    text += '\n';
  }
  if (!key_ && unread_ > 0) text += "not readable without the key: add --key FILE\n";
  return text;
}

}  // namespace reckon::tools
