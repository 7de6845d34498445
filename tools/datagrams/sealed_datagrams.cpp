// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/tools/datagrams/sealed_datagrams.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "reckon/pdu/reckon/unicast_frame.hpp"
#include "reckon/peer/sealing/envelope_sealer.hpp"
#include "reckon/tools/command_line/console.hpp"
#include "reckon/tools/terminal/text_table.hpp"

namespace reckon::tools {
namespace {

// A capture can name any number of senders; these are a flood.
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
  const Name name{header.sealer, header.epoch};
  if (const auto known = keys_.find(name); known != keys_.end()) return &known->second;
  if (keys_.size() == kMostKeys) keys_.clear();
  peer::KeyOctets octets = peer::derive_key(key_->epochs[*epoch].secret, header);
  peer::SealingKey& key = keys_[name];
  key.set_key(header.suite, octets);
  peer::wipe(octets);
  return &key;
}

// `front`: octets before the envelope.
bool SealedDatagrams::unseal(const peer::EnvelopeHeader& header, std::size_t front,
                             peer::SourceDatagram& datagram) {
  const peer::SealingKey* key = key_of(header);
  if (key == nullptr || datagram.portion != peer::Portion::whole) return false;
  plain_.resize(datagram.bytes.size() - peer::kEnvelope);
  std::copy_n(datagram.bytes.begin(), front, plain_.begin());
  if (!key->open(datagram.bytes.subspan(front), std::span(plain_).subspan(front))) return false;
  datagram.bytes = plain_;
  return true;
}

bool SealedDatagrams::open(peer::SourceDatagram& datagram) {
  if (datagram.portion == peer::Portion::later_fragment) return true;
  const auto frame = pdu::unicast_frame_of(datagram.bytes);
  const std::size_t front = frame ? frame->header.length : 0;
  const auto header = peer::read_envelope(datagram.bytes.subspan(front));
  if (!header) return true;
  const bool is_open = unseal(*header, front, datagram);
  Kind kind{header->sealer, header->suite, header->epoch};
  if (counts_.size() >= kMostKinds && !counts_.contains(kind)) kind = {{}, header->suite, 0};
  Count& count = counts_[kind];
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
      text += fmt::format(", {} not opened by this key", count.datagrams - count.opened);
    text += '\n';
  }
  if (!key_ && unread_ > 0) text += "not read without the key: give --key FILE\n";
  return text;
}

}  // namespace reckon::tools
