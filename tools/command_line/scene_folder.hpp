// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Finds the scenes shipped with Reckon.
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace reckon::tools {

/// `given` unchanged, or, if it is empty, the shipped scene `fallback`: in share/reckon/scenes
/// of the installation, else in the sources of the build, also if both were moved together.
/// @throws UsageError with the searched folders.
[[nodiscard]] std::filesystem::path scene_path(const std::string& given, std::string_view fallback);

/// The folder of this program if it is a build folder; else empty.
[[nodiscard]] std::filesystem::path build_folder();

/// The words, with "scenes/FILE" replaced by the path of the shipped file if the working folder has
/// no scenes/: so commands from the docs also work with installed packages.
[[nodiscard]] std::vector<std::string> with_shipped_scenes(
    std::span<const std::string_view> arguments);

}  // namespace reckon::tools
