// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Starts the browser for --open with a private file that redirects to the page. The page's access
// word is then in no process argument, which any user of the host could read.
#pragma once

#include <filesystem>
#include <string>

namespace reckon::tools {

/// The file exists as long as this object.
class BrowserRedirect {
 public:
  /// Writes the file, mode 0600 in a folder of mode 0700 below $XDG_RUNTIME_DIR, else below the
  /// folder for temporary files. Then starts xdg-open with it, if xdg-open exists.
  /// @throws std::system_error if the file cannot be written
  explicit BrowserRedirect(const std::string& address);
  ~BrowserRedirect();
  BrowserRedirect(const BrowserRedirect&) = delete;
  BrowserRedirect& operator=(const BrowserRedirect&) = delete;

 private:
  std::filesystem::path folder_;
};

}  // namespace reckon::tools
