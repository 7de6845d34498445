// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/tools/viewer/page_files.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstring>
#include <string>
#include <utility>
#include <vector>

#include "reckon/tools/viewer/page_frame.hpp"

// Made by page_archive.cmake. Each file has its name with a NUL, its compressed and plain sizes of
// eight octets each, and its octets in both forms; an empty name ends the archive.
extern "C" const char reckon_page_archive[];

namespace reckon::tools {
namespace {

constexpr std::string_view kFramePath = "/frame.html";

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
    std::array<std::uint64_t, 2> sizes{};
    std::memcpy(sizes.data(), at, sizeof sizes);
    at += sizeof sizes;
    file.gzip = {at, sizes[0]};
    file.text = {at + sizes[0], sizes[1]};
    at += sizes[0] + sizes[1];
    if (file.path == "/index.html") file.path = "/";
  }
  return files;
}

const PageFile* find_in_archive(std::string_view path) {
  static const std::vector<PageFile> kFiles = read_archive();
  const auto file = std::ranges::find(kFiles, path, &PageFile::path);
  return file == kFiles.end() ? nullptr : &*file;
}

std::string_view text_of(std::string_view name) {
  const PageFile* file =
      find_in_archive(name == "index.html" ? std::string("/") : fmt::format("/{}", name));
  return file == nullptr ? std::string_view() : file->text;
}

// Made at the first request: few users save.
const PageFile* frame_file() {
  static const std::string kFrame = page_frame(text_of);
  static const PageFile kFile{kFramePath, content_type_of(kFramePath), {}, kFrame};
  return &kFile;
}

}  // namespace

const PageFile* find_page_file(std::string_view path) {
  return path == kFramePath ? frame_file() : find_in_archive(path);
}

}  // namespace reckon::tools
