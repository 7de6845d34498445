// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// What a file is: by its content, and where that does not tell, by its name.
#pragma once

#include <cstdint>
#include <string>

namespace reckon::tools {

/// Kinds of files that verbs take.
enum class FileKind : std::uint8_t { unknown, capture, scene, mesh, key, table };

/// By its first octets if they tell, else by the end of its name. Unknown too if it cannot be read.
[[nodiscard]] FileKind kind_of_file(const std::string& path);

}  // namespace reckon::tools
