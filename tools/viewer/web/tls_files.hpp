// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Certificate and key of a page served over TLS.
#pragma once

#include <string>

namespace reckon::tools {

/// Both in PEM, or both empty: no TLS.
struct TlsFiles {
  std::string certificate;  ///< followed by its intermediate certificates
  std::string key;          ///< without a pass phrase, in a file that only its owner may read
};

/// Reads both as a server would. @throws std::runtime_error with the file, the fault and the
/// remedy: unreadable, no PEM, key does not match, out of date, key readable by others
void check_tls(const TlsFiles& files);

}  // namespace reckon::tools
