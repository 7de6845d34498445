// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/peer/ownership/tenure_table.hpp"

#include <algorithm>

#include "reckon/pdu/random/split_mix.hpp"

namespace reckon::peer {
namespace {

std::uint64_t bits_of(std::size_t object, const Tenure& tenure) noexcept {
  if (tenure == Tenure{}) return 0;
  return pdu::split_mix(pdu::split_mix(tenure.version) ^
                        (std::uint64_t{tenure.owner} << 32 | object));
}

}  // namespace

Offer TenureTable::judge(std::size_t object, const Tenure& tenure, std::uint32_t sender,
                         const ActBook& acts, bool is_silent) const noexcept {
  const Tenure& known = tenures_[object];
  if (tenure == known) return Offer::known;
  if (!is_newer(tenure, known)) return Offer::older;
  const std::uint32_t act = act_of(tenure.version);
  if (act > acts.decided().number || count_of(tenure.version) >= kMostHandOvers)
    return Offer::of_other_act;
  const bool has_owner = tenure.owner != 0;
  const bool is_by_owner = sender == known.owner && (tenure.owner == sender || !has_owner);
  const bool is_by_other = has_owner && tenure.owner != sender;
  // An act has given it away that this peer has missed.
  const bool is_orphan = !acts.decided().roll.contains(known.owner) && act > act_of(known.version);
  if (!is_by_owner && !is_by_other && !is_orphan && !is_silent && !is_witnessed(object, tenure))
    return Offer::unwitnessed;
  return Offer::taken;
}

Offer TenureTable::offer(std::size_t object, const Tenure& tenure, std::uint32_t sender,
                         const ActBook& acts, bool is_silent) noexcept {
  if (object >= count_) return Offer::of_other_act;
  if (tenure.owner != sender && tenure.owner != 0) name(object, tenure);
  const Offer offer = judge(object, tenure, sender, acts, is_silent);
  if (offer == Offer::taken) tenures_[object] = tenure;
  return offer;
}

bool TenureTable::may_grant(std::size_t object, std::uint32_t epoch) const noexcept {
  return tenures_[object].owner == epoch || is_witnessed(object, {~std::uint64_t{0}, epoch});
}

// An owner may have raised its version since.
bool TenureTable::is_witnessed(std::size_t object, const Tenure& tenure) const noexcept {
  return std::ranges::any_of(named_[object], [&](const Tenure& named) {
    return named.owner == tenure.owner && named.version <= tenure.version &&
           named.version >= tenures_[object].version;
  });
}

void TenureTable::name(std::size_t object, const Tenure& tenure) noexcept {
  if (object >= count_ || !is_newer(tenure, named_[object].front())) return;
  std::copy_backward(named_[object].begin(), named_[object].end() - 1, named_[object].end());
  named_[object].front() = tenure;
}

void TenureTable::clear() noexcept {
  tenures_.fill({});
  named_.fill({});
}

std::uint32_t TenureTable::hash() const noexcept {
  std::uint64_t hash = 0;
  for (std::size_t i = 0; i < count_; ++i) hash ^= bits_of(i, tenures_[i]);
  return static_cast<std::uint32_t>(hash >> 32);
}

std::uint32_t TenureTable::digest(const ObjectSet& objects) const noexcept {
  std::uint64_t hash = 0;
  for (std::size_t i = 0; i < count_; ++i) {
    if (objects[i]) hash ^= bits_of(i, tenures_[i]);
  }
  return static_cast<std::uint32_t>(hash >> 32);
}

}  // namespace reckon::peer
