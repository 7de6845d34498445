// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Determines the kind of a file: by its content, else by its name.
#pragma once

#include <cstdint>
#include <string>

namespace reckon::tools {

/// Kinds of files that verbs take.
enum class FileKind : std::uint8_t { unknown, capture, scene, mesh, key, table };

/// By the first octets of a regular file if they are characteristic, else by the end of its name.
/// Unknown if there is no such file.
[[nodiscard]] FileKind kind_of_file(const std::string& path);

/// For a capture or a mesh in place of a scene: the command that opens it; else empty.
[[nodiscard]] std::string no_scene_remedy(const std::string& path);

}  // namespace reckon::tools
