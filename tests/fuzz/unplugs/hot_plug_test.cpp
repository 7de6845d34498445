// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Devices that come and go through the kernel's events: umockdev puts them into /sys and sends the
// events, the real libusb finds and opens them by itself, and a model answers its requests.
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <umockdev.h>

#include <cstdlib>
#include <memory>
#include <string>
#include <thread>
#include <vector>

#include "reckon/tests/fuzz/unplugs/counted_usb.hpp"
#include "reckon/tests/fuzz/unplugs/real_unplugs.hpp"

namespace reckon::fuzz::unplugs {
namespace {

constexpr unsigned kRounds = 8;

struct Unref {
  void operator()(UMockdevTestbed* bed) const { g_object_unref(bed); }
};

/// A bus with a root hub and its ports.
class Bus {
 public:
  Bus() : bed_(umockdev_testbed_new()) {
    // A hub with its own number; the rest of its descriptor is not read.
    add(1, "/devices/usb1", {18, 1, 0, 2, 9, 0, 0, 64, 0x6B, 0x1D, 2, 0,    0, 1,
                             0,  0, 0, 1, 9, 2, 9, 0,  0,    1,    0, 0xE0, 0});
  }

  [[nodiscard]] UsbSite site(unsigned number) {
    const std::string path = fmt::format("/devices/usb1/1-{}", number);
    return {fmt::format("/dev/bus/usb/001/{:03}", number),
            [this, number, path](const std::vector<std::uint8_t>& descriptors) {
              add(number, path, descriptors);
              umockdev_testbed_uevent(bed_.get(), ("/sys" + path).c_str(), "add");
            },
            [this, path] {
              umockdev_testbed_uevent(bed_.get(), ("/sys" + path).c_str(), "remove");
              umockdev_testbed_remove_device(bed_.get(), ("/sys" + path).c_str());
            }};
  }

 private:
  void add(unsigned number, const std::string& path, const std::vector<std::uint8_t>& descriptors) {
    std::string octets;
    for (const std::uint8_t octet : descriptors) octets += fmt::format("{:02X}", octet);
    const std::string node = fmt::format("bus/usb/001/{:03}", number);
    const std::string text = fmt::format(
        "P: {0}\nN: {1}={2}\nE: DEVNAME=/dev/{1}\nE: DEVTYPE=usb_device\nE: BUSNUM=001\n"
        "E: DEVNUM={3:03}\nE: SUBSYSTEM=usb\nE: MAJOR=189\nE: MINOR={4}\nA: busnum=1\\n\n"
        "A: devnum={3}\\n\nA: speed=12\\n\nA: bConfigurationValue=1\\n\nH: descriptors={2}\n\n",
        path, node, octets, number, number - 1);
    EXPECT_TRUE(umockdev_testbed_add_from_string(bed_.get(), text.c_str(), nullptr));
  }

  std::unique_ptr<UMockdevTestbed, Unref> bed_;
};

TEST(HotPlug, FindsDevicesThatComeAndGo) {
  if (std::getenv("LD_PRELOAD") == nullptr) GTEST_SKIP() << "runs under umockdev-wrapper alone";
  Bus bus;
  const UsbSite site = bus.site(2);
  const RealOutcome falcon = unplug_usb(DeviceKind::falcon, kRounds, 4, &site);
  EXPECT_EQ(falcon.problem, "");
  EXPECT_EQ(falcon.rounds, kRounds);
  EXPECT_TRUE(is_usb_given_back());
}

// Each is pulled out while the other continues or is pulled out too.
TEST(HotPlug, TwoDevicesDoNotDisturbEachOther) {
  if (std::getenv("LD_PRELOAD") == nullptr) GTEST_SKIP() << "runs under umockdev-wrapper alone";
  Bus bus;
  const UsbSite one = bus.site(2), other = bus.site(3);
  RealOutcome falcon;
  std::thread beside([&] { falcon = unplug_usb(DeviceKind::falcon, kRounds, 5, &one); });
  const RealOutcome polhem = unplug_usb(DeviceKind::polhem, kRounds, 6, &other);
  beside.join();
  EXPECT_EQ(falcon.problem, "");
  EXPECT_EQ(polhem.problem, "");
  EXPECT_EQ(falcon.rounds + polhem.rounds, 2 * kRounds);
  EXPECT_TRUE(is_usb_given_back());
}

}  // namespace
}  // namespace reckon::fuzz::unplugs
