// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <filesystem>
#include <stdexcept>
#include <system_error>

#include "reckon/peer/scene/device_descriptor.hpp"

namespace reckon::peer {

namespace fs = std::filesystem;

std::vector<fs::path> device_folders() {
  std::vector<fs::path> places;
  std::error_code error;
  const fs::path program = fs::read_symlink("/proc/self/exe", error);
  if (!error)
    places.push_back((program.parent_path() / "../share/reckon/devices").lexically_normal());
  places.emplace_back(RECKON_INSTALLED_DEVICES);
  places.emplace_back(RECKON_DEVICES);
  return places;
}

fs::path find_device_descriptor(const std::string& name, const fs::path& folder) {
  if (name.empty())
    throw std::invalid_argument("it is empty; write a file or the name of a descriptor");
  const bool has_end = fs::path(name).extension() == ".toml";
  const fs::path file = has_end ? fs::path(name) : fs::path(name + ".toml");
  std::vector<fs::path> places{fs::absolute(folder / file).lexically_normal()};
  if (!file.has_parent_path())
    for (const fs::path& place : device_folders()) places.push_back(place / file);
  std::string looked;
  for (const fs::path& place : places) {
    std::error_code error;
    if (fs::is_regular_file(place, error)) return place;
    looked += fmt::format("{}{}", looked.empty() ? "" : ", ", place.string());
  }
  throw std::invalid_argument(
      fmt::format("there is no descriptor '{}'; searched {}", name, looked));
}

}  // namespace reckon::peer
