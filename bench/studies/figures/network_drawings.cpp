// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/bench/studies/figures/network_drawings.hpp"

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

/// Effort and flow between two ports: force above, speed below.
void port(Diagram& d, const Node& left, const Node& right, std::string_view force,
          std::string_view speed) {
  d.line({left.right(-22), right.left(-22)}, force);
  d.line({left.right(22), right.left(22)}, speed);
}

}  // namespace

Figure drawing_two_port() {
  Diagram d;
  const Node user = d.box(110, 60, "user", 130, 90);
  const Node display = d.box(380, 60, "haptic display\nand simulation\n(two-port P)", 170, 90);
  const Node world = d.box(650, 60, "virtual\nenvironment", 130, 90);
  port(d, user, display, "F_h", "V_h");
  port(d, display, world, "F_e*", "V_e*");
  return drawn(std::move(d), "The interface as a two-port between user and virtual environment.",
               "two_port.hpp: impedance, admittance and both hybrid forms, (3.3), (3.4) with the "
               "conjugate that the print lacks, Llewellyn's condition.");
}

Figure drawing_display() {
  Diagram d;
  const Node sum = d.sum(130, 60);
  const Node plant = d.box(270, 60, "1/(m s + b)");
  const Node integral = d.box(430, 60, "1/s", 70);
  const Node wall = d.box(620, 180, "unilateral\nconstraint");
  const Node environment = d.box(430, 180, "H(z)", 90);
  const Node hold = d.box(240, 180, "hold", 90);
  d.arrow({{30, 60}, sum.left()}, "f");
  d.arrow({sum.right(), plant.left()});
  d.arrow({plant.right(), integral.left()}, "v");
  const Node out = d.dot(620, 60);
  d.line({integral.right(), out.middle}, "y");
  d.arrow({out.middle, {720, 60}});
  d.arrow({out.middle, wall.top()}, "sampled, each T");
  d.arrow({wall.left(), environment.right()});
  d.arrow({environment.left(), hold.right()});
  d.arrow({hold.left(), {130, 180}, sum.bottom()}, "-");
  return drawn(std::move(d),
               "One degree of freedom: continuous device, sampled environment behind a unilateral "
               "constraint.",
               "OneUserScene with a wall (thesis_scenes.hpp): the device exact between samples, "
               "contact at its instant by hybrid_motion.hpp.");
}

Figure drawing_stand_alone() {
  Diagram d;
  const Node sum = d.sum(150, 60);
  const Node device = d.box(350, 60, "device\n1/(m s + b)", 130);
  const Node environment = d.box(470, 170, "VE(z)\nb_e + K_e T z/(z - 1)", 170);
  const Node hold = d.box(240, 170, "zero-order\nhold", 100);
  const Node out = d.dot(640, 60);
  d.arrow({{40, 60}, sum.left()}, "push, a step");
  d.arrow({sum.right(), device.left()});
  d.line({device.right(), out.middle}, "velocity v");
  d.arrow({out.middle, {725, 60}});
  d.arrow({out.middle, {640, 170}, environment.right()}, "each T");
  d.arrow({environment.left(), hold.right()}, "F");
  d.arrow({hold.left(), {150, 170}, sum.bottom()}, "-");
  return drawn(std::move(d), "The stand-alone system that Figs 3.5 to 3.8 simulate.",
               "run(OneUserScene); its loop radius by loop_radius(). K with T as (3.6) prints it; "
               "K, no T is the other reading.");
}

Figure drawing_networked_pair() {
  Diagram d;
  const auto user = [&d](double y, std::string_view number, double into) {
    const std::string n(number);
    const Node sum = d.sum(130, y);
    const Node device = d.box(260, y, "HD" + n, 90);
    const Node hold = d.box(240, into, "ZOH", 80);
    const Node environment = d.box(400, into, "VE" + n, 80);
    const Node difference = d.sum(560, into);
    d.arrow({{30, y}, sum.left()}, "F_h" + n);
    d.arrow({sum.right(), device.left()});
    const Node out = d.dot(560, y);
    d.line({device.right(), out.middle}, "V_h" + n);
    d.arrow({out.middle, difference.at(0, y < into ? -12 : 12)});
    d.arrow({difference.left(), environment.right()});
    d.arrow({environment.left(), hold.right()});
    d.arrow({hold.left(), {130, into}, sum.at(0, y < into ? 12 : -12)}, "-");
    return difference;
  };
  const Node first = user(40, "1", 130);
  const Node second = user(400, "2", 310);
  const Node there = d.box(690, 180, "z^-1", 80);
  const Node back = d.box(690, 260, "z^-1", 80);
  d.arrow({{560, 40}, {745, 40}, {745, 180}, there.right()});
  d.arrow({there.bottom(), {690, 215}, {560, 215}, second.top()});
  d.arrow({{560, 400}, {745, 400}, {745, 260}, back.right()});
  d.arrow({back.left(), {600, 260}, {600, 130}, first.right()});
  d.text(586, 123, "-");
  d.text(548, 290, "-");
  return drawn(std::move(d),
               "Two users with equal devices and environments; the input of each is its speed "
               "minus the other's speed one sample ago.",
               "run(TwoUserScene), pair_loop() and pair_radii() for any delay. Reckon does not "
               "couple hands like this: it sends models (docs/haptic_stability.md).");
}

Figure drawing_signal_graph() {
  Diagram d;
  const Node in1 = d.ellipse(90, 50, "F_h1", 70), in2 = d.ellipse(90, 240, "F_h2", 70);
  const Node out1 = d.ellipse(660, 50, "V_h1", 70), out2 = d.ellipse(660, 240, "V_h2", 70);
  d.arrow({in1.right(), out1.left()}, "HD1");
  d.arrow({in2.right(), out2.left()}, "HD2");
  d.arrow({in1.at(35, 6), out2.at(-35, -6)});
  d.arrow({in2.at(35, -6), out1.at(-35, 6)});
  d.text(345, 84, "-z^-1 HD1 VE2 ZOH HD2");
  d.text(345, 200, "-z^-1 HD2 VE1 ZOH HD1");
  return drawn(std::move(d),
               "Signal flow of two users, from pushes to speeds; it gives the matrix of (4.1).",
               "printed_pair() is this graph: it lacks the loop of each user with its environment, "
               "and the coupling has the wrong sign. closed_pair() has both.");
}

Figure drawing_delayed_junction() {
  Diagram d;
  const Node one = d.box(120, 80, "subsystem 1", 130, 110);
  const Node two = d.box(640, 80, "subsystem 2", 130, 110);
  const Node there = d.box(380, 50, "z^-1", 80, 36), back = d.box(380, 110, "z^-1", 80, 36);
  d.arrow({one.right(-30), there.left()}, "F_1");
  d.arrow({there.right(), two.left(-30)}, "-F_2");
  d.arrow({two.left(30), back.right()}, "V_2");
  d.arrow({back.left(), one.right(30)}, "V_1");
  return drawn(std::move(d),
               "The simplest distributed simulation: effort and flow exchanged over a unit delay.",
               "delayed_junction() (wave_line.hpp). P + P^H has the eigenvalues +-2 sin wT, real: "
               "it generates energy at every delay except 0.");
}

Figure drawing_transmission_line() {
  Diagram d;
  const Node one = d.box(110, 80, "subsystem a", 120, 110);
  const Node two = d.box(650, 80, "subsystem b", 120, 110);
  const Node line =
      d.box(380, 80, "lossless line\nZ_0 = sqrt(M K), T = sqrt(M/K)\nwaves e + Z_0 f, e - Z_0 f",
            240, 110);
  d.arrow({one.right(-30), line.left(-30)}, "e_a, f_a");
  d.arrow({line.right(-30), two.left(-30)}, "e^-Ts");
  d.arrow({two.left(30), line.right(30)}, "e_b, f_b");
  d.arrow({line.left(30), one.right(30)}, "e^-Ts");
  return drawn(std::move(d),
               "A junction by a lossless, dispersionless transmission line between the subsystems.",
               "transmission_line() and WaveLine (wave_line.hpp): the input of one end leaves the "
               "other end after T; no energy is generated at any constant delay.");
}

Figure drawing_environments() {
  Diagram d;
  const Node complex = d.box(390, 50, "complex: K z/((z - a)(z - alpha))", 260);
  const Node simple = d.box(390, 150, "simple: (K z/(1 - alpha))/(z - a)", 260);
  d.arrow({{120, 50}, complex.left()}, "velocity");
  d.arrow({complex.right(), {660, 50}}, "force");
  d.arrow({{120, 150}, simple.left()}, "velocity");
  d.arrow({simple.right(), {660, 150}}, "force");
  d.arrow({complex.bottom(), simple.top()}, "pole alpha held at rest");
  return drawn(std::move(d), "The complex environment and the simple one of (4.21).",
               "two_pole_environment() and one_pole_environment(); residualised(system, 1) of the "
               "order reduction is the same step.");
}

}  // namespace reckon::bench
