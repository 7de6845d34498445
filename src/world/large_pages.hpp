// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The pages behind tables: large ones for those that outgrow what a processor keeps addresses of,
// none for what is no longer used.
#pragma once

#include <cstddef>

namespace reckon::peer {

/// Asks the system for pages of 2 MiB behind the first kSmallTable octets of reserved memory: a
/// small table takes no more memory than it uses, and in a large one an access to a row that has
/// not been used for long costs one miss less. Nothing happens where the system has none, or where
/// the memory is shorter. Allocates nothing; `octets` from `begin` on are the caller's.
void advise_large_pages(const void* begin, std::size_t octets) noexcept;
inline constexpr std::size_t kSmallTable = std::size_t{4} << 20;

/// Gives the whole pages of this memory back to the system; it stays the caller's and reads as
/// whatever it was, or as zeros. Where the system refuses nothing happens. Some 0.1 ms a MiB.
void give_back_pages(const void* begin, std::size_t octets) noexcept;
/// Less than this is not worth a system call [octets].
inline constexpr std::size_t kWorthGivingBack = std::size_t{1} << 20;

}  // namespace reckon::peer
