// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Base of visitors of field tables that use only the fixed fields of a PDU.
#pragma once

namespace reckon::pdu {

/// Skips the counts and lists of records and all other parts of variable size. A derived visitor
/// adds operator() for fixed fields, see codec/field_table.hpp.
struct FixedFields {
  template <typename... Any>
  void count(Any&&...) {}
  template <typename... Any>
  void records(Any&&...) {}
  template <typename... Any>
  void walked(Any&&...) {}
};

}  // namespace reckon::pdu
