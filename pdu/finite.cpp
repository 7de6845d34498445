// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/pdu/finite.hpp"

namespace reckon::pdu {

void FiniteCheck::walked(std::string_view name, const AttributeRecordSets& sets) noexcept {
  Attribute pdu;
  pdu.record_sets = sets;
  for (const AttributeSet& set : AttributeReader(pdu)) {
    for (const AttributeRecord& record : set.records())
      static_cast<void>(
          visit_attribute_record(record, [&](const auto& typed) { (*this)(name, typed); }));
  }
}

}  // namespace reckon::pdu
