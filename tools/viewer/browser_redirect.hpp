// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// How --open starts the browser: by a private file that leads to the page, so that no argument of a
// process has the page's word, which any user of the host could read there.
#pragma once

#include <filesystem>
#include <string>

namespace reckon::tools {

/// The file exists as long as this.
class BrowserRedirect {
 public:
  /// Writes it, mode 0600 in a folder of mode 0700 below $XDG_RUNTIME_DIR, else below the folder
  /// for temporary files. Then starts xdg-open with it; nothing starts where there is none.
  /// @throws std::system_error where it cannot be written
  explicit BrowserRedirect(const std::string& address);
  ~BrowserRedirect();
  BrowserRedirect(const BrowserRedirect&) = delete;
  BrowserRedirect& operator=(const BrowserRedirect&) = delete;

 private:
  std::filesystem::path folder_;
};

}  // namespace reckon::tools
