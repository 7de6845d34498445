// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// `reckon FILE`: what a file is, and the verb that opens it.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "reckon/tools/command_line/console.hpp"

namespace reckon::tools {

/// Kinds of files that verbs take.
enum class FileKind : std::uint8_t { unknown, capture, scene, mesh, key, table };

/// By its first octets if they tell, else by the end of its name. Unknown too if it cannot be read.
[[nodiscard]] FileKind kind_of_file(const std::string& path);

/// The words by which a verb opens `words`, the first of which names a file; what they are is
/// written to `console.err`. Nothing if there is no such file.
/// @throws UsageError that names the verbs where none opens it by itself
[[nodiscard]] std::optional<std::vector<std::string>> words_for_file(Arguments words,
                                                                     const Console& console);

}  // namespace reckon::tools
