// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// A project whose files have names that files and folders of Reckon have or had, with its own
// folder first on the include path. Each include must find its own file.
#include <cstdio>

#include "haptics/scene.hpp"
#include "pdu/records.hpp"
#include "reckon/haptics/scene/scene.hpp"
#include "reckon/pdu/codec/records.hpp"
#include "reckon/peer/clocks/clock.hpp"
#include "reckon/peer/peer.hpp"
#include "src/clock.hpp"

int main() {
  const reckon::pdu::EntityId id{1, 2, 3};
  const reckon::haptics::Scene scene;
  reckon::peer::ManualClock clock(std::chrono::seconds(1), std::chrono::seconds(0));
  clock.advance(std::chrono::milliseconds(theirs::kTicks));
  const int sum = theirs::kTicks + theirs::Record().value + theirs::Scene().objects + id.entity +
                  static_cast<int>(scene.objects.size());
  std::printf("sum %d\n", sum);
  return sum == 15 ? 0 : 1;
}
