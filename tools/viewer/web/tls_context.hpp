// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// TLS 1.2 and 1.3 by OpenSSL, as the viewer's server offers it.
#pragma once

#include <asio/ssl/context.hpp>
#include <string>
#include <vector>

#include "reckon/tools/viewer/web/tls_files.hpp"

namespace reckon::tools {

/// @throws as check_tls
[[nodiscard]] asio::ssl::context open_tls(const TlsFiles& files);

/// Host names that its certificate is for, without those that have a `*`.
[[nodiscard]] std::vector<std::string> certified_names(asio::ssl::context& context);

}  // namespace reckon::tools
