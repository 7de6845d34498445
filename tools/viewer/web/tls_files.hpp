// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The files by which a page is served over TLS.
#pragma once

#include <string>

namespace reckon::tools {

/// Both in PEM, or both empty: no TLS.
struct TlsFiles {
  std::string certificate;  ///< with those that vouch for it behind it
  std::string key;          ///< without a pass phrase, of a file that its owner alone may read
};

/// Reads both as a server would. @throws std::runtime_error with the file, the fault and the
/// remedy: unreadable, no PEM, of different keys, out of date, a key that others may read
void check_tls(const TlsFiles& files);

}  // namespace reckon::tools
