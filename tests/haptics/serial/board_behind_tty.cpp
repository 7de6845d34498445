// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// A serial board without a hand, behind a real tty, on the clock of this host:
//
//     board_behind_tty DAMPING AXES        prints the tty's name, and runs until it is ended
#include <Eigen/Core>
#include <chrono>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <thread>

#include "reckon/tests/haptics/support/far_end.hpp"
#include "reckon/tests/haptics/support/serial_board.hpp"

int main(int count, char** words) {
  if (count != 3) {
    std::fprintf(stderr, "board_behind_tty DAMPING AXES\n");
    return 2;
  }
  reckon::test::SerialBoardOptions options;
  options.damping = std::atof(words[1]);
  options.axes = std::atoi(words[2]);
  reckon::test::SerialBoard board(options, [](double) { return Eigen::Vector3d(0, 0, 0); });
  board.let_go();
  const reckon::test::FarEnd far;
  std::printf("%s\n", far.name().c_str());
  std::fflush(stdout);
  const auto begin = std::chrono::steady_clock::now();
  for (;;) {
    while (board.now() < std::chrono::steady_clock::now() - begin)
      for (const auto& frame : board.pass()) far.send(frame);
    for (const std::uint8_t octet : far.fetch()) board.take(octet);
    std::this_thread::sleep_for(std::chrono::microseconds(200));
  }
}
