// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Finds declarations in the headers of a folder that need a row in a list, so that a test can name
// a forgotten one: the compiler never sees a header that no file includes.
#pragma once

#include <filesystem>
#include <fstream>
#include <iterator>
#include <regex>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "reckon/tests/support/places.hpp"

namespace reckon::test {

/// The text of a file of the source tree.
inline std::string source_text(std::string_view path) {
  std::ifstream file(std::filesystem::path(test::source_dir()) / path);
  if (!file) throw std::runtime_error("no source file " + std::string(path));
  return {std::istreambuf_iterator<char>(file), {}};
}

/// Paths in the source tree of all headers in `folder` and below.
inline std::vector<std::string> headers_in(std::string_view folder) {
  const std::filesystem::path root(test::source_dir());
  std::vector<std::string> paths;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(root / folder))
    if (entry.path().extension() == ".hpp")
      paths.push_back(std::filesystem::relative(entry.path(), root).generic_string());
  return paths;
}

/// All matches of the first group of `pattern` in `text`, in order.
inline std::vector<std::string> all_of(const std::string& text, const std::string& pattern) {
  const std::regex expression(pattern);
  std::vector<std::string> found;
  for (std::sregex_iterator at(text.begin(), text.end(), expression), end; at != end; ++at)
    found.push_back((*at)[1]);
  return found;
}

/// Structs of `text` with a member that begins with `member`, a pattern.
inline std::vector<std::string> structs_with(const std::string& text, const std::string& member) {
  return all_of(text, "\\nstruct (\\w+) \\{(?:\\n(?!\\};).*)*?" + member);
}

/// True if `name` is a row of the list that begins with `opening` in the file `path` and ends with
/// ';'.
inline bool is_row(std::string_view path, std::string_view opening, const std::string& name) {
  const std::string text = source_text(path);
  const std::size_t begin = text.find(opening);
  if (begin == std::string::npos)
    throw std::runtime_error("no list " + std::string(opening) + " in " + std::string(path));
  const std::string list = text.substr(begin, text.find(';', begin) - begin);
  return std::regex_search(list, std::regex("\\b" + name + "\\b"));
}

}  // namespace reckon::test
