// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/bench/studies/figures/world_drawings.hpp"

#include <array>
#include <string>
#include <utility>

namespace reckon::bench {
namespace {

using Node = Diagram::Node;

Figure drawn(Diagram diagram, std::string thesis, std::string ours) {
  Figure figure;
  figure.thesis = std::move(thesis);
  figure.why = std::move(ours);
  figure.drawing = std::move(diagram);
  return figure;
}

}  // namespace

Figure drawing_family() {
  Diagram d;
  const Node parent = d.ellipse(380, 40, "parent", 120);
  const Node left = d.ellipse(230, 130, "child", 120), right = d.ellipse(530, 130, "child", 120);
  d.line({parent.bottom(-20), left.top()});
  d.line({parent.bottom(20), right.top()});
  d.arrow({{380, 130}, left.right()}, "");
  d.arrow({{380, 130}, right.left()}, "");
  d.text(380, 120, "siblings");
  return drawn(std::move(d), "Parent, child and sibling in a scene graph.",
               "src/scene_graph: each node has its parent and the end of its subtree; the first "
               "child follows its parent (docs/scene_graph.md).");
}

Figure drawing_traversal() {
  Diagram d;
  const Node root = d.ellipse(380, 40, "1 root", 110);
  const Node a = d.ellipse(190, 120, "2 group", 110), b = d.ellipse(570, 120, "7 group", 110);
  const Node first = d.ellipse(80, 210, "3 postn node", 130);
  const Node second = d.ellipse(230, 210, "4 group", 100);
  const Node inner = d.ellipse(160, 300, "5 postn node", 130);
  const Node last = d.ellipse(310, 300, "6 geom node", 130);
  const Node light = d.ellipse(500, 210, "8 light node", 130);
  const Node shape = d.ellipse(650, 210, "9 geom node", 130);
  const std::array<std::pair<Node, Node>, 8> family{{{root, a},
                                                     {root, b},
                                                     {a, first},
                                                     {a, second},
                                                     {second, inner},
                                                     {second, last},
                                                     {b, light},
                                                     {b, shape}}};
  for (const auto& [parent, child] : family) d.arrow({parent.bottom(), child.top()});
  return drawn(
      std::move(d),
      "Traversal from top to bottom, left to right; the numbers show the order, once a frame.",
      "src/scene_graph: nodes are kept in this order, and GraphWalk modifies a state on the way; "
      "the tree is our example.");
}

Figure drawing_contact_point() {
  Diagram d;
  const Node surface = d.frame(380, 150, "", 640, 140);
  d.text(150, 190, "inside of a solid");
  d.line({surface.at(-320, -70), surface.at(320, -70)});
  const Node before = d.dot(150, 30);
  d.text(150, 18, "free: both are one point");
  const Node device = d.dot(520, 160), scp = d.dot(520, 80);
  d.arrow({before.middle, {330, 92}, device.middle});
  d.line({device.middle, scp.middle});
  d.text(590, 70, "SCP, on the surface");
  d.text(600, 164, "device, where it is");
  d.text(615, 124, "F = K (SCP - device) - b v");
  return drawn(
      std::move(d),
      "The surface contact point (SCP) stays on the surface while the device passes through it.",
      "haptics/geometry: the SCP never penetrates planes, solids, meshes and implicit surfaces; "
      "the spring between SCP and device is the force.");
}

Figure drawing_processes() {
  Diagram d;
  d.frame(200, 190, "application process, 30 Hz", 300, 370);
  d.frame(590, 190, "haptic process, 1000 Hz", 260, 370);
  const auto step = [&d](double y, std::string_view text) { return d.box(200, y, text, 200, 40); };
  const Node scene = step(60, "scene creation");
  const Node start = step(125, "start of the servo loop");
  const Node core = step(190, "core function");
  const Node update = step(255, "haptic state update");
  const Node end = step(320, "clean-up");
  const Node servo = d.box(590, 125, "servo loop:\ncontact, force, device", 190, 56);
  const Node dynamics = d.box(590, 255, "dynamics:\nmotion, collisions", 190, 56);
  d.arrow({scene.bottom(), start.top()});
  d.arrow({start.bottom(), core.top()});
  d.arrow({core.bottom(), update.top()});
  d.arrow({update.bottom(), end.top()}, "when stopped");
  d.arrow({update.left(), {75, 255}, {75, 190}, core.left()});
  d.arrow({start.right(), servo.left()}, "starts");
  d.arrow({update.right(-8), dynamics.left(-8)}, "");
  d.arrow({dynamics.left(8), update.right(8)}, "");
  d.text(400, 238, "states");
  d.arrow({servo.bottom(-30), dynamics.top(-30)});
  d.arrow({dynamics.top(30), servo.bottom(30)});
  return drawn(std::move(d), "Application process, haptic process, and the data between them.",
               "Reckon's peer runs the servo at 1 kHz in its own thread, beside threads for model, "
               "network and display (docs/architecture.md, loops).");
}

Figure drawing_simulation_loop() {
  Diagram d;
  constexpr std::array<std::string_view, 5> kSteps{"read sensors\n(forces)",
                                                   "actions of\nthe universe",
                                                   "tasks of\nthe objects", "render", "stopped?"};
  std::array<Node, kSteps.size()> steps;
  for (std::size_t i = 0; i < kSteps.size(); ++i)
    steps[i] = d.box(90 + 145 * static_cast<double>(i), 50, kSteps[i], 110, 50);
  for (std::size_t i = 1; i < kSteps.size(); ++i) d.arrow({steps[i - 1].right(), steps[i].left()});
  d.arrow({steps[4].bottom(), {670, 120}, {90, 120}, steps[0].bottom()}, "no: the next frame");
  d.arrow({steps[4].right(), {752, 50}}, "");
  d.text(740, 40, "yes");
  return drawn(std::move(d), "The simulation loop of the core application.",
               "Reckon's model loop has these stages in each pass and publishes where this one "
               "renders: `reckon demo --trace-loop` writes them (docs/architecture.md).");
}

Figure drawing_work_space() {
  Diagram d;
  const Node space = d.frame(380, 150, "six walls", 420, 260);
  const Node cube = d.box(300, 190, "cube", 70, 70), other = d.box(470, 110, "cube", 70, 70);
  const Node hand = d.dot(240, 90), second = d.dot(530, 220);
  d.text(240, 80, "hand of user 1");
  d.text(530, 245, "hand of user 2");
  d.arrow({hand.middle, cube.at(-20, -35)});
  d.arrow({second.middle, other.at(20, 35)});
  d.arrow({cube.left(), space.left(40), space.at(-150, 90)});
  d.text(85, 175, "rebound with\ndamped velocity");
  return drawn(
      std::move(d), "The work space: two users, cubes, and a box of six walls.",
      "Reckon's scenes hold solids, bodies and hands at any place; the six walls are the scene's "
      "work_space, from which bodies rebound and which hands do not feel (docs/bodies.md).");
}

}  // namespace reckon::bench
