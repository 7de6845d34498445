// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The pages behind tables: large ones for tables that outgrow the processor's TLB, and none for
// unused memory.
#pragma once

#include <cstddef>

namespace reckon::peer {

/// Requests pages of 2 MiB for all but the first kSmallTable octets of reserved memory. A small
/// table then takes only the memory that it uses. In a large one, access to a row after a long time
/// costs one miss less. Does nothing if the system has no such pages or the memory is shorter.
/// Allocates nothing; the caller owns the `octets` from `begin` on.
void advise_large_pages(const void* begin, std::size_t octets) noexcept;
inline constexpr std::size_t kSmallTable = std::size_t{4} << 20;

/// Returns the whole pages of this memory to the system. The caller keeps the address range, and
/// its content is unchanged or zero. Does nothing if the system refuses. Some 0.1 ms a MiB.
void give_back_pages(const void* begin, std::size_t octets) noexcept;
/// Least size that is worth a system call [octets].
inline constexpr std::size_t kWorthGivingBack = std::size_t{1} << 20;

}  // namespace reckon::peer
