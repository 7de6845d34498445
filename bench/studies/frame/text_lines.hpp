// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Sentences below the tables of studies.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace reckon::bench {

/// Width of tables and of the sentences about them.
inline constexpr std::size_t kTextColumns = 100;

/// Wraps the text to at most `columns`, without a line end after the last line.
[[nodiscard]] std::string wrapped(std::string_view text, std::size_t columns);

/// Name of the processor as the system reports it; "unknown processor" if it does not.
[[nodiscard]] std::string processor_name();

}  // namespace reckon::bench
