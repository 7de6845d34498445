// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/peer/objects/scene_package.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <set>
#include <stdexcept>

namespace reckon::peer {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kTitle = "reckon scene 1";

/// A reason to refuse a path; empty if it is good.
std::string_view path_problem(std::string_view path) {
  if (path.empty()) return "is empty";
  if (path.size() > kLongestPackagePath) return "is longer than 255 octets";
  const auto is_odd = [](char letter) {
    return static_cast<unsigned char>(letter) < ' ' || letter == '\x7f' || letter == '\\';
  };
  if (std::ranges::any_of(path, is_odd)) return "has a control character or a backslash";
  if (path.front() == '/') return "is absolute";
  for (std::size_t begin = 0; begin <= path.size();) {
    const std::size_t end = std::min(path.find('/', begin), path.size());
    const std::string_view part = path.substr(begin, end - begin);
    if (part == "..") return "leads out of the folder";
    if (part.empty() || part == ".") return "has an empty part or '.'";
    begin = end + 1;
  }
  return {};
}

std::uint64_t parse_size(std::string_view text) {
  std::uint64_t size = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), size);
  if (error != std::errc() || end != text.data() + text.size() || size > kMostObjectOctets)
    throw std::invalid_argument(fmt::format("has no size from 0 to {}", kMostObjectOctets));
  return size;
}

PackageFile parse_line(std::string_view line) {
  const std::size_t first = line.find(' ');
  const std::size_t second = first == line.npos ? line.npos : line.find(' ', first + 1);
  if (second == line.npos) throw std::invalid_argument("is not 'HASH OCTETS PATH'");
  const auto hash = parse_object_hash(line.substr(0, first));
  if (!hash) throw std::invalid_argument("does not begin with a hash of 64 digits 0-9a-f");
  PackageFile file{*hash, parse_size(line.substr(first + 1, second - first - 1)),
                   std::string(line.substr(second + 1))};
  if (const std::string_view problem = path_problem(file.path); !problem.empty())
    throw std::invalid_argument(fmt::format("the path {}", problem));
  return file;
}

void check_names(const std::vector<PackageFile>& files) {
  std::set<std::string> names;
  for (const PackageFile& file : files)
    if (!names.insert(file.path).second)
      throw std::invalid_argument(fmt::format("{} is named twice", file.path));
  for (const std::string& name : names)
    for (fs::path folder = fs::path(name).parent_path(); !folder.empty();
         folder = folder.parent_path())
      if (names.contains(folder.generic_string()))
        throw std::invalid_argument(
            fmt::format("{} is named as a file and as a folder", folder.generic_string()));
}

std::string relative_path(const fs::path& file, const fs::path& folder) {
  if (!is_within(file, folder))
    throw std::runtime_error(
        fmt::format("{} is outside the folder of the scene file", file.string()));
  std::string path = file.lexically_relative(folder).generic_string();
  if (const std::string_view problem = path_problem(path); !problem.empty())
    throw std::runtime_error(fmt::format("{}: the path {}", file.string(), problem));
  return path;
}

}  // namespace

std::vector<PackageFile> parse_manifest(std::string_view text) {
  std::vector<PackageFile> files;
  if (text.size() > kMostManifestOctets)
    throw std::invalid_argument(fmt::format("has more than {} octets", kMostManifestOctets));
  for (std::size_t number = 1; !text.empty(); ++number) {
    const std::size_t end = text.find('\n');
    if (end == text.npos) throw std::invalid_argument(fmt::format("line {} has no end", number));
    const std::string_view line = text.substr(0, end);
    text.remove_prefix(end + 1);
    try {
      if (number == 1 && line != kTitle)
        throw std::invalid_argument(fmt::format("is not '{}'", kTitle));
      if (number > 1) files.push_back(parse_line(line));
      if (files.size() > kMostPackageFiles)
        throw std::invalid_argument(fmt::format("exceeds {} files", kMostPackageFiles));
    } catch (const std::invalid_argument& error) {
      throw std::invalid_argument(fmt::format("line {} {}", number, error.what()));
    }
  }
  if (files.empty()) throw std::invalid_argument("names no file");
  check_names(files);
  return files;
}

std::string manifest_text(const std::vector<PackageFile>& files) {
  std::string text = fmt::format("{}\n", kTitle);
  for (const PackageFile& file : files)
    text += fmt::format("{} {} {}\n", text_of(file.hash), file.size, file.path);
  return text;
}

std::vector<std::shared_ptr<const ObjectSource>> package_of(const SceneFile& scene) {
  if (scene.path.empty()) throw std::runtime_error("the scene was not read from a file");
  if (scene.hash != scene.hash_in_file)
    throw std::runtime_error("an option changed the scene, so it differs from its file");
  const fs::path path = fs::absolute(scene.path).lexically_normal();
  std::vector<fs::path> paths{path};
  for (const fs::path& file : scene.files)
    if (std::ranges::find(paths, file) == paths.end()) paths.push_back(file);
  std::vector<std::shared_ptr<const ObjectSource>> objects(1);
  std::vector<PackageFile> files;
  for (const fs::path& file : paths) {
    std::string name = relative_path(file, path.parent_path());
    objects.push_back(object_of_file(file));
    files.push_back({objects.back()->hash(), objects.back()->layout().size(), std::move(name)});
  }
  std::string text = manifest_text(files);
  (void)parse_manifest(text);  // holds the bounds of the receivers
  objects.front() = object_of(std::move(text));
  return objects;
}

}  // namespace reckon::peer
