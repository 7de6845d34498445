// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Any text as a key file: it gives a key that reads back unchanged after writing, or is refused
// with a sentence without any part of the text, because the secret may be anywhere in it.
#include <string>

#include "reckon/peer/sealing/key_file.hpp"
#include "reckon/tests/fuzz/fuzz_target.hpp"

namespace reckon::fuzz {
namespace {}  // namespace

void check(std::span<const std::byte> input) {
  const std::string_view text = text_of(input);
  std::string written;
  try {
    const peer::GroupKey key = peer::parse_group_key(text, "f");
    require(!key.epochs.empty() && key.epochs.size() <= peer::GroupKey::kMostEpochs, "epochs");
    require(key.epoch_at(std::chrono::hours(1)) < key.epochs.size(), "no epoch holds");
    written = peer::group_key_text(key);
  } catch (const peer::KeyFileError& error) {
    const std::string_view sentence = error.what();
    require(sentence.starts_with("f:"), "refused without a place");
    require(sentence.size() < 120, "the sentence has the text in it");
    return;
  }
  require(peer::group_key_text(peer::parse_group_key(written, "f")) == written,
          "what was written is read as something else");
}

}  // namespace reckon::fuzz
