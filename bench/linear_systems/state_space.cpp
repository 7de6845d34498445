// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/bench/linear_systems/state_space.hpp"

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <cmath>
#include <stdexcept>
#include <string>
#include <unsupported/Eigen/MatrixFunctions>

namespace reckon::bench {
namespace {

using Eigen::Index;
using Eigen::MatrixXcd;
using Eigen::MatrixXd;

std::string size_of(const MatrixXd& m) {
  return std::to_string(m.rows()) + " x " + std::to_string(m.cols());
}

void require_size(const char* name, const MatrixXd& m, Index rows, Index columns) {
  if (m.rows() == rows && m.cols() == columns) return;
  throw std::invalid_argument(std::string("state space: ") + name + " is " + size_of(m) +
                              ", with this A and D it must be " + std::to_string(rows) + " x " +
                              std::to_string(columns));
}

void require_same_period(const StateSpace& a, const StateSpace& b) {
  if (a.sample_period == b.sample_period) return;
  throw std::invalid_argument("state space: sample periods " + std::to_string(a.sample_period) +
                              " s and " + std::to_string(b.sample_period) +
                              " s cannot be joined; discretise both with one period");
}

void require_fit(bool fits, const char* what) {
  if (!fits) throw std::invalid_argument(std::string("state space: ") + what);
}

void require_period(double sample_period) {
  require_fit(sample_period > 0 && std::isfinite(sample_period),
              "a sample period must be a finite number above 0 s");
}

// [a b; c d]
MatrixXd blocks(const MatrixXd& a, const MatrixXd& b, const MatrixXd& c, const MatrixXd& d) {
  MatrixXd all = MatrixXd::Zero(a.rows() + c.rows(), a.cols() + b.cols());
  all.topLeftCorner(a.rows(), a.cols()) = a;
  all.topRightCorner(b.rows(), b.cols()) = b;
  all.bottomLeftCorner(c.rows(), c.cols()) = c;
  all.bottomRightCorner(d.rows(), d.cols()) = d;
  return all;
}

MatrixXd beside(const MatrixXd& a, const MatrixXd& b) {
  return blocks(a, b, MatrixXd(0, a.cols()), MatrixXd(0, b.cols()));
}

MatrixXd above(const MatrixXd& a, const MatrixXd& b) {
  return blocks(a, MatrixXd(a.rows(), 0), b, MatrixXd(b.rows(), 0));
}

}  // namespace

StateSpace checked(StateSpace s) {
  require_size("A", s.A, s.A.rows(), s.A.rows());
  require_size("B", s.B, s.order(), s.inputs());
  require_size("C", s.C, s.outputs(), s.order());
  require_fit(s.A.allFinite() && s.B.allFinite() && s.C.allFinite() && s.D.allFinite(),
              "an entry of A, B, C or D is not finite; mend the model");
  require_fit(s.sample_period >= 0 && std::isfinite(s.sample_period),
              "the sample period must be a finite number >= 0 s (0: continuous)");
  return s;
}

StateSpace static_gain(const MatrixXd& D, double sample_period) {
  return checked({MatrixXd(0, 0), MatrixXd(0, D.cols()), MatrixXd(D.rows(), 0), D, sample_period});
}

StateSpace sample_delay(int samples, Index channels, double sample_period) {
  require_fit(samples >= 0, "a delay must be 0 or more samples");
  require_period(sample_period);
  const MatrixXd unit = MatrixXd::Identity(channels, channels);
  if (samples == 0) return static_gain(unit, sample_period);

  // A shift register: the input of the first element leaves the last one `samples` later.
  const Index order = samples * channels;
  MatrixXd A = MatrixXd::Zero(order, order);
  A.bottomLeftCorner(order - channels, order - channels).setIdentity();
  MatrixXd B = MatrixXd::Zero(order, channels);
  B.topRows(channels) = unit;
  MatrixXd C = MatrixXd::Zero(channels, order);
  C.rightCols(channels) = unit;
  return {A, B, C, MatrixXd::Zero(channels, channels), sample_period};
}

std::complex<double> border_point(double sample_period, double angular_frequency) {
  if (sample_period > 0) return std::polar(1.0, angular_frequency * sample_period);
  return {0.0, angular_frequency};
}

MatrixXcd evaluate(const StateSpace& s, std::complex<double> point) {
  if (s.order() == 0) return s.D;
  MatrixXcd resolvent = -s.A;
  resolvent.diagonal().array() += point;
  return s.C * resolvent.partialPivLu().solve(s.B.cast<std::complex<double>>()) + s.D;
}

FrequencyResponse::FrequencyResponse(const StateSpace& system)
    : direct_(checked(system).D), sample_period_(system.sample_period) {
  if (system.order() == 0) return;
  const Eigen::ComplexSchur<MatrixXcd> schur(system.A);
  if (schur.info() != Eigen::Success) {
    throw std::runtime_error("state space: no Schur form of A was found; scale the model");
  }
  triangle_ = schur.matrixT();
  input_ = schur.matrixU().adjoint() * system.B;
  output_ = system.C * schur.matrixU();
}

MatrixXcd FrequencyResponse::at(std::complex<double> point) const {
  if (triangle_.size() == 0) return direct_;
  MatrixXcd resolvent = -triangle_;
  resolvent.diagonal().array() += point;
  return output_ * resolvent.triangularView<Eigen::Upper>().solve(input_) + direct_;
}

MatrixXcd FrequencyResponse::at_frequency(double angular_frequency) const {
  return at(border_point(sample_period_, angular_frequency));
}

Eigen::VectorXcd poles(const StateSpace& system) {
  if (system.order() == 0) return Eigen::VectorXcd(0);
  const Eigen::EigenSolver<MatrixXd> solver(system.A, false);
  if (solver.info() != Eigen::Success) {
    throw std::runtime_error("state space: eigenvalues of A were not found; is A finite?");
  }
  return solver.eigenvalues();
}

StateSpace discretise_zero_order_hold(const StateSpace& continuous, double sample_period) {
  require_fit(!continuous.is_sampled(), "the system is sampled already");
  require_period(sample_period);
  StateSpace sampled = checked(continuous);
  sampled.sample_period = sample_period;
  const Index n = sampled.order(), inputs = sampled.inputs();
  if (n == 0) return sampled;

  // The held input is a constant state: exp([A B; 0 0] T) = [A_d B_d; 0 I].
  const MatrixXd generator =
      blocks(sampled.A, sampled.B, MatrixXd::Zero(inputs, n), MatrixXd::Zero(inputs, inputs));
  const MatrixXd flow = (generator * sample_period).exp();
  sampled.A = flow.topLeftCorner(n, n);
  sampled.B = flow.topRightCorner(n, inputs);
  return sampled;
}

StateSpace series(const StateSpace& first, const StateSpace& second) {
  require_same_period(first, second);
  require_fit(first.outputs() == second.inputs(), "in series, outputs must meet as many inputs");
  return {
      blocks(first.A, MatrixXd::Zero(first.order(), second.order()), second.B * first.C, second.A),
      above(first.B, second.B * first.D), beside(second.D * first.C, second.C), second.D * first.D,
      first.sample_period};
}

StateSpace parallel(const StateSpace& a, const StateSpace& b) {
  require_same_period(a, b);
  require_fit(a.inputs() == b.inputs() && a.outputs() == b.outputs(),
              "in parallel, inputs and outputs must be as many");
  return {
      blocks(a.A, MatrixXd::Zero(a.order(), b.order()), MatrixXd::Zero(b.order(), a.order()), b.A),
      above(a.B, b.B), beside(a.C, b.C), a.D + b.D, a.sample_period};
}

StateSpace feedback(const StateSpace& forward, const StateSpace& back) {
  require_same_period(forward, back);
  require_fit(forward.outputs() == back.inputs() && back.outputs() == forward.inputs(),
              "in a loop, each system's outputs must meet the other's inputs");
  const StateSpace &f = forward, &h = back;
  const MatrixXd loop = MatrixXd::Identity(f.inputs(), f.inputs()) + h.D * f.D;
  const Eigen::FullPivLU<MatrixXd> lu(loop);
  require_fit(lu.isInvertible(), "the loop has no solution; put a delay into it");

  // e = u - back(y) in terms of both states and u; the rest follows from it.
  const MatrixXd inverse = lu.inverse();
  const MatrixXd from_f = -inverse * h.D * f.C;
  const MatrixXd from_h = -inverse * h.C;
  const MatrixXd y_f = f.C + f.D * from_f;
  const MatrixXd y_h = f.D * from_h;
  return {blocks(f.A + f.B * from_f, f.B * from_h, h.B * y_f, h.A + h.B * y_h),
          above(f.B * inverse, h.B * f.D * inverse), beside(y_f, y_h), f.D * inverse,
          f.sample_period};
}

}  // namespace reckon::bench
