// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Reads output files of the program: tables and pages.
#pragma once

#include <fstream>
#include <sstream>
#include <string>
#include <vector>

namespace reckon::test {

/// All of a file.
inline std::string content(const std::string& path) {
  std::ifstream file(path);
  std::stringstream text;
  text << file.rdbuf();
  return text.str();
}

/// Lines without their ends.
inline std::vector<std::string> lines_of(const std::string& text) {
  std::istringstream stream(text);
  std::vector<std::string> lines;
  for (std::string line; std::getline(stream, line);) lines.push_back(line);
  return lines;
}

/// Cells of a CSV line; commas within quotes do not separate.
inline std::vector<std::string> cells_of(const std::string& line) {
  std::vector<std::string> cells(1);
  bool quoted = false;
  for (const char letter : line) {
    if (letter == '"')
      quoted = !quoted;
    else if (letter == ',' && !quoted)
      cells.emplace_back();
    else
      cells.back() += letter;
  }
  return cells;
}

/// Names of elements that are opened and never closed, or closed and never opened; style and script
/// are skipped.
inline std::string unbalanced(const std::string& page) {
  std::vector<std::string> open;
  for (std::size_t at = 0; (at = page.find('<', at)) != std::string::npos;) {
    const std::size_t end = page.find('>', at);
    if (end == std::string::npos) return "a tag without an end";
    std::string tag = page.substr(at + 1, end - at - 1);
    at = end + 1;
    const bool closes = tag.starts_with('/'), alone = tag.ends_with('/');
    if (closes) tag.erase(0, 1);
    const std::string name = tag.substr(0, tag.find_first_of(" />\n"));
    if (alone || name == "!DOCTYPE" || name == "meta") continue;
    if (!closes) {
      open.push_back(name);
      if (name == "style" || name == "script") at = page.find("</" + name, at);
    } else if (open.empty() || open.back() != name) {
      return "</" + name + "> within <" + (open.empty() ? "" : open.back()) + ">";
    } else {
      open.pop_back();
    }
  }
  return open.empty() ? "" : "<" + open.back() + "> stays open";
}

}  // namespace reckon::test
