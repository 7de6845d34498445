// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// `reckon FILE`: the verb that opens a file.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "reckon/tools/command_line/console.hpp"

namespace reckon::tools {

/// The words of the verb that opens `words`, the first of which is a file; also prints them to
/// `console.err`. Nothing if there is no such file.
/// @throws UsageError that names the verbs, if none opens the file directly
[[nodiscard]] std::optional<std::vector<std::string>> words_for_file(Arguments words,
                                                                     const Console& console);

}  // namespace reckon::tools
