// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/peer/serial_thread.hpp"

#include <utility>

namespace reckon::peer {

SerialThread::SerialThread(const Clock& clock, const haptics::DeviceLimits& limits,
                           haptics::SerialPlace place)
    : device_(exchange_, limits),
      loop_(exchange_, limits, std::move(place), [&clock] { return clock.now(); }),
      thread_(clock, "rk-serial", [this] { loop_.step(DeviceThread::kLongestWait); }) {}

}  // namespace reckon::peer
