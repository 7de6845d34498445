// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// HTTP answers of the viewer's server, each with the security policy against pages of other sites.
#pragma once

#include <string>
#include <string_view>

namespace reckon::tools {

/// A file of the page. @param encoding of its octets: "gzip"; empty: plain
[[nodiscard]] std::string file_answer(std::string_view content_type, std::string_view encoding,
                                      std::string_view octets);
/// A refusal with a sentence. @param status such as 403  @param reason HTTP reason phrase
[[nodiscard]] std::string refusal_answer(int status, std::string_view reason,
                                         std::string_view sentence);
/// The server's part of a WebSocket handshake with this key. @param extensions agreed; empty: none
[[nodiscard]] std::string upgrade_answer(std::string_view key, std::string_view extensions);

}  // namespace reckon::tools
