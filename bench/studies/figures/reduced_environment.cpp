// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/bench/studies/figures/reduced_environment.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>

#include "reckon/bench/analysis/networked_pair.hpp"
#include "reckon/bench/studies/figures/scene_curves.hpp"

namespace reckon::bench {
namespace {

using Series = std::vector<std::array<SceneSample, 2>>;

enum class Model { complex, simple };

constexpr std::array kAlphas{0.5, 0.6, 0.8, 0.9, 0.95, 0.995};
/// For the scenes in which one user pushes: with this damping the simple model does not grow.
constexpr double kWallDamping = 0.1;
constexpr double kStaticGain = 0.5;

TwoUserScene scene_of(const ReductionScene& s) {
  TwoUserScene scene;
  scene.push[1] = s.other_push;
  scene.duration = s.duration;
  return scene;
}

TransferFunction environment_of(const ReductionScene& s, Model model) {
  const double period = PairParameters{}.sample_period;
  const double gain = kStaticGain * (1 - s.alpha);
  const TransferFunction environment = model == Model::complex
                                           ? two_pole_environment(gain, 1.0, s.alpha, period)
                                           : one_pole_environment(gain, 1.0, s.alpha, period);
  return sum(environment, {{s.wall_damping}, {1.0}, period});
}

Series series_of(const ReductionScene& s, Model model) {
  return run(scene_of(s), environment_of(s, model));
}

/// Simple minus complex, for the first user.
FigureCurve error_of(const ReductionScene& s, Quantity quantity) {
  FigureCurve error =
      curve_of(fmt::format("alpha = {:g}", s.alpha), series_of(s, Model::simple), 0, quantity);
  const Series complex = series_of(s, Model::complex);
  for (std::size_t i = 0; i < error.y.size(); ++i) error.y[i] -= value_of(complex[i][0], quantity);
  return error;
}

FigurePanel both_push(Model model, Quantity quantity) {
  const ReductionScene scene;
  FigurePanel panel = panel_over_time("both push, K/(1 - alpha) = 0.5", quantity, scene.duration);
  if (model == Model::simple) {
    panel.curves.push_back(curve_of("any alpha", series_of(scene, model), 0, quantity));
    return panel;
  }
  for (const double alpha : {0.6, 0.9, 0.995}) {
    const ReductionScene with{.alpha = alpha};
    panel.curves.push_back(
        curve_of(fmt::format("alpha = {:g}", alpha), series_of(with, model), 0, quantity));
  }
  return panel;
}

ReductionScene one_pushes() { return {.wall_damping = kWallDamping, .other_push = 0.0}; }

FigurePanel one_pushes_panel(Model model, Quantity quantity) {
  const ReductionScene scene = one_pushes();
  FigurePanel panel =
      panel_over_time("one pushes, K = 0.2, alpha = 0.6, b_e = 0.1", quantity, scene.duration);
  const Series series = series_of(scene, model);
  panel.curves = {curve_of("who pushes", series, 0, quantity),
                  curve_of("the other", series, 1, quantity)};
  // The complex model grows beyond any picture: only its start is drawn.
  if (model == Model::complex) {
    panel.range = {-4.0, 4.0};
    panel.end = 5;
  }
  return panel;
}

/// Growth rate of opposed motion, as exp(rate t) [1/s].
double opposed_growth(Model model) {
  const PairParameters pair;
  return std::log(opposed_radius(pair, environment_of(one_pushes(), model))) / pair.sample_period;
}

Figure figure_of(Model model, Quantity quantity, std::optional<double> level,
                 std::optional<double> reached) {
  Figure figure;
  figure.panels = {both_push(model, quantity), one_pushes_panel(model, quantity)};
  const FigureCurve& both = figure.panels[0].curves[0];
  figure.numbers = {
      {"at 15 s, both push", both.y.back(), level, unit_of(quantity)},
      {"settled to 1 %, both push", settled_after(both, 0.01), reached, "s"},
      {"greatest, one pushes", greatest(figure.panels[1].curves[0]), {}, unit_of(quantity)},
      {"growth of opposed motion", opposed_growth(model), {}, "1/s"}};
  return figure;
}

Figure error_figure(Quantity quantity, double thesis) {
  Figure figure;
  FigurePanel panel = panel_over_time("simple minus complex, both push, K/(1 - alpha) = 0.5",
                                      quantity, ReductionScene{}.duration);
  panel.value = "error of " + panel.value;
  for (const double alpha : kAlphas) {
    const ReductionScene scene{.alpha = alpha};
    panel.curves.push_back(error_of(scene, quantity));
    figure.numbers.push_back({fmt::format("greatest error, alpha = {:g}", alpha),
                              greatest(panel.curves.back()), thesis, unit_of(quantity)});
  }
  // The alpha of the preceding figures represents the figure.
  std::swap(figure.numbers[0], figure.numbers[1]);
  figure.panels = {std::move(panel)};
  return figure;
}

}  // namespace

ReductionErrors reduction_errors(const ReductionScene& scene) {
  return {greatest(error_of(scene, Quantity::force)),
          greatest(error_of(scene, Quantity::velocity))};
}

Figure figure_complex_force() {
  Figure figure = figure_of(Model::complex, Quantity::force, {}, {});
  figure.thesis =
      "Constant from 2.5 to 7 s, then it oscillates, from about 7.5 s; no level printed.";
  figure.why =
      "not reproducible, because K, a and alpha are not printed. With those that give its velocity "
      "of 1.25, two equal pushes settle for good, and any difference between them oscillates and "
      "grows from the start.";
  return figure;
}

Figure figure_simple_force() {
  Figure figure = figure_of(Model::simple, Quantity::force, {}, {});
  figure.thesis = "The simple environment removes the oscillation; no number is printed.";
  figure.why =
      "agrees in kind: where the complex one grows without bound, the simple one stays finite. It "
      "is marginal, though: radius 1.00000 at a delay of 1 sample, unstable at 2.";
  return figure;
}

Figure figure_force_error() {
  Figure figure = error_figure(Quantity::force, 0.3);
  figure.thesis = "Greatest error 0.3, that is 30 % of the unit step.";
  figure.why =
      "not reproducible, because alpha is not printed: the error depends on it, and no alpha of "
      "0.5 to 0.995 gives this one together with that of Fig 4.13. Where one user alone pushes it "
      "has no bound.";
  return figure;
}

Figure figure_complex_velocity() {
  Figure figure = figure_of(Model::complex, Quantity::velocity, 1.25, 7.5);
  figure.thesis = "Grows exponentially, constant 1.25 from about 7.5 s.";
  figure.why =
      "the level agrees where both push: b = 0.3, and K/(1 - alpha) = 0.5 for any alpha. K, a and "
      "alpha are not printed; they set the time. One user alone makes it unstable.";
  return figure;
}

Figure figure_simple_velocity() {
  Figure figure = figure_of(Model::simple, Quantity::velocity, 1.25, 9.5);
  figure.thesis = "Almost as Fig 4.11; constant after 9.5 s.";
  figure.why =
      "the level agrees where both push. That the simple one takes 2 s longer is not reproducible, "
      "because K, a and alpha are not printed; here both take equally long.";
  return figure;
}

Figure figure_velocity_error() {
  Figure figure = error_figure(Quantity::velocity, 0.06);
  figure.thesis = "Greatest error about 0.06.";
  figure.why =
      "not reproducible, because alpha is not printed: 0.06 lies between alpha = 0.95 and 0.995, "
      "where the error of the force is not the 0.3 of Fig 4.10.";
  return figure;
}

}  // namespace reckon::bench
