// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The answers of the viewer's server, each with the policy that keeps pages of others out.
#pragma once

#include <string>
#include <string_view>

namespace reckon::tools {

/// A file of the page. @param encoding of its octets: "gzip"; empty where they are plain
[[nodiscard]] std::string file_answer(std::string_view content_type, std::string_view encoding,
                                      std::string_view octets);
/// A refusal with a sentence. @param status 403 and its like  @param reason as HTTP names it
[[nodiscard]] std::string refusal_answer(int status, std::string_view reason,
                                         std::string_view sentence);
/// The end of the handshake of a WebSocket with this key.
[[nodiscard]] std::string upgrade_answer(std::string_view key);

}  // namespace reckon::tools
