// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Makes notices by format. Private, so that no other header includes fmt.
#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <string_view>

#include "reckon/peer/loops/notice.hpp"

namespace reckon::peer {

/// A sentence of a kind, truncated if too long. Names and markings of others may contain any
/// octets, and sentences are written to terminals: characters other than printable ASCII become
/// '?'. No allocation.
template <typename... Arguments>
[[nodiscard]] Notice make_notice(NoticeKind kind, std::string_view format,
                                 const Arguments&... arguments) noexcept {
  Notice notice;
  notice.kind = kind;
  notice.severity = facts_of(kind).severity;
  const auto written = fmt::format_to_n(notice.text.data(), notice.text.size() - 1,
                                        fmt::runtime(format), arguments...);
  std::replace_if(
      notice.text.data(), written.out, [](char letter) { return letter < ' ' || letter > '~'; },
      '?');
  *written.out = '\0';
  return notice;
}

/// The same for the end of a condition.
template <typename... Arguments>
[[nodiscard]] Notice make_end(NoticeKind kind, std::string_view format,
                              const Arguments&... arguments) noexcept {
  Notice notice = make_notice(kind, format, arguments...);
  notice.severity = Severity::info;
  return notice;
}

}  // namespace reckon::peer
