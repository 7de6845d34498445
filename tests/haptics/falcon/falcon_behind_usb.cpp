// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// A Falcon on the USB of this kernel and the hand that holds it, as root, on a machine with
// vhci_hcd:
//
//     falcon_behind_usb [FIRMWARE]      without its firmware, if a file is named
//
// It reads a command a line: plug, unplug, home, hand X Y Z [mm], leave (nobody holds it), say.
#include <Eigen/Core>
#include <cstdio>
#include <exception>
#include <fstream>
#include <iostream>
#include <iterator>
#include <sstream>
#include <string>

#include "reckon/tests/haptics/support/usbip_falcon.hpp"

namespace {

using reckon::test::FalconModel;

void obey(reckon::test::UsbipFalcon& falcon, const std::string& line) {
  std::istringstream words(line);
  std::string verb;
  words >> verb;
  Eigen::Vector3d goal;
  if (verb == "plug") {
    falcon.plug_in();
  } else if (verb == "unplug") {
    falcon.unplug();
  } else if (verb == "home") {
    falcon.with([](FalconModel& one) { one.home(); });
  } else if (verb == "leave") {
    falcon.with([](FalconModel& one) { one.leave(); });
  } else if (verb == "hand" && words >> goal.x() >> goal.y() >> goal.z()) {
    falcon.go(1e-3 * goal);
  } else if (verb != "say") {
    std::printf("what is '%s'?\n", line.c_str());
  }
  falcon.with([](FalconModel& one) {
    const Eigen::Vector3d place = 1e3 * one.position(), force = one.force();
    std::printf("at %.1f %.1f %.1f mm, %.2f %.2f %.2f N; the hand put in %.6f J\n", place.x(),
                place.y(), place.z(), force.x(), force.y(), force.z(),
                one.port_work() + one.damping_loss());
  });
}

}  // namespace

int main(int count, char** words) try {
  reckon::test::FalconModelOptions options;
  if (count > 1) {
    std::ifstream in(words[1], std::ios::binary);
    options.firmware.assign(std::istreambuf_iterator<char>(in), {});
    options.has_firmware = options.homed = false;
  }
  reckon::test::UsbipFalcon falcon(options, Eigen::Vector3d(0, 0, 0));
  std::setvbuf(stdout, nullptr, _IOLBF, 0);
  for (std::string line; std::getline(std::cin, line);) obey(falcon, line);
  return 0;
} catch (const std::exception& error) {
  std::fprintf(stderr, "falcon_behind_usb: %s\n", error.what());
  return 1;
}
