// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// TLS 1.2 and 1.3 of the viewer's server, by OpenSSL.
#pragma once

#include <asio/ssl/context.hpp>
#include <optional>
#include <string>
#include <vector>

#include "reckon/tools/viewer/web/tls_files.hpp"

namespace reckon::tools {

/// @throws as check_tls
[[nodiscard]] asio::ssl::context open_tls(const TlsFiles& files);

/// The same; none if the files are empty.
[[nodiscard]] std::optional<asio::ssl::context> open_tls_if_any(const TlsFiles& files);

/// Host names of its certificate, except names with a `*`.
[[nodiscard]] std::vector<std::string> certified_names(asio::ssl::context& context);

}  // namespace reckon::tools
