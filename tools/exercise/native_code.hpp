// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Which native code a scene asks for (driver = "plugin"), and which of it may be loaded. A scene is
// data of somebody else: it names a driver, and the user of this host says where that is.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "reckon/peer/scene/scene_file.hpp"
#include "reckon/tools/command_line/console.hpp"

namespace reckon::tools {

/// "runs native code: honey.so (driver plugin of device 1)" for each that the scene names; loads
/// nothing.
[[nodiscard]] std::vector<std::string> native_code_of(const peer::SceneFile& scene);

/// Prints these lines on err.
void say_native_code(const peer::SceneFile& scene, const Console& console);

/// Where drivers are installed: ../lib/reckon/plugins from the program's folder.
[[nodiscard]] std::filesystem::path plugin_folder();

/// The file of a driver: that of `given` (--plugin) which has the same name, else the installed
/// one. @param name as the scene has it; where it has a folder, no installed one is taken
/// @throws UsageError with the remedy for any other
[[nodiscard]] std::filesystem::path trusted_plugin(const std::filesystem::path& name,
                                                   const std::vector<std::string>& given);

}  // namespace reckon::tools
