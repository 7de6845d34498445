// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/tools/command_line/scene_folder.hpp"

#include <fmt/format.h>

#include <optional>
#include <system_error>
#include <vector>

#include "reckon/tools/command_line/console.hpp"

namespace reckon::tools {

namespace {

namespace fs = std::filesystem;

/// The folder of the installed program, then the source folder: above the build folder, then where
/// it was at the build.
std::vector<fs::path> folders() {
  std::vector<fs::path> places;
  std::error_code error;
  const fs::path program = fs::read_symlink("/proc/self/exe", error);
  if (!error) places.push_back(program.parent_path() / "../share/reckon/scenes");
  if (const fs::path build = build_folder(); !build.empty())
    places.push_back(build / "../../scenes");
  places.emplace_back(RECKON_SCENES);
  return places;
}

std::optional<fs::path> shipped(const fs::path& name) {
  std::error_code error;
  for (const fs::path& place : folders())
    if (fs::exists(place / name, error)) return (place / name).lexically_normal();
  return std::nullopt;
}

}  // namespace

fs::path build_folder() {
  std::error_code error;
  const fs::path folder = fs::read_symlink("/proc/self/exe", error).parent_path();
  return !error && fs::exists(folder / "CMakeCache.txt", error) ? folder : fs::path();
}

fs::path scene_path(const std::string& given, std::string_view fallback) {
  if (!given.empty()) return given;
  if (const auto found = shipped(fallback)) return *found;
  std::string looked;
  for (const fs::path& place : folders())
    looked += fmt::format(" {}", place.lexically_normal().string());
  throw UsageError(fmt::format("{} was not found in{}; name a scene file", fallback, looked));
}

std::vector<std::string> with_shipped_scenes(std::span<const std::string_view> arguments) {
  constexpr std::string_view kFolder = "scenes/";
  std::vector<std::string> words(arguments.begin(), arguments.end());
  std::error_code error;
  if (fs::exists(kFolder, error)) return words;
  for (std::string& word : words) {
    if (!word.starts_with(kFolder)) continue;
    if (const auto found = shipped(word.substr(kFolder.size()))) word = found->string();
  }
  return words;
}

}  // namespace reckon::tools
