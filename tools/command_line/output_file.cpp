// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/tools/command_line/output_file.hpp"

#include <fmt/format.h>

#include <filesystem>
#include <fstream>
#include <system_error>

namespace reckon::tools {

void check_writable(const std::string& path) {
  if (path.empty()) return;
  std::error_code ignored;
  const bool is_new = !std::filesystem::exists(std::filesystem::symlink_status(path, ignored));
  if (!std::ofstream(path, std::ios::app))
    throw UsageError(fmt::format("{}: cannot be written; name a file in a writable folder", path));
  if (is_new) std::filesystem::remove(path, ignored);
}

void save_output(const std::string& path, const std::string& text) {
  std::ofstream file(path, std::ios::binary | std::ios::trunc);
  file << text;
  file.close();
  if (!file)
    throw UsageError(fmt::format("{}: could not be written completely; is the disk full?", path));
}

void write_output(const std::string& path, const std::string& text, const Console& console) {
  if (path.empty()) return;
  save_output(path, text);
  fmt::print(console.err, "wrote {}\n", path);
}

}  // namespace reckon::tools
