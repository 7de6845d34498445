// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/tools/command_line/file_kind.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <filesystem>
#include <fstream>
#include <string_view>
#include <system_error>

namespace reckon::tools {
namespace {

using namespace std::string_view_literals;

// pcap in both byte orders and with both time resolutions, pcapng, and their compressed forms.
constexpr std::array kCaptureHeads{
    "\xd4\xc3\xb2\xa1"sv, "\xa1\xb2\xc3\xd4"sv,         "\x4d\x3c\xb2\xa1"sv,
    "\xa1\xb2\x3c\x4d"sv, "\x0a\x0d\x0d\x0a"sv,         "\x28\xb5\x2f\xfd"sv,
    "\x1f\x8b"sv,         "\xfd\x37\x7a\x58\x5a\x00"sv, "BZh"sv,
    "\x04\x22\x4d\x18"sv};
constexpr std::size_t kLongestHead = 6;

struct Ending {
  std::string_view text;
  FileKind kind;
};
constexpr std::array kEndings{
    Ending{".pcap", FileKind::capture}, Ending{".pcapng", FileKind::capture},
    Ending{".cap", FileKind::capture},  Ending{".toml", FileKind::scene},
    Ending{".obj", FileKind::mesh},     Ending{".ply", FileKind::mesh},
    Ending{".stl", FileKind::mesh},     Ending{".off", FileKind::mesh},
    Ending{".key", FileKind::key},      Ending{".csv", FileKind::table}};

/// A pipe or a device has none: a read of it can wait for ever, and takes the octets away.
std::string head_of(const std::string& path) {
  std::error_code error;
  if (!std::filesystem::is_regular_file(path, error)) return {};
  std::string octets(kLongestHead, '\0');
  std::ifstream file(path, std::ios::binary);
  file.read(octets.data(), static_cast<std::streamsize>(octets.size()));
  octets.resize(static_cast<std::size_t>(file.gcount()));
  return octets;
}

}  // namespace

FileKind kind_of_file(const std::string& path) {
  std::error_code error;
  if (!std::filesystem::exists(path, error)) return FileKind::unknown;
  const std::string head = head_of(path);
  if (std::ranges::any_of(kCaptureHeads, [&](auto known) { return head.starts_with(known); }))
    return FileKind::capture;
  std::string name = path;
  std::ranges::transform(name, name.begin(), [](unsigned char letter) {
    return static_cast<char>(std::tolower(letter));
  });
  const auto found = std::ranges::find_if(
      kEndings, [&](const Ending& ending) { return name.ends_with(ending.text); });
  return found == kEndings.end() ? FileKind::unknown : found->kind;
}

std::string no_scene_remedy(const std::string& path) {
  switch (kind_of_file(path)) {
    case FileKind::capture:
      return "this is a capture: reckon inspect " + path;
    case FileKind::mesh:
      return "this is a mesh: reckon demo --mesh " + path;
    default:
      return {};
  }
}

}  // namespace reckon::tools
