// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/tools/exercise/csv_output.hpp"

#include <fmt/format.h>

#include <cerrno>
#include <cstring>

#include "reckon/tools/command_line/console.hpp"

namespace reckon::tools {

CsvOutput::CsvOutput(const std::filesystem::path& file, std::string_view header)
    : name_(file.string()), file_(std::fopen(name_.c_str(), "w"), &std::fclose) {
  if (!file_) {
    throw UsageError(fmt::format("{}: {}; name a writable file", name_, std::strerror(errno)));
  }
  write(header);
  write("\n");
}

void CsvOutput::write(std::string_view line) {
  std::fwrite(line.data(), 1, line.size(), file_.get());
}

void CsvOutput::close() {
  if (!file_) return;
  const bool good = std::fflush(file_.get()) == 0 && std::ferror(file_.get()) == 0;
  const int error = errno;
  file_.reset();
  if (!good) throw EnvironmentError(fmt::format("{}: {}", name_, std::strerror(error)));
}

}  // namespace reckon::tools
