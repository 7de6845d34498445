// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Detects that a process has become another one: by a fork, or as a copy of its machine.
#pragma once

#include <cstdint>

namespace reckon::peer {

/// A number that changes when the process becomes another.
using InstanceNumber = std::uint64_t (*)() noexcept;

/// Made of the process number, /proc/sys/kernel/random/boot_id, and the number of the kernel's
/// reports since the first call that the machine is a copy (uevent NEW_VMGENID, which few kernels
/// send). Any thread; 10 us; the first call opens a socket.
[[nodiscard]] std::uint64_t system_instance() noexcept;

}  // namespace reckon::peer
