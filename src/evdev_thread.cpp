// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/peer/evdev_thread.hpp"

#include <utility>

namespace reckon::peer {

EvdevThread::EvdevThread(const Clock& clock, const haptics::EvdevSettings& settings,
                         std::unique_ptr<haptics::EventCalls> calls)
    : device_(exchange_, haptics::evdev_limits(settings)),
      loop_(exchange_, settings, std::move(calls), [&clock] { return clock.now(); }),
      thread_(clock, "rk-evdev", [this] { loop_.step(DeviceThread::kLongestWait); }) {}

}  // namespace reckon::peer
