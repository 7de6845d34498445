// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Sentences below the tables of studies.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace reckon::bench {

/// Of tables and the sentences about them.
inline constexpr std::size_t kTextColumns = 100;

/// The text in lines of at most so many columns, without an end of line behind the last.
[[nodiscard]] std::string wrapped(std::string_view text, std::size_t columns);

/// The processor as the system names it, for people; "unknown processor" where it does not.
[[nodiscard]] std::string processor_name();

}  // namespace reckon::bench
