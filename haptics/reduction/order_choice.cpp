// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/haptics/reduction/order_choice.hpp"

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <numbers>
#include <sstream>
#include <stdexcept>
#include <utility>
#include <vector>

#include "reckon/haptics/reduction/response_peak.hpp"

namespace reckon::haptics {
namespace {

using Eigen::Index;
using Eigen::MatrixXcd;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr int kGrid = 96;            // frequencies besides those near resonances
constexpr double kSlowest = 1e-4;    // of the band: as good as 0
constexpr double kBeyond = 30.0;     // times the fastest resonance: as good as infinite
constexpr double kNarrowest = 1e-4;  // of a resonance: half-width that is looked at
constexpr double kLight = 0.15;      // damping ratio below which few modes ring
constexpr double kHz = 2.0 * std::numbers::pi;

struct Resonance {
  double omega = 0.0;       // [rad/s]
  double half_width = 0.0;  // [rad/s]
};

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

// Grid up to a frequency, with what is near resonances below it.
std::vector<double> grid_to(double highest, double lowest,
                            const std::vector<Resonance>& resonances) {
  std::vector<double> grid = frequency_grid(lowest, highest, kGrid);
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

// Modes of K + k B B^T, M with D: those of the body with springs on its points, held by probes.
std::vector<Resonance> resonances_of(const MatrixXd& K, const MatrixXd& D, const MatrixXd& M) {
  const Eigen::GeneralizedSelfAdjointEigenSolver<MatrixXd> modes(K, M);
  const MatrixXd& shapes = modes.eigenvectors();
  std::vector<Resonance> resonances;
  for (Index i = 0; i < shapes.cols(); ++i) {
    const double damping = shapes.col(i).dot(D * shapes.col(i));
    resonances.push_back({std::sqrt(std::max(0.0, modes.eigenvalues()[i])), 0.5 * damping});
  }
  return resonances;
}

std::vector<Resonance> resonances_of(const ModalForceModel& model, double stiffness) {
  const Index r = model.modes(), p = model.points();
  if (r == 0) return {};
  const MatrixXd W = (MatrixXd::Identity(p, p) / stiffness + model.rest).inverse();
  MatrixXd K = model.shape * W * model.shape.transpose();
  K.diagonal() += model.omega.cwiseAbs2();
  return resonances_of(K, MatrixXd(model.damping.asDiagonal()), MatrixXd::Identity(r, r));
}

std::vector<Resonance> resonances_of(const StateSpace& system) {
  std::vector<Resonance> resonances;
  if (system.order() == 0) return resonances;
  for (const std::complex<double>& pole : poles(system)) {
    // What does not ring has its corner instead.
    resonances.push_back({std::max(std::abs(pole.imag()), std::abs(pole)), std::abs(pole.real())});
  }
  return resonances;
}

std::vector<Resonance> joined(std::vector<Resonance> a, const std::vector<Resonance>& b) {
  a.insert(a.end(), b.begin(), b.end());
  return a;
}

// Force a displacement of probes on contact springs, of a body with this compliance.
MatrixXcd through_contact(const MatrixXcd& compliance, double stiffness) {
  const Index p = compliance.rows();
  return MatrixXcd(MatrixXcd::Identity(p, p) / stiffness + compliance).inverse();
}

// The full model's responses, kept: each order asks at many of the same frequencies.
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

// What both kinds of choice have in common: orders are tried from below.
template <typename Model>
class Search {
 public:
  Search(const InputRange& range, double threshold) : range_(range), threshold_(threshold) {}

  /// @returns whether it is the one
  bool take(Model model, int order, const ResponsePeak& difference) {
    const double error = range_.amplitude * difference.value;
    if (choice_.model || (tried_ && !(error < choice_.error))) return false;
    tried_ = true;
    choice_.order = order;
    choice_.error = error;
    choice_.error_hz = difference.angular_frequency / kHz;
    if (error <= threshold_) choice_.model = std::move(model);
    return choice_.model.has_value();
  }

  OrderChoice<Model>& choice() { return choice_; }

  void refuse(int most) {
    if (choice_.model) return;
    std::ostringstream text;
    text << "order choice: no order up to " << most << " keeps the force within " << threshold_
         << " N for motions of " << range_.amplitude << " to " << range_.band_hz
         << " Hz; the nearest, " << choice_.order << ", is off by " << choice_.error << " N at "
         << choice_.error_hz << " Hz. Allow as much, narrow the band, or damp the body";
    choice_.refusal = text.str();
  }

 private:
  InputRange range_;
  double threshold_;
  OrderChoice<Model> choice_;
  bool tried_ = false;
};

}  // namespace

OrderChoice<ModalForceModel> choose_order(const BodyReduction& reduction, const InputRange& range,
                                          double stiffness, double threshold) {
  check(range, threshold);
  check(stiffness, "contact's stiffness");
  const SecondOrderSystem& body = reduction.body();
  const BodyCompliance full(body);
  RememberedResponse response([&](double w) { return through_contact(full.at(w), stiffness); });
  const std::vector<Resonance> own =
      body.size() <= BodyReduction::kMostDense
          ? resonances_of(MatrixXd(body.K) + stiffness * body.B * body.B.transpose(),
                          MatrixXd(body.D), MatrixXd(body.M))
          : resonances_of(reduction.model(reduction.most_modes()), stiffness);
  const double band = kHz * range.band_hz, lowest = kSlowest * band;
  const auto difference = [&](const ModalForceModel& model, double highest) {
    const auto at = [&](double w) {
      return (response.at(w) - through_contact(compliance(model, w), stiffness)).norm();
    };
    return response_peak(at,
                         grid_to(highest, lowest, joined(own, resonances_of(model, stiffness))));
  };

  Search<ModalForceModel> search(range, threshold);
  const int least = reduction.least_modes(), most = reduction.most_modes();
  for (int order = least; order <= most; ++order) {
    ModalForceModel model = reduction.model(order);
    if (reduction.basis() != Basis::modes && rings(model, least)) continue;
    const ResponsePeak peak = difference(model, band);
    if (search.take(std::move(model), order, peak)) break;
  }
  search.refuse(most);
  OrderChoice<ModalForceModel>& choice = search.choice();
  const ModalForceModel nearest = reduction.model(choice.order);
  // At high frequency nothing but the contact's springs and the rest is left.
  const Index p = body.points();
  const MatrixXd springs = stiffness * MatrixXd::Identity(p, p);
  const double at_infinity =
      (springs - (MatrixXd::Identity(p, p) / stiffness + nearest.rest).inverse()).norm();
  const double all = kBeyond * std::max(band, fastest(own));
  choice.bound = range.amplitude * std::max(difference(nearest, all).value, at_infinity);
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

  Search<StateSpace> search(range, threshold);
  for (int order = reduction.least_order(); order <= reduction.most_order(); ++order) {
    StateSpace model = reduction.model(order);
    const FrequencyResponse reduced(model);
    const auto at = [&](double w) { return (response.at(w) - reduced.at_frequency(w)).norm(); };
    const ResponsePeak peak =
        response_peak(at, grid_to(band, lowest, joined(own, resonances_of(model))));
    if (search.take(std::move(model), order, peak)) break;
  }
  search.refuse(reduction.most_order());
  OrderChoice<StateSpace>& choice = search.choice();
  choice.bound = range.amplitude * reduction.bound(choice.order);
  return choice;
}

}  // namespace reckon::haptics
