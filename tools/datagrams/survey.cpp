// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/tools/datagrams/survey.hpp"

#include <algorithm>

#include "reckon/pdu/bundle.hpp"
#include "reckon/pdu/entity/attribute.hpp"

namespace reckon::tools {

void DatagramSurvey::look_at(std::span<const std::byte> datagram) {
  attributes.clear();
  for (const pdu::BundledPdu& bundled : pdu::BundleReader(datagram)) {
    if (bundled.error != pdu::DecodeError::none) continue;
    pdu::Attribute attribute;
    if (bundled.header.pdu_type != pdu::PduType::attribute ||
        decode(bundled.bytes, attribute) != pdu::DecodeError::none)
      continue;
    for (const pdu::AttributeSet& set : pdu::AttributeReader(attribute))
      attributes.push_back(
          {entity_key(bundled.header.exercise_id, set.entity_id), bundled.index + 1});
  }
  std::sort(attributes.begin(), attributes.end());
}

std::span<const DatagramSurvey::Place> DatagramSurvey::of(std::uint64_t entity) const {
  const auto less = [](const Place& place, std::uint64_t key) { return place.entity < key; };
  const auto first = std::lower_bound(attributes.begin(), attributes.end(), entity, less);
  const auto last = std::lower_bound(first, attributes.end(), entity + 1, less);
  return {first, last};
}

}  // namespace reckon::tools
