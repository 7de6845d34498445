// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Where the scenes that come with Reckon lie.
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace reckon::tools {

/// `given` as it is, or, where it is empty, the shipped scene `fallback`: beside the sources it was
/// built from, else in share/reckon/scenes of the installation. @throws UsageError naming the
/// places looked at.
[[nodiscard]] std::filesystem::path scene_path(const std::string& given, std::string_view fallback);

/// The words with the path of a file that comes with Reckon in the place of "scenes/FILE", where
/// the working folder has no scenes/: what the docs say works from the packages too.
[[nodiscard]] std::vector<std::string> with_shipped_scenes(
    std::span<const std::string_view> arguments);

}  // namespace reckon::tools
