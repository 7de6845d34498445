// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The fate of each datagram of a running peer, as JSON lines.
#pragma once

#include <string>

#include "reckon/peer/network/datagram_balance.hpp"

namespace reckon::tools {

/// One line, with its line end; docs/json_lines.md lists its keys.
/// @param seconds since the peer started  @param end whether this is the report at the end of the
/// run
[[nodiscard]] std::string balance_line(const peer::BalanceReport& report, double seconds, bool end);

}  // namespace reckon::tools
