// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/tools/viewer/web/http_answer.hpp"

#include <fmt/format.h>

#include "reckon/tools/viewer/web/web_socket.hpp"

namespace reckon::tools {
namespace {

constexpr std::string_view kPolicy =
    "Content-Security-Policy: default-src 'none'; script-src 'self'; style-src 'self'; "
    "connect-src 'self'; img-src data:; frame-ancestors 'none'; base-uri 'none'; "
    "form-action 'none'\r\n"
    "X-Content-Type-Options: nosniff\r\n"
    "Referrer-Policy: no-referrer\r\n"
    "Cross-Origin-Resource-Policy: same-origin\r\n"
    "Cache-Control: no-store\r\n"
    "Connection: close\r\n";

}  // namespace

std::string file_answer(std::string_view content_type, std::string_view encoding,
                        std::string_view octets) {
  std::string head = fmt::format("HTTP/1.1 200 OK\r\nContent-Type: {}\r\n", content_type);
  if (!encoding.empty()) head += fmt::format("Content-Encoding: {}\r\n", encoding);
  return head.append(kPolicy)
      .append(fmt::format("Content-Length: {}\r\n\r\n", octets.size()))
      .append(octets);
}

std::string refusal_answer(int status, std::string_view reason, std::string_view sentence) {
  return fmt::format(
      "HTTP/1.1 {} {}\r\nContent-Type: text/plain; charset=utf-8\r\n{}Content-Length: "
      "{}\r\n\r\n{}\n",
      status, reason, kPolicy, sentence.size() + 1, sentence);
}

std::string upgrade_answer(std::string_view key, std::string_view extensions) {
  std::string agreed;
  if (!extensions.empty()) agreed = fmt::format("Sec-WebSocket-Extensions: {}\r\n", extensions);
  return fmt::format(
      "HTTP/1.1 101 Switching Protocols\r\nUpgrade: websocket\r\nConnection: "
      "Upgrade\r\nSec-WebSocket-Accept: {}\r\n{}\r\n",
      web_socket_accept(key), agreed);
}

}  // namespace reckon::tools
