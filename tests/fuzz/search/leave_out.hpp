// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Reduces a finding to the parts that it needs.
#pragma once

#include <cstddef>
#include <optional>
#include <utility>

namespace reckon::fuzz {

/// `whole` without the parts that are not needed for its failure. Costs a call of `fails` for each
/// existing part.
/// @param parts number of parts, omitted from the last to the first
/// @param without (const Case&, std::size_t): the case without this part, as a std::optional; none
///     if it has no such part
/// @param fails (const Case&): whether the case still fails as `whole` does
template <typename Case, typename Without, typename Fails>
[[nodiscard]] Case leave_out(Case whole, std::size_t parts, Without&& without, Fails&& fails) {
  for (std::size_t i = parts; i-- > 0;) {
    std::optional<Case> fewer = without(std::as_const(whole), i);
    if (fewer && fails(std::as_const(*fewer))) whole = *std::move(fewer);
  }
  return whole;
}

}  // namespace reckon::fuzz
