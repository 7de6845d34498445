// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// truck [INTERFACE [SECONDS]]: on plain DIS, exercise 1, group 239.192.1.0, port 3000.
#include "truck.hpp"

#include <chrono>
#include <cstdlib>
#include <thread>

int main(int argc, char** argv) {
  using namespace std::chrono;
  std::setvbuf(stdout, nullptr, _IOLBF, 0);
  reckon::peer::FederateOptions options;
  options.name = "TRUCK";
  options.scene = reckon::peer::dis_exercise(1, kLatitude, kLongitude);
  options.interface = argc > 1 ? argv[1] : "lo";
  reckon::peer::Federate federate(options);
  const auto end = steady_clock::now() + seconds(argc > 2 ? std::atoi(argv[2]) : 10);
  drive(federate, [&] {
    std::this_thread::sleep_for(milliseconds(10));
    return steady_clock::now() < end;
  });
}
