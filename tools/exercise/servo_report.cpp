// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/tools/exercise/servo_report.hpp"

#include "reckon/peer/threads/servo_thread.hpp"

namespace reckon::tools {

std::string servo_text(const peer::PeerThreads& threads) {
  if (threads.servo() == nullptr) return "none: no device";
  return threads.servo()->describe() + (threads.memory_locked() ? "; memory locked" : "");
}

void ServoReport::add(const peer::PeerThreads& threads) {
  const peer::DutyCycle& duty = threads.servo_duty();
  lateness = worst(lateness, peer::percentiles(duty.lateness()));
  loops.add(loops_of(threads));
  steps += duty.steps();
  missed += duty.missed();
  thread = servo_text(threads);
}

}  // namespace reckon::tools
