// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/peer/compression/state_compressor.hpp"

#include <algorithm>

#include "reckon/pdu/compression/compact_state.hpp"

namespace reckon::peer {
namespace {

using pdu::CompressedForm;
using std::chrono::nanoseconds;

constexpr unsigned kMostGap = 32;                              // updates
constexpr nanoseconds kLongestGap = std::chrono::seconds(10);  // for who missed the first keys
// Of the delta form, which loses all up to the next key where it loses one. Its keys are no longer
// than what leans on them.
constexpr unsigned kMostDeltaGap = 4;
constexpr nanoseconds kLongestDeltaGap = std::chrono::seconds(2);

unsigned most_gap(CompressedForm form) {
  return form == CompressedForm::delta ? kMostDeltaGap : kMostGap;
}
nanoseconds longest_gap(CompressedForm form) {
  return form == CompressedForm::delta ? kLongestDeltaGap : kLongestGap;
}

}  // namespace

StateCompressor::Made StateCompressor::compress(const pdu::EntityState& state,
                                                aoim::GroupIndex group, bool plain, nanoseconds now,
                                                std::span<std::byte, kRoom> out) noexcept {
  std::array<std::byte, pdu::kMostDelta> body;
  const auto store = [&](CompressedForm form, std::size_t size) {
    return size == 0 ? 0
                     : pdu::store_compressed(
                           {state.entity_id.entity, form, std::span(body).first(size)}, out);
  };
  const bool leans = form_ != CompressedForm::compact;
  if (leans && !plain && !is_key_due(group, now)) {
    const std::size_t size = store(form_, lean_on_key(state, body));
    if (size > 0) {
      ++since_;
      return {size, false, true};
    }
  }
  const bool known = gap_ > 0 && group == group_;  // by those who hear this group
  if (plain) gap_ = 0;  // who is new may miss it: the keys after it are as near as the first
  note_key(state, group, now);
  if (plain || (leans && !known)) return {0, true};
  return {store(CompressedForm::compact, pdu::encode_compact(state, {}, body)), leans};
}

std::size_t StateCompressor::compress_near(const pdu::EntityState& state, aoim::GroupIndex group,
                                           nanoseconds now,
                                           std::span<std::byte, kRoom> out) noexcept {
  // A residual leans on each state before it, and those farther away have heard fewer of them.
  if (form_ == CompressedForm::residual) return 0;
  const bool leans = form_ != CompressedForm::compact;
  if (leans && (gap_ == 0 || group != group_ || now - keyed_ >= longest_gap(form_))) return 0;
  std::array<std::byte, pdu::kMostDelta> body;
  const std::size_t size = leans ? lean_on_key(state, body) : pdu::encode_compact(state, {}, body);
  if (size == 0) return 0;
  return pdu::store_compressed({state.entity_id.entity, form_, std::span(body).first(size)}, out);
}

bool StateCompressor::is_key_due(aoim::GroupIndex group, nanoseconds now) const noexcept {
  return gap_ == 0 || group != group_ || since_ >= gap_ || now - keyed_ >= longest_gap(form_);
}

std::size_t StateCompressor::lean_on_key(const pdu::EntityState& state,
                                         std::span<std::byte> body) noexcept {
  if (form_ == CompressedForm::residual) {
    return residual_.encode(state, body.first<deadreckon::kMostResidual>());
  }
  std::array<std::byte, 144> plain;
  if (pdu::encode(state, plain) != plain.size()) return 0;
  return pdu::encode_delta(key_, key_check_, plain, body);
}

void StateCompressor::note_key(const pdu::EntityState& state, aoim::GroupIndex group,
                               nanoseconds now) noexcept {
  const bool first = gap_ == 0 || group != group_;
  gap_ = first ? 1 : std::min(4 * gap_, most_gap(form_));
  since_ = 1;
  group_ = group;
  keyed_ = now;
  bool good = true;
  if (form_ == CompressedForm::residual) good = residual_.note_key(state);
  if (form_ == CompressedForm::delta) {
    good = pdu::encode(state, key_) == key_.size();
    key_check_ = pdu::key_check(key_);
  }
  if (!good) gap_ = 0;  // the next one is a key too
}

}  // namespace reckon::peer
