// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/tools/viewer/page_files.hpp"

#include <array>
#include <cstdint>
#include <cstring>
#include <string>
#include <utility>
#include <vector>

// Made by CMakeLists.txt: for each file its name with a NUL, eight octets with its size, and its
// octets; then an empty name.
extern "C" const char reckon_page_archive[];

namespace reckon::tools {
namespace {

std::string_view content_type_of(std::string_view path) {
  constexpr std::array<std::pair<std::string_view, std::string_view>, 3> kTypes{
      {{".html", "text/html; charset=utf-8"},
       {".css", "text/css; charset=utf-8"},
       {".js", "text/javascript; charset=utf-8"}}};
  for (const auto& [end, type] : kTypes)
    if (path.ends_with(end)) return type;
  return "application/octet-stream";
}

std::vector<PageFile> read_archive() {
  std::vector<PageFile> files;
  const char* at = reckon_page_archive;
  while (*at != '\0') {
    PageFile& file = files.emplace_back();
    file.path = at;
    file.content_type = content_type_of(file.path);
    at += file.path.size() + 1;
    std::uint64_t size = 0;
    std::memcpy(&size, at, sizeof size);
    file.gzip = {at + sizeof size, size};
    at += sizeof size + size;
    if (file.path == "/index.html") file.path = "/";
  }
  return files;
}

}  // namespace

const PageFile* find_page_file(std::string_view path) {
  static const std::vector<PageFile> kFiles = read_archive();
  for (const PageFile& file : kFiles)
    if (file.path == path) return &file;
  return nullptr;
}

}  // namespace reckon::tools
