// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The native code that a scene requests (a driver in a shared library), and the rules for loading
// it. A scene is foreign data: it names a driver, and the user of this host gives its location.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "reckon/peer/scene/scene_file.hpp"
#include "reckon/tools/command_line/console.hpp"

namespace reckon::tools {

/// "runs native code: honey.so (driver plugin of device 1)" for each plugin that the scene names;
/// loads nothing.
[[nodiscard]] std::vector<std::string> native_code_of(const peer::SceneFile& scene);

/// Prints these lines to err.
void say_native_code(const peer::SceneFile& scene, const Console& console);

/// Folder of installed drivers: ../lib/reckon/plugins relative to the program's folder.
[[nodiscard]] std::filesystem::path native_code_folder();

/// The file of a driver: the file of `given` (--plugin) with the same name, else the installed one.
/// @param name as written in the scene; with a folder, no installed driver is used
/// @throws UsageError with the remedy for any other
[[nodiscard]] std::filesystem::path trusted_plugin(const std::filesystem::path& name,
                                                   const std::vector<std::string>& given);

}  // namespace reckon::tools
