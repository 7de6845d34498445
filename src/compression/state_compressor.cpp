// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/peer/compression/state_compressor.hpp"

#include <algorithm>
#include <array>

#include "reckon/pdu/compression/compact_state.hpp"

namespace reckon::peer {
namespace {

using pdu::CompressedForm;
using std::chrono::nanoseconds;

constexpr unsigned kMostGap = 32;                              // updates
constexpr nanoseconds kLongestGap = std::chrono::seconds(10);  // for newcomers without a key state

using Body = std::array<std::byte, pdu::kMostCompact>;

std::size_t store(const pdu::EntityState& state, CompressedForm form, const Body& body,
                  std::size_t size, std::span<std::byte> out) {
  if (size == 0) return 0;
  return pdu::store_compressed({state.entity_id.entity, form, std::span(body).first(size)}, out);
}

std::size_t store_compact(const pdu::EntityState& state, std::span<std::byte> out) {
  Body body;
  return store(state, CompressedForm::compact, body, pdu::encode_compact(state, {}, body), out);
}

}  // namespace

StateCompressor::Made StateCompressor::compress(const pdu::EntityState& state,
                                                aoim::GroupIndex group, bool plain, nanoseconds now,
                                                std::span<std::byte, kRoom> out) noexcept {
  const bool needs_key = form_ == CompressedForm::residual;
  if (needs_key && !plain && !is_key_due(group, now)) {
    Body body;
    const std::size_t encoded =
        residual_.encode(state, std::span(body).first<deadreckon::kMostResidual>());
    const std::size_t size = store(state, form_, body, encoded, out);
    if (size > 0) {
      ++since_;
      return {size, false, true};
    }
  }
  const bool known = gap_ > 0 && group == group_;  // to the listeners of this group
  if (plain) gap_ = 0;  // a newcomer may miss it: key states follow as closely as after the first
  note_key(state, group, now);
  if (plain || (needs_key && !known)) return {0, true};
  return {store_compact(state, out), needs_key};
}

std::size_t StateCompressor::compress_independent(const pdu::EntityState& state,
                                                  std::span<std::byte, kRoom> out) const noexcept {
  return form_ == CompressedForm::compact ? store_compact(state, out) : 0;
}

bool StateCompressor::is_key_due(aoim::GroupIndex group, nanoseconds now) const noexcept {
  return gap_ == 0 || group != group_ || since_ >= gap_ || now - keyed_ >= kLongestGap;
}

void StateCompressor::note_key(const pdu::EntityState& state, aoim::GroupIndex group,
                               nanoseconds now) noexcept {
  const bool first = gap_ == 0 || group != group_;
  gap_ = first ? 1 : std::min(4 * gap_, kMostGap);
  since_ = 1;
  group_ = group;
  keyed_ = now;
  const bool good = form_ != CompressedForm::residual || residual_.note_key(state);
  if (!good) gap_ = 0;  // the next one is a key state too
}

}  // namespace reckon::peer
