// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/tools/exercise/scene_folder.hpp"

#include <fmt/format.h>

#include <system_error>
#include <vector>

#include "reckon/tools/command_line/console.hpp"

namespace reckon::tools {

std::filesystem::path scene_path(const std::string& given, std::string_view fallback) {
  if (!given.empty()) return given;
  std::vector<std::filesystem::path> places;
  std::error_code error;
  const auto program = std::filesystem::read_symlink("/proc/self/exe", error);
  if (!error) places.push_back(program.parent_path() / "../share/reckon/scenes");
  places.emplace_back(RECKON_SCENES);
  std::string looked;
  for (const auto& place : places) {
    if (std::filesystem::exists(place / fallback, error)) return place / fallback;
    looked += fmt::format(" {}", place.lexically_normal().string());
  }
  throw UsageError(fmt::format("{} was not found in{}; name a scene file", fallback, looked));
}

}  // namespace reckon::tools
