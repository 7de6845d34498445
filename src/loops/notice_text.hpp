// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Makes notices by format. Private, so that no other header includes fmt.
#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <string_view>

#include "reckon/peer/loops/notice.hpp"

namespace reckon::peer {

/// The sentence, cut if it is too long. Names and markings of others may hold any octets, and
/// sentences go to terminals: any other character than printable ASCII is shown as '?'. No
/// allocation.
template <typename... Arguments>
[[nodiscard]] Notice make_notice(std::string_view format, const Arguments&... arguments) noexcept {
  Notice notice;
  const auto written = fmt::format_to_n(notice.text.data(), notice.text.size() - 1,
                                        fmt::runtime(format), arguments...);
  std::replace_if(
      notice.text.data(), written.out, [](char letter) { return letter < ' ' || letter > '~'; },
      '?');
  *written.out = '\0';
  return notice;
}

}  // namespace reckon::peer
