// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Rules of `reckon inspect check` about numbers that stand for something: the standard, or
// SISO-REF-010, has no name for them.
#pragma once

#include <optional>

#include "reckon/tools/inspect/check/rules.hpp"

namespace reckon::tools {

[[nodiscard]] std::optional<RuleFault> unknown_drm(const CheckedPdu& checked);
[[nodiscard]] std::optional<RuleFault> unknown_force(const CheckedPdu& checked);
[[nodiscard]] std::optional<RuleFault> unknown_kind(const CheckedPdu& checked);
/// Where the kind has a name.
[[nodiscard]] std::optional<RuleFault> unknown_domain(const CheckedPdu& checked);
/// The first number among the fixed fields of a PDU whose list has no name for it, but for those of
/// the rules above; of an entity's Entity States the first is looked at.
[[nodiscard]] std::optional<RuleFault> unnamed_value(const CheckedPdu& checked);

}  // namespace reckon::tools
