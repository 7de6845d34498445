// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// A scene that no host can run: a mesh of slivers that all meet at the hand, at 10 kHz.
#include <gmock/gmock.h>

#include <fstream>

#include "reckon/tests/support/scratch_folder.hpp"
#include "reckon/tests/support/touch_meshes.hpp"
#include "reckon/tests/tools/support/captured_console.hpp"

namespace reckon::tools {
namespace {

using test::run_reckon;
using ::testing::HasSubstr;
using ::testing::Not;

TEST(StepTooDear, IsRefusedWithDearestStagesAndTheSwitch) {
  const test::ScratchFolder folder;
  test::write_obj(test::sliver_cone(100'000), folder.file("cone.obj"));
  std::ofstream(folder.file("cone.toml"))
      << "[[object]]\nname = \"cone\"\nmesh = \"cone.obj\"\ntexture = {height = \"0.1 mm\"}\n"
         "[hand]\ncontact_radius = \"20 mm\"\n[[operator]]\npassive = true\nposition = [0, 0, 1]\n"
         "[[device]]\nrate = \"10 kHz\"\n";
  const std::string scene = folder.file("cone.toml");
  const auto demo = run_reckon({"demo", scene, "--peers", "1", "--for", "10ms"});
  EXPECT_EQ(demo.status, 3);
  EXPECT_TRUE(demo.out.empty());
  EXPECT_THAT(demo.err, HasSubstr("a servo step that touches cone takes "));
  EXPECT_THAT(demo.err, HasSubstr("on this host, and its period is 0.1 ms (costliest: contact "));
  EXPECT_THAT(demo.err, HasSubstr("or add --even-if-slow"));
  const auto peer = run_reckon({"peer", scene, "--iface", "lo", "--for", "10ms"});
  EXPECT_EQ(peer.status, 3);
  EXPECT_THAT(peer.err, HasSubstr("a servo step that touches cone takes "));

  // The hand is far from the cone. A run that ends before the first check reports it, too.
  const auto all_the_same =
      run_reckon({"peer", scene, "--iface", "lo", "--for", "1us", "--events", "--even-if-slow"});
  EXPECT_EQ(all_the_same.status, 0) << all_the_same.err;
  EXPECT_THAT(all_the_same.out, HasSubstr("a servo step that touches cone takes "));
  const auto shown = run_reckon({"demo", scene, "--peers", "1", "--for", "1us", "--even-if-slow"});
  EXPECT_EQ(shown.status, 0) << shown.err;
  EXPECT_THAT(shown.err, HasSubstr("a servo step that touches cone takes "));
  const auto simulated = run_reckon({"demo", scene, "--simulated-time", "--for", "10ms"});
  EXPECT_EQ(simulated.status, 0) << simulated.err;
  EXPECT_THAT(simulated.err, Not(HasSubstr("a servo step")));
  EXPECT_EQ(run_reckon({"scene", "check", scene}).status, 0);
  EXPECT_THAT(run_reckon({"scene", "explain", scene}).out, HasSubstr("takes "));
}

}  // namespace
}  // namespace reckon::tools
