// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/pdu/codec/pdu_header.hpp"

#include "reckon/pdu/codec/codec.hpp"

namespace reckon::pdu {

DecodeError decode_header(std::span<const std::byte> bytes, PduHeader& out) noexcept {
  if (!load_record(bytes, out)) out = PduHeader{};
  return check_header(bytes);
}

}  // namespace reckon::pdu
