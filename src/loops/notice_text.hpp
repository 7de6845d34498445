// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Notices made by format. Private: nothing that others include sees fmt.
#pragma once

#include <fmt/format.h>

#include <string_view>

#include "reckon/peer/loops/notice.hpp"

namespace reckon::peer {

/// The sentence, cut where it is too long. No allocation.
template <typename... Arguments>
[[nodiscard]] Notice make_notice(std::string_view format, const Arguments&... arguments) noexcept {
  Notice notice;
  const auto written = fmt::format_to_n(notice.text.data(), notice.text.size() - 1,
                                        fmt::runtime(format), arguments...);
  *written.out = '\0';
  return notice;
}

}  // namespace reckon::peer
