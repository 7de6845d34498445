// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/peer/loops/touch_stage.hpp"

#include <gmock/gmock.h>

#include <string>
#include <vector>

namespace reckon::peer {
namespace {

using testing::ElementsAre;

std::vector<std::string> softened(const DeviceStiffness& device) {
  haptics::SpscRing<Notice> notices{16};
  report_softened("HAND1", device, notices);
  std::vector<std::string> texts;
  for (; notices.front() != nullptr; notices.pop())
    texts.emplace_back(notices.front()->text.data());
  return texts;
}

TEST(TouchStage, ReportsWallsAndRegionsThatAreSoftened) {
  DeviceStiffness device;
  device.walls_asked = 800;
  device.regions_asked = 150;
  EXPECT_THAT(softened(device), ElementsAre());
  device.walls = 300;
  device.regions = 100;
  EXPECT_THAT(
      softened(device),
      ElementsAre("hand 'HAND1' feels walls at 300 N/m instead of 800: the limit of its device",
                  "hand 'HAND1' feels regions at 100 N/m instead of 150: the limit of its device"));
}

}  // namespace
}  // namespace reckon::peer
