// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Unplugs in real time as a program: falcon, polhem or serial.
#include <fmt/format.h>

#include <CLI/CLI.hpp>

#include "reckon/pdu/seconds.hpp"
#include "reckon/tests/fuzz/search/search_program.hpp"
#include "reckon/tests/fuzz/unplugs/counted_usb.hpp"
#include "reckon/tests/fuzz/unplugs/real_unplugs.hpp"

namespace reckon::fuzz::unplugs {
namespace {

int run(int argc, char** argv) {
  CLI::App app{"Unplugs a device in real time, its thread running, and plugs it in again."};
  std::string device = "falcon";
  unsigned rounds = 1'000, seed = 1;
  app.add_option("device", device)->check(CLI::IsMember({"falcon", "polhem", "serial"}));
  app.add_option("--rounds", rounds, "so many times, 1000 (default)");
  app.add_option("--seed", seed, "of the instants");
  CLI11_PARSE(app, argc, argv);
  RealOutcome outcome =
      device == "serial"
          ? unplug_board(rounds, seed)
          : unplug_usb(device == "polhem" ? DeviceKind::polhem : DeviceKind::falcon, rounds, seed);
  fmt::print(
      "{}: {} of {} rounds held; read for {:.1f} ms at most, in {} rounds for more than 10\n",
      device, outcome.rounds, rounds, 1e3 * pdu::to_seconds(outcome.longest), outcome.late);
  if (!outcome.problem.empty()) fmt::print("reckon fuzz: {}\n", outcome.problem);
  return outcome.problem.empty() ? 0 : 1;
}

}  // namespace
}  // namespace reckon::fuzz::unplugs

int main(int argc, char** argv) {
  return reckon::fuzz::guarded([&] { return reckon::fuzz::unplugs::run(argc, argv); });
}
