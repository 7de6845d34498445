// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Rules of `reckon inspect check` about enumerations: values without a name in the standard or
// SISO-REF-010.
#pragma once

#include <optional>

#include "reckon/tools/inspect/check/rules.hpp"

namespace reckon::tools {

[[nodiscard]] std::optional<RuleFault> unknown_drm(const CheckedPdu& checked);
[[nodiscard]] std::optional<RuleFault> unknown_force(const CheckedPdu& checked);
[[nodiscard]] std::optional<RuleFault> unknown_kind(const CheckedPdu& checked);
/// Checks the domain only if the kind has a name.
[[nodiscard]] std::optional<RuleFault> unknown_domain(const CheckedPdu& checked);
/// The first value without a name among the fixed fields of a PDU, except the fields of the rules
/// above. Only the first Entity State of an entity is checked.
[[nodiscard]] std::optional<RuleFault> unnamed_value(const CheckedPdu& checked);

}  // namespace reckon::tools
