// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/bench/studies/figures/two_users.hpp"

#include <string>

#include "reckon/bench/analysis/networked_pair.hpp"
#include "reckon/bench/studies/figures/scene_curves.hpp"

namespace reckon::bench {
namespace {

constexpr auto kWith = SpringReading::with_period;
constexpr auto kWithout = SpringReading::without_period;

TwoUserScene scene_of(SpringReading reading, double other_push) {
  TwoUserScene scene;
  scene.pair.reading = reading;
  scene.push[1] = other_push;
  return scene;
}

FigurePanel panel_of(SpringReading reading, Quantity quantity) {
  FigurePanel panel = panel_over_time(reading_name(reading), quantity, TwoUserScene{}.duration);
  panel.curves.push_back(curve_of("both push, either", run(scene_of(reading, 1)), 0, quantity));
  const auto one = run(scene_of(reading, 0));
  panel.curves.push_back(curve_of("one pushes, itself", one, 0, quantity));
  panel.curves.push_back(curve_of("one pushes, the other", one, 1, quantity));
  return panel;
}

std::vector<FigureNumber> numbers_of(const std::vector<FigurePanel>& panels, Quantity quantity,
                                     std::optional<double> thesis) {
  std::vector<FigureNumber> numbers;
  for (const FigurePanel& panel : panels)
    numbers.push_back({"at 20 s, both push, " + panel.title, panel.curves[0].y.back(), thesis,
                       unit_of(quantity)});
  for (const FigurePanel& panel : panels)
    numbers.push_back(
        {"at 20 s, one pushes, " + panel.title, panel.curves[1].y.back(), {}, unit_of(quantity)});
  return numbers;
}

Figure figure_of(Quantity quantity, std::optional<double> thesis) {
  Figure figure;
  figure.panels = {panel_of(kWithout, quantity), panel_of(kWith, quantity)};
  figure.numbers = numbers_of(figure.panels, quantity, thesis);
  return figure;
}

}  // namespace

int least_unstable_delay(SpringReading reading) {
  // Greater delays of the same pair are unstable too, so that bisection finds the least.
  const auto is_unstable = [&](int delay) {
    PairParameters pair;
    pair.reading = reading;
    pair.delay_samples = delay;
    return opposed_radius(pair) > 1.0;
  };
  int stable = 0, unstable = 1;
  while (!is_unstable(unstable)) {
    stable = unstable;
    unstable *= 2;
  }
  while (unstable - stable > 1) {
    const int middle = (stable + unstable) / 2;
    (is_unstable(middle) ? unstable : stable) = middle;
  }
  return unstable;
}

Figure figure_two_users_force() {
  Figure figure = figure_of(Quantity::force, {});
  figure.thesis =
      "Ideally 0; a steady-state error and an oscillation larger than alone. No number is printed.";
  figure.why =
      "agrees in kind without T: both push, and the delay of the other gives each 0.4 N, K d/(b + "
      "K d). With T that is 0.007 N.";
  return figure;
}

Figure figure_two_users_velocity() {
  Figure figure = figure_of(Quantity::velocity, 2.0);
  for (const SpringReading reading : {kWithout, kWith})
    figure.numbers.push_back(
        {"least delay that makes opposed motion unstable, " + reading_name(reading),
         static_cast<double>(least_unstable_delay(reading)),
         {},
         "samples"});
  figure.thesis = "Grows exponentially, called unstable, and reaches a steady 2; spongy.";
  figure.why =
      "agrees without T where both push: 1/(b + K d) = 2. It is an approach to 2, not a growth: at "
      "a delay of 1 sample the loop is stable. With T it would be 3.3.";
  return figure;
}

}  // namespace reckon::bench
