// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Network impairment in the syntax of a command line.
#pragma once

#include <string_view>

#include "reckon/peer/network/impairment.hpp"

namespace reckon::tools {

/// Reads "delay=200ms jitter=100ms loss=20% burst=5% burst_length=4 reorder=10% duplicate=5%", in
/// any order, shares as 0.2 or 20%, jitter as a time or as a share of the delay. @throws UsageError
/// with the word and the remedy.
[[nodiscard]] peer::ImpairmentLaw parse_impairment(std::string_view text);

}  // namespace reckon::tools
