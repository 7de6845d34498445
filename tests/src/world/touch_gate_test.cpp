// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/peer/world/touch_gate.hpp"

#include <gtest/gtest.h>

namespace reckon::peer {
namespace {

aoim::SourceAddress source_at(std::uint8_t host, std::uint16_t port) {
  aoim::SourceAddress from;
  from.octets[15] = host;
  from.port = port;
  return from;
}

TouchGate named() { return TouchGate(TouchRule::parse("1:2, 40:1").value()); }

TEST(TouchGate, BindsAGuestsNameToItsFirstAddress) {
  TouchGate gate = named();
  EXPECT_TRUE(gate.admits({40, 1}, false, source_at(7, 3000)));
  EXPECT_FALSE(gate.admits({40, 1}, false, source_at(8, 3000)));
  EXPECT_TRUE(gate.admits({40, 1}, false, source_at(7, 4000))) << "a restart with another port";
  EXPECT_TRUE(gate.admits({1, 2}, false, source_at(8, 3000))) << "another name is unused";
  EXPECT_FALSE(gate.admits({9, 9}, false, source_at(7, 3000)));
}

TEST(TouchGate, LetsAPeerTakeItsName) {
  TouchGate gate = named();
  EXPECT_TRUE(gate.admits({1, 2}, false, source_at(7, 1)));
  EXPECT_TRUE(gate.admits({1, 2}, true, source_at(8, 1)));
  EXPECT_FALSE(gate.admits({1, 2}, false, source_at(7, 1))) << "the guest is at another address";
}

TEST(TouchGate, AdmitsByTheRuleWithoutNames) {
  TouchGate scene(TouchRule::usual(false)), all(TouchRule::usual(true));
  EXPECT_TRUE(scene.admits({1, 2}, true, source_at(7, 1)));
  EXPECT_FALSE(scene.admits({1, 2}, false, source_at(7, 1)));
  EXPECT_TRUE(all.admits({1, 2}, false, source_at(7, 1)));
  EXPECT_TRUE(scene.is_open() && all.is_open());
  EXPECT_FALSE(named().is_open());
}

}  // namespace
}  // namespace reckon::peer
