// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/tools/viewer/browser_redirect.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <spawn.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <system_error>

namespace reckon::tools {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void fail(const fs::path& place) {
  throw std::system_error(errno, std::generic_category(),
                          fmt::format("--open: cannot write a file for the browser in {}; remove "
                                      "--open, and open the printed address",
                                      place.string()));
}

/// Makes a folder that only this user may enter.
fs::path make_folder() {
  const char* const own = std::getenv("XDG_RUNTIME_DIR");
  std::error_code none;
  const fs::path place =
      own != nullptr && fs::is_directory(own, none) ? fs::path(own) : fs::temp_directory_path(none);
  std::string name = (place / "reckon-XXXXXX").string();
  if (mkdtemp(name.data()) == nullptr) fail(place);
  return name;
}

void start_browser(const fs::path& file) {
  std::string program = "xdg-open", argument = file.string();
  char* const arguments[] = {program.data(), argument.data(), nullptr};
  pid_t child = 0;
  (void)posix_spawnp(&child, program.c_str(), nullptr, nullptr, arguments, environ);
}

}  // namespace

BrowserRedirect::BrowserRedirect(const std::string& address) : folder_(make_folder()) {
  const std::string page = fmt::format(
      "<!doctype html><meta charset=\"utf-8\"><meta http-equiv=\"refresh\" content=\"0; url={}\">"
      "<title>Reckon</title>\n",
      address);
  const fs::path file = folder_ / "page.html";
  const int number = ::open(file.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0600);
  const bool is_whole =
      number >= 0 && ::write(number, page.data(), page.size()) == static_cast<ssize_t>(page.size());
  if (number < 0 || ::close(number) != 0 || !is_whole) fail(folder_);
  start_browser(file);
}

BrowserRedirect::~BrowserRedirect() {
  std::error_code ignored;
  fs::remove_all(folder_, ignored);
}

}  // namespace reckon::tools
