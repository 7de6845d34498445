// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/bench/reduction/order_choice.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <numbers>
#include <optional>
#include <sstream>
#include <stdexcept>
#include <utility>
#include <vector>

#include "reckon/bench/reduction/pressed_body.hpp"
#include "reckon/bench/reduction/response_peak.hpp"

namespace reckon::bench {
namespace {

using Eigen::Index;
using Eigen::MatrixXcd;
using Eigen::MatrixXd;

constexpr int kOrderGrid = 96;       // frequencies besides those near resonances
constexpr double kSlowest = 1e-4;    // of the band: practically 0
constexpr double kBeyond = 30.0;     // times the fastest resonance: practically infinite
constexpr double kNarrowest = 1e-4;  // of a resonance: smallest half-width considered
constexpr double kLight = 0.15;      // damping ratio below which models of few modes ring
constexpr double kHz = 2.0 * std::numbers::pi;

void check(double number, const char* what) {
  if (number > 0.0 && std::isfinite(number)) return;
  throw std::invalid_argument("order choice: the " + std::string(what) + " is " +
                              std::to_string(number) + "; give a number > 0");
}

void check(const InputRange& range, double threshold) {
  check(range.amplitude, "amplitude");
  check(range.band_hz, "band");
  check(threshold, "threshold");
}

// Grid up to a frequency, with points near the resonances below it.
std::vector<double> grid_to(double highest, double lowest,
                            const std::vector<Resonance>& resonances) {
  std::vector<double> grid = frequency_grid(lowest, highest, kOrderGrid);
  for (const Resonance& resonance : resonances) {
    const double width = std::max(resonance.half_width, kNarrowest * resonance.omega);
    if (resonance.omega > 0.0) near_resonance(resonance.omega, width, grid);
  }
  std::erase_if(grid, [&](double w) { return w < lowest || w > highest; });
  return grid;
}

double fastest(const std::vector<Resonance>& resonances) {
  double omega = 0.0;
  for (const Resonance& resonance : resonances) omega = std::max(omega, resonance.omega);
  return omega;
}

std::vector<Resonance> resonances_of(const StateSpace& system) {
  std::vector<Resonance> resonances;
  if (system.order() == 0) return resonances;
  for (const std::complex<double>& pole : poles(system)) {
    // A real pole counts with its corner frequency.
    resonances.push_back({std::max(std::abs(pole.imag()), std::abs(pole)), std::abs(pole.real())});
  }
  return resonances;
}

std::vector<Resonance> joined(std::vector<Resonance> a, const std::vector<Resonance>& b) {
  a.insert(a.end(), b.begin(), b.end());
  return a;
}

// Stores the full model's responses, because each order needs many of the same frequencies.
class RememberedResponse {
 public:
  explicit RememberedResponse(std::function<MatrixXcd(double)> full) : full_(std::move(full)) {}

  const MatrixXcd& at(double angular_frequency) {
    const auto known = known_.find(angular_frequency);
    if (known != known_.end()) return known->second;
    return known_.emplace(angular_frequency, full_(angular_frequency)).first->second;
  }

 private:
  std::function<MatrixXcd(double)> full_;
  std::map<double, MatrixXcd> known_;
};

bool rings(const ModalForceModel& model, int rigid) {
  const int elastic = model.modes() - rigid;
  if (elastic < 1 || elastic > 2) return false;
  for (int i = rigid; i < model.modes(); ++i) {
    if (damping_ratio(model, i) < kLight) return true;
  }
  return false;
}

// Common parts of both kinds of choice: a model of an order, its comparison with the full one, and
// orders tried from below.
template <typename Model>
struct Trial {
  Model model;
  std::function<double(double)> difference;  // for a motion of 1, at a frequency
  std::vector<double> grid;
};

// An order is rejected at the first frequency with an error above the threshold, usually where the
// one before was. Only the chosen order is evaluated completely, or all of them if none is chosen.
template <typename Model>
class Search {
 public:
  using Try = std::function<std::optional<Trial<Model>>(int)>;

  Search(const InputRange& range, double threshold, int least, int most)
      : range_(range), threshold_(threshold), least_(least), most_(most) {}

  /// @param trial of an order; no value if the order is skipped
  OrderChoice<Model> run(const Try& trial) {
    const double enough = threshold_ / range_.amplitude;
    double suspect = 0.0;
    for (int order = least_; order <= most_; ++order) {
      std::optional<Trial<Model>> next = trial(order);
      if (!next || (suspect > 0.0 && next->difference(suspect) > enough)) continue;
      const ResponsePeak peak = response_peak(next->difference, next->grid, enough);
      suspect = peak.angular_frequency;
      if (!is_within(peak)) continue;
      OrderChoice<Model> choice = choice_of(order, peak);
      choice.model = std::move(next->model);
      return choice;
    }
    return nearest(trial);
  }

 private:
  [[nodiscard]] bool is_within(const ResponsePeak& peak) const {
    return range_.amplitude * peak.value <= threshold_;
  }

  [[nodiscard]] OrderChoice<Model> choice_of(int order, const ResponsePeak& peak) const {
    OrderChoice<Model> choice;
    choice.order = order;
    choice.error = range_.amplitude * peak.value;
    choice.error_hz = peak.angular_frequency / kHz;
    return choice;
  }

  OrderChoice<Model> nearest(const Try& trial) const {
    std::optional<OrderChoice<Model>> best;
    for (int order = least_; order <= most_; ++order) {
      const std::optional<Trial<Model>> next = trial(order);
      if (!next) continue;
      const ResponsePeak peak = response_peak(next->difference, next->grid);
      if (!best || range_.amplitude * peak.value < best->error) best = choice_of(order, peak);
    }
    OrderChoice<Model> choice = best.value_or(OrderChoice<Model>{});
    std::ostringstream text;
    text << "order choice: no order up to " << most_ << " keeps the force within " << threshold_
         << " N for motions of " << range_.amplitude << " to " << range_.band_hz
         << " Hz; the nearest, " << choice.order << ", is off by " << choice.error << " N at "
         << choice.error_hz << " Hz. Allow as much, narrow the band, or damp the body";
    choice.refusal = text.str();
    return choice;
  }

  InputRange range_;
  double threshold_;
  int least_, most_;
};

}  // namespace

OrderChoice<ModalForceModel> choose_order(const BodyReduction& reduction, const InputRange& range,
                                          double stiffness, double threshold) {
  check(range, threshold);
  check(stiffness, "contact's stiffness");
  PressedBody body(reduction, stiffness);
  RememberedResponse response([&](double w) { return body.force(w); });
  const double band = kHz * range.band_hz, lowest = kSlowest * band;
  const auto difference = [&](const ModalForceModel& model) {
    return [&response, model, stiffness](double w) {
      return (response.at(w) - through_contact(compliance(model, w), stiffness)).norm();
    };
  };
  const auto grid = [&](const ModalForceModel& model, double highest) {
    return grid_to(highest, lowest, joined(body.resonances(), resonances_of(model, stiffness)));
  };

  const int least = reduction.least_modes(), most = reduction.most_modes();
  const auto trial = [&](int order) -> std::optional<Trial<ModalForceModel>> {
    ModalForceModel model = reduction.model(order);
    if (reduction.basis() != Basis::modes && rings(model, least)) return std::nullopt;
    return Trial<ModalForceModel>{model, difference(model), grid(model, band)};
  };
  OrderChoice<ModalForceModel> choice =
      Search<ModalForceModel>(range, threshold, least, most).run(trial);

  const ModalForceModel nearest = reduction.model(choice.order);
  // At high frequency only the contact's springs and the rest remain.
  const Index p = reduction.body().points();
  const MatrixXd springs = stiffness * MatrixXd::Identity(p, p);
  const double at_infinity =
      (springs - (MatrixXd::Identity(p, p) / stiffness + nearest.rest).inverse()).norm();
  const double all = kBeyond * std::max(band, fastest(body.resonances()));
  const ResponsePeak anywhere = response_peak(difference(nearest), grid(nearest, all));
  choice.bound = range.amplitude * std::max(anywhere.value, at_infinity);
  return choice;
}

OrderChoice<StateSpace> choose_order(const BalancedReduction& reduction, const InputRange& range,
                                     double threshold) {
  check(range, threshold);
  const StateSpace& system = reduction.system();
  const FrequencyResponse full(system);
  RememberedResponse response([&](double w) { return full.at_frequency(w); });
  const std::vector<Resonance> own = resonances_of(system);
  const double band = kHz * range.band_hz, lowest = kSlowest * band;

  const auto trial = [&](int order) -> std::optional<Trial<StateSpace>> {
    StateSpace model = reduction.model(order);
    const auto difference = [&response, reduced = FrequencyResponse(model)](double w) {
      return (response.at(w) - reduced.at_frequency(w)).norm();
    };
    return Trial<StateSpace>{model, difference,
                             grid_to(band, lowest, joined(own, resonances_of(model)))};
  };
  OrderChoice<StateSpace> choice =
      Search<StateSpace>(range, threshold, reduction.least_order(), reduction.most_order())
          .run(trial);
  choice.bound = range.amplitude * reduction.bound(choice.order);
  return choice;
}

}  // namespace reckon::bench
