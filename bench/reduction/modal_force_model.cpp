// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/bench/reduction/modal_force_model.hpp"

#include <Eigen/LU>
#include <cmath>
#include <stdexcept>

#include "reckon/bench/reduction/decompositions.hpp"

namespace reckon::bench {
namespace {

using Eigen::Index;
using Eigen::MatrixXcd;
using Eigen::MatrixXd;

constexpr double kModalRounding = 1e-9;  // of the largest entry of `rest`

std::string refused(const std::string& what, double number, const char* remedy) {
  return "modal force model: " + what + " is " + std::to_string(number) + "; " + remedy;
}

// Names the first number of a list that is not >= 0.
std::string refused_below_zero(const ModalForceModel::PerMode& numbers, const std::string& name) {
  for (Index i = 0; i < numbers.size(); ++i) {
    if (!(numbers[i] >= 0.0) || !std::isfinite(numbers[i])) {
      return refused(name + " of mode " + std::to_string(i), numbers[i],
                     "it makes energy; give a finite number >= 0");
    }
  }
  return {};
}

std::string refused_rest(const ModalForceModel& model) {
  const MatrixXd rest = model.rest;
  const double most = rest.cwiseAbs().maxCoeff();
  const double skew = (rest - rest.transpose()).cwiseAbs().maxCoeff();
  if (skew > kModalRounding * most) {
    return refused("asymmetry of the static rest", skew, "give a symmetric one");
  }
  const double least = symmetric_parts(rest).values[0];
  if (least < -kModalRounding * most) {
    return refused("least eigenvalue of the static rest", least,
                   "a spring there pushes away; give one >= 0");
  }
  return {};
}

// omega^2 - w^2 + j w damping, for each mode.
Eigen::VectorXcd dynamic_stiffness(const ModalForceModel& model, double w) {
  Eigen::VectorXcd stiffness(model.modes());
  for (int i = 0; i < model.modes(); ++i) {
    stiffness[i] = {model.omega[i] * model.omega[i] - w * w, w * model.damping[i]};
  }
  return stiffness;
}

// Rows and columns of q, then of q'.
StateSpace oscillators(const ModalForceModel& model) {
  const Index r = model.modes(), p = model.points();
  StateSpace system;
  system.A = MatrixXd::Zero(2 * r, 2 * r);
  system.A.topRightCorner(r, r).setIdentity();
  system.A.bottomLeftCorner(r, r).diagonal() = -model.omega.cwiseAbs2();
  system.A.bottomRightCorner(r, r).diagonal() = -model.damping;
  system.B = MatrixXd::Zero(2 * r, p);
  system.B.bottomRows(r) = model.shape;
  system.C = MatrixXd::Zero(p, 2 * r);
  system.C.leftCols(r) = model.shape.transpose();
  system.D = model.rest;
  return system;
}

}  // namespace

double damping_ratio(const ModalForceModel& model, int mode) {
  return model.omega[mode] > 0.0 ? model.damping[mode] / (2.0 * model.omega[mode]) : 0.0;
}

std::string refusal(const ModalForceModel& model) {
  const int r = model.modes(), p = model.points();
  if (p == 0 || model.rest.cols() != p || model.damping.size() != r || model.shape.rows() != r ||
      model.shape.cols() != p) {
    return "modal force model: sizes do not fit " + std::to_string(r) + " modes at " +
           std::to_string(p) + " points; give each mode a damping and a row of shapes";
  }
  if (!model.shape.allFinite() || !model.rest.allFinite()) {
    return "modal force model: a shape or the static rest is not finite; give numbers";
  }
  if (std::string reason = refused_below_zero(model.omega, "omega"); !reason.empty()) return reason;
  if (std::string reason = refused_below_zero(model.damping, "damping"); !reason.empty())
    return reason;
  return refused_rest(model);
}

MatrixXcd compliance(const ModalForceModel& model, double angular_frequency) {
  const Eigen::VectorXcd inverse = dynamic_stiffness(model, angular_frequency).cwiseInverse();
  const MatrixXcd shape = model.shape.cast<std::complex<double>>();
  MatrixXcd sum = shape.transpose() * inverse.asDiagonal() * shape;
  sum += model.rest.cast<std::complex<double>>();
  return sum;
}

MatrixXd static_compliance(const ModalForceModel& model) {
  const Eigen::VectorXd inverse = model.omega.cwiseAbs2().cwiseInverse();
  MatrixXd sum = model.shape.transpose() * inverse.asDiagonal() * model.shape;
  return sum + model.rest;
}

double stored_energy(const ModalForceModel& model, const Eigen::VectorXd& q,
                     const Eigen::VectorXd& rate, const Eigen::VectorXd& force) {
  const double modes = rate.squaredNorm() + model.omega.cwiseProduct(q).squaredNorm();
  return 0.5 * modes + 0.5 * force.dot(model.rest * force);
}

StateSpace displacement_of_force(const ModalForceModel& model) { return oscillators(model); }

StateSpace force_of_displacement(const ModalForceModel& model, double stiffness) {
  if (!(stiffness > 0.0) || !std::isfinite(stiffness)) {
    throw std::invalid_argument("force_of_displacement: the contact's stiffness is " +
                                std::to_string(stiffness) + " N/m; give a number > 0");
  }
  // f = W (x - shape^T q), with W the contact's springs in series with `rest`.
  const Index r = model.modes(), p = model.points();
  const MatrixXd W = (MatrixXd::Identity(p, p) / stiffness + model.rest).inverse();
  StateSpace system = oscillators(model);
  const MatrixXd onto = model.shape * W;
  system.A.bottomLeftCorner(r, r) -= onto * model.shape.transpose();
  system.B.bottomRows(r) = onto;
  system.C.leftCols(r) = -onto.transpose();
  system.D = W;
  return system;
}

}  // namespace reckon::bench
