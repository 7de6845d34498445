// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// "did you mean ...?": the common rule for keys of scene files, verbs, flags and filter fields.
#pragma once

#include <span>
#include <string_view>

namespace reckon::peer {

/// The candidate nearest to a mistyped word; empty if none is near enough.
[[nodiscard]] std::string_view nearest_word(std::string_view typed,
                                            std::span<const std::string_view> candidates);

}  // namespace reckon::peer
