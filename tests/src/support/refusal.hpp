// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>

#include "reckon/peer/scene/scene_file.hpp"

namespace reckon::test {

/// The error text of the scene file reader for `text`; empty if it accepts.
inline std::string refusal(const std::string& text, const std::filesystem::path& folder = ".") {
  try {
    (void)peer::parse_scene_file(text, "x.toml", folder);
    return {};
  } catch (const peer::SceneFileError& error) {
    return error.what();
  }
}

}  // namespace reckon::test
