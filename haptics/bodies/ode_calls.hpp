// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// What ODE asks of its host while it steps, without allocation: memory and calls.
#pragma once

#define dDOUBLE
#include <ode/ode.h>

namespace reckon::haptics {

/// Makes `world` step in the caller's thread and in memory that is kept from step to step. ODE's
/// own ways allocate 12 to 90 times a step, and not through the hook that it has for that. One
/// thread steps worlds at a time (each thread has its own calls and memory).
void keep_within_thread(dWorldID world);

}  // namespace reckon::haptics
