// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/bench/studies/figures/one_user.hpp"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <string>
#include <string_view>

#include "reckon/bench/studies/figures/scene_curves.hpp"

namespace reckon::bench {
namespace {

constexpr auto kWith = SpringReading::with_period;
constexpr auto kWithout = SpringReading::without_period;

OneUserScene scene_of(SpringReading reading, int order) {
  OneUserScene scene;
  scene.reading = reading;
  scene.order = order;
  return scene;
}

FigurePanel panel_of(SpringReading reading, std::array<int, 2> orders, Quantity quantity) {
  FigurePanel panel = panel_over_time(reading_name(reading), quantity, OneUserScene{}.duration);
  for (const int order : orders)
    panel.curves.push_back(
        curve_of(fmt::format("order {}", order), run(scene_of(reading, order)), quantity));
  return panel;
}

/// Panels in both readings.
std::vector<FigurePanel> panels_of(std::array<int, 2> orders, Quantity quantity) {
  return {panel_of(kWith, orders, quantity), panel_of(kWithout, orders, quantity)};
}

/// Growth rate of the envelope, as exp(rate t) [1/s].
double growth_of(SpringReading reading, int order) {
  const OneUserScene scene = scene_of(reading, order);
  return std::log(loop_radius(scene)) / scene.sample_period;
}

FigureNumber peak_of(const FigurePanel& panel, std::size_t curve, Quantity quantity,
                     std::optional<double> thesis = {}) {
  return {fmt::format("greatest, {}, {}", panel.curves[curve].name, panel.title),
          greatest(panel.curves[curve]), thesis, unit_of(quantity)};
}

FigureNumber last_of(const FigurePanel& panel, std::size_t curve, Quantity quantity,
                     std::optional<double> thesis = {}) {
  const FigureCurve& c = panel.curves[curve];
  return {fmt::format("at {:g} s, {}, {}", c.x.back(), c.name, panel.title), c.y.back(), thesis,
          unit_of(quantity)};
}

/// Growth of both orders in both readings, then the greatest values.
std::vector<FigureNumber> growth_numbers(const std::vector<FigurePanel>& panels,
                                         Quantity quantity) {
  std::vector<FigureNumber> numbers;
  for (const SpringReading reading : {kWithout, kWith})
    for (const int order : {3, 4})
      numbers.push_back({fmt::format("growth, order {}, {}", order, reading_name(reading)),
                         growth_of(reading, order),
                         {},
                         "1/s"});
  for (const FigurePanel& panel : panels)
    for (std::size_t curve = 0; curve < panel.curves.size(); ++curve)
      numbers.push_back(peak_of(panel, curve, quantity));
  return numbers;
}

Figure high_order(Quantity quantity) {
  Figure figure;
  figure.panels = panels_of({3, 4}, quantity);
  // Without T the curves grow beyond any picture: only their start is drawn.
  FigurePanel& without = figure.panels.back();
  const double reach = quantity == Quantity::force ? 8.0 : 2.0;
  without.range = {-reach, reach};
  without.end = 10;
  figure.numbers = growth_numbers(figure.panels, quantity);
  figure.thesis =
      "Oscillation, for higher order within a positive exponential envelope; no number is printed.";
  figure.why =
      "agrees in kind: all four grow, and no device damping makes such poles on the imaginary axis "
      "passive. The poles are not printed: ours are +-10j rad/s (order 3), with a lag alpha = 0.6 "
      "(order 4).";
  return figure;
}

}  // namespace

Figure figure_low_order_force() {
  Figure figure;
  figure.panels = panels_of({1, 2}, Quantity::force);
  const FigurePanel& with = figure.panels[0];
  const FigurePanel& without = figure.panels[1];
  figure.numbers = {
      last_of(with, 0, Quantity::force),
      last_of(without, 0, Quantity::force),
      peak_of(with, 0, Quantity::force),
      peak_of(without, 0, Quantity::force),
      {"settled to 2 %, order 1, K with T", settled_after(with.curves[0], 0.02), 4.0, "s"},
      {"settled to 2 %, order 1, K, no T", settled_after(without.curves[0], 0.02), 4.0, "s"}};
  figure.thesis =
      "No oscillation, transient of 1 to 4 s, some steady-state error; order 2 oscillates more, "
      "then merges with order 1.";
  figure.why =
      "not reproducible, because the wall holds an integrator: the force ends at the push of 1 N "
      "without error in either reading, and takes longer than 4 s. The pole of order 2 is not "
      "printed; ours is alpha = 0.6.";
  return figure;
}

Figure figure_low_order_velocity() {
  Figure figure;
  figure.panels = panels_of({1, 2}, Quantity::velocity);
  const FigurePanel& with = figure.panels[0];
  const FigurePanel& without = figure.panels[1];
  figure.numbers = {last_of(without, 0, Quantity::velocity, 0.2),
                    last_of(with, 0, Quantity::velocity, 0.2),
                    peak_of(without, 0, Quantity::velocity), peak_of(with, 0, Quantity::velocity)};
  figure.thesis =
      "Order 1 reaches a steady 0.2 after 1 to 4 s; order 2 oscillates more and for longer.";
  figure.why =
      "not reproducible, because an environment with a pole at z = 1 brings a pushed device to "
      "rest. Without T the velocity peaks at 0.2022, near the printed 0.2, then falls to 0.";
  return figure;
}

Figure figure_high_order_force() { return high_order(Quantity::force); }
Figure figure_high_order_velocity() { return high_order(Quantity::velocity); }

}  // namespace reckon::bench
