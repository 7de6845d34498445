// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/peer/federation/federate_records.hpp"

#include <stdexcept>

#include "reckon/peer/federation/loop_side.hpp"

namespace reckon::peer {

void FederateRecords::set(std::string_view key, std::span<const std::byte> value) {
  if (interop_)
    throw std::logic_error("plain DIS has no shared records: use a scene without interop = true");
  if (!is_record_key(key))
    throw std::invalid_argument("the key '" + std::string(key) +
                                "' of a record needs 1 to 63 octets without control characters");
  if (value.size() > pdu::kMostRecordValue)
    throw std::length_error("a record has at most 1024 octets: send " +
                            std::to_string(value.size()) + " octets in several");
  side_.wishes().letter().records.push_back(
      {std::string(key), std::vector<std::byte>(value.begin(), value.end())});
}

std::optional<std::span<const std::byte>> FederateRecords::find(std::string_view key) const {
  const auto value = values_.find(key);
  if (value == values_.end()) return std::nullopt;
  return value->second;
}

void FederateRecords::call_back(News& news) {
  for (const std::string& key : news.refused_records)
    if (refused_) refused_(key);
  for (News::Record& record : news.records) {
    if (record.is_removed) {
      values_.erase(record.key);
      continue;
    }
    const auto place = values_.insert_or_assign(record.key, std::move(record.value)).first;
    if (changed_ && !record.is_ours) changed_(place->first, place->second, record.writer);
  }
}

}  // namespace reckon::peer
