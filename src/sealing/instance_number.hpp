// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// How a process learns that it has become another: by a fork, or as a copy of its machine.
#pragma once

#include <cstdint>

namespace reckon::peer {

/// A number that is another when the process is.
using InstanceNumber = std::uint64_t (*)() noexcept;

/// Of the process number, /proc/sys/kernel/random/boot_id, and how often the kernel has reported
/// that the machine is a copy (uevent NEW_VMGENID, which few kernels send), heard from the first
/// call on. Any thread; 10 us; the first call opens a socket.
[[nodiscard]] std::uint64_t system_instance() noexcept;

}  // namespace reckon::peer
