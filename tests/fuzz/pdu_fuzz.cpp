// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// One PDU of any listed type: a decoded PDU is encoded octet for octet, reads back as the same
// values and prints within bounds, without heap.
#include <algorithm>
#include <array>
#include <utility>

#include "reckon/pdu/pdu_types.hpp"
#include "reckon/pdu/print.hpp"
#include "reckon/tests/fuzz/field_digest.hpp"
#include "reckon/tests/fuzz/fuzz_target.hpp"
#include "reckon/tests/fuzz/wire_mutator.hpp"

namespace reckon::fuzz {
namespace {

using Octets = std::span<const std::byte>;

std::array<std::byte, pdu::kMaxPduSize> written_octets;
std::array<char, text_bound(pdu::kMaxPduSize)> text;

/// The encoder writes family and length; octets of a later revision may be omitted.
bool is_kept(Octets written, Octets from) {
  return written.size() <= from.size() &&
         std::equal(written.begin(), written.begin() + 3, from.begin()) &&
         std::equal(written.begin() + 4, written.begin() + 8, from.begin() + 4) &&
         std::equal(written.begin() + 10, written.end(), from.begin() + 10);
}

template <typename Pdu>
void check_text(const Pdu& pdu, std::size_t octets) {
  const std::span room = std::span(text).first(text_bound(octets));
  pdu::TextSink json(room);
  print_json(pdu, json);
  require(!json.truncated(), "JSON of a PDU passes its bound");
  pdu::TextSink tree(room);
  print_tree(pdu, tree);
  require(!tree.truncated(), "the tree of a PDU passes its bound");
}

template <typename Pdu>
void check_round_trip(const Pdu& first, Octets from) {
  const std::size_t size = wire_size(first);
  const std::size_t written = encode(first, written_octets);
  require(written == size && written != 0, "what was decoded cannot be encoded");
  const Octets octets = Octets(written_octets).first(written);
  require(is_kept(octets, from), "encoding changed an octet");

  Pdu second;
  require(decode(octets, second) == pdu::DecodeError::none, "what was encoded does not decode");
  Pdu expected = first;
  expected.header.length = static_cast<std::uint16_t>(written);
  expected.header.protocol_family = Pdu::kProtocolFamily;
  require(digest(second) == digest(expected), "a field is not what it was");
  check_text(first, from.size());
}

}  // namespace

void check(std::span<const std::byte> octets) {
  pdu::PduHeader header;
  if (decode_header(octets, header) != pdu::DecodeError::none) return;
  const HeapMeter heap;
  static_cast<void>(pdu::visit(octets, header, [&](const auto& pdu) {
    check_round_trip(pdu, octets.first(header.length));
  }));
  require(heap.allocations() == 0, "the codec took heap");
}

}  // namespace reckon::fuzz

extern "C" std::size_t LLVMFuzzerCustomMutator(std::uint8_t* data, std::size_t size,
                                               std::size_t max_size, unsigned seed) {
  size = LLVMFuzzerMutate(data, size, max_size);
  const std::span octets = std::as_writable_bytes(std::span(data, size));
  if (seed % 8 != 0) reckon::fuzz::repair_header(octets);
  if (seed % 16 == 1 && size > 2)
    octets[2] = static_cast<std::byte>(reckon::fuzz::listed_type(seed / 16));
  return size;
}
