// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/tools/viewer/web/http_request.hpp"

#include <algorithm>
#include <array>

namespace reckon::tools {
namespace {

constexpr std::string_view kLineEnd = "\r\n";

char lower(char letter) noexcept {
  return letter >= 'A' && letter <= 'Z' ? static_cast<char>(letter - 'A' + 'a') : letter;
}

bool same_word(std::string_view a, std::string_view b) noexcept {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                    [](char x, char y) { return lower(x) == lower(y); });
}

std::string_view without_blanks(std::string_view text) noexcept {
  const auto is_blank = [](char letter) { return letter == ' ' || letter == '\t'; };
  while (!text.empty() && is_blank(text.front())) text.remove_prefix(1);
  while (!text.empty() && is_blank(text.back())) text.remove_suffix(1);
  return text;
}

bool is_graphic(std::string_view text) noexcept {
  return std::all_of(text.begin(), text.end(),
                     [](char letter) { return letter > ' ' && letter < '\x7F'; });
}

/// Removes the text before `end` from the front, and `end` too. @return that text
std::string_view cut_front(std::string_view& text, std::string_view end) noexcept {
  const std::size_t at = std::min(text.find(end), text.size());
  const std::string_view front = text.substr(0, at);
  text.remove_prefix(std::min(at + end.size(), text.size()));
  return front;
}

bool read_request_line(std::string_view line, HttpRequest& out) noexcept {
  out.method = cut_front(line, " ");
  out.query = cut_front(line, " ");
  out.path = cut_front(out.query, "?");
  return !out.method.empty() && is_graphic(out.method) && out.path.starts_with('/') &&
         is_graphic(out.path) && is_graphic(out.query) && line == "HTTP/1.1";
}

struct NamedField {
  std::string_view name;
  std::string_view HttpRequest::*value;
};
constexpr std::array<NamedField, 7> kFields{
    {{"host", &HttpRequest::host},
     {"origin", &HttpRequest::origin},
     {"upgrade", &HttpRequest::upgrade},
     {"connection", &HttpRequest::connection},
     {"sec-websocket-key", &HttpRequest::key},
     {"sec-websocket-version", &HttpRequest::version},
     {"sec-websocket-extensions", &HttpRequest::extensions}}};

/// @return false for a line that is no field, and for a repeated field that we use
bool read_field(std::string_view line, HttpRequest& out,
                std::array<bool, kFields.size()>& seen) noexcept {
  const std::size_t colon = line.find(':');
  if (colon == 0 || colon == std::string_view::npos || !is_graphic(line.substr(0, colon)))
    return false;
  for (std::size_t i = 0; i < kFields.size(); ++i) {
    if (!same_word(line.substr(0, colon), kFields[i].name)) continue;
    if (seen[i]) return false;
    seen[i] = true;
    out.*kFields[i].value = without_blanks(line.substr(colon + 1));
  }
  return true;
}

}  // namespace

RequestVerdict read_request(std::string_view octets, HttpRequest& out) noexcept {
  out = {};
  const std::size_t end = octets.substr(0, kLongestHead).find("\r\n\r\n");
  if (end == std::string_view::npos)
    return octets.size() >= kLongestHead ? RequestVerdict::too_long : RequestVerdict::incomplete;
  std::string_view head = octets.substr(0, end);
  out.length = end + 4;
  if (!read_request_line(cut_front(head, kLineEnd), out)) return RequestVerdict::bad;
  std::array<bool, kFields.size()> seen{};
  while (!head.empty())
    if (!read_field(cut_front(head, kLineEnd), out, seen)) return RequestVerdict::bad;
  return RequestVerdict::good;
}

std::string_view cut_trimmed(std::string_view& text, std::string_view end) noexcept {
  return without_blanks(cut_front(text, end));
}

bool lists_word(std::string_view list, std::string_view word) noexcept {
  while (!list.empty())
    if (same_word(cut_trimmed(list, ","), word)) return true;
  return false;
}

std::string_view value_in_query(std::string_view query, std::string_view name) noexcept {
  while (!query.empty()) {
    std::string_view value = cut_front(query, "&");
    if (cut_front(value, "=") == name) return value;
  }
  return {};
}

}  // namespace reckon::tools
