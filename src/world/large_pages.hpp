// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Large pages for tables that outgrow what a processor keeps addresses of.
#pragma once

#include <cstddef>

namespace reckon::peer {

/// Asks the system for pages of 2 MiB behind the first kSmallTable octets of reserved memory: a
/// small table takes no more memory than it uses, and in a large one an access to a row that has
/// not been used for long costs one miss less. Nothing happens where the system has none, or where
/// the memory is shorter. Allocates nothing; `octets` from `begin` on are the caller's.
void advise_large_pages(const void* begin, std::size_t octets) noexcept;
inline constexpr std::size_t kSmallTable = std::size_t{4} << 20;

}  // namespace reckon::peer
