// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// What a search finds is first rid of all it does not need.
#pragma once

#include <cstddef>
#include <optional>
#include <utility>

namespace reckon::fuzz {

/// `whole` without those of its parts that it does not need to fail. Costs a call of `fails` for
/// each that is there.
/// @param parts left out from the last one to the first
/// @param without (const Case&, std::size_t): the case without this part, as a std::optional; none
/// where it has no such part
/// @param fails (const Case&): whether this still breaks what `whole` does
template <typename Case, typename Without, typename Fails>
[[nodiscard]] Case leave_out(Case whole, std::size_t parts, Without&& without, Fails&& fails) {
  for (std::size_t i = parts; i-- > 0;) {
    std::optional<Case> fewer = without(std::as_const(whole), i);
    if (fewer && fails(std::as_const(*fewer))) whole = *std::move(fewer);
  }
  return whole;
}

}  // namespace reckon::fuzz
