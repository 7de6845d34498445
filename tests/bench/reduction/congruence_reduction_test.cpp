// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/bench/reduction/congruence_reduction.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <cmath>
#include <random>

#include "reckon/tests/bench/support/membranes.hpp"
#include "reckon/tests/support/soak.hpp"

namespace reckon::bench {
namespace {

using Eigen::Index;
using Eigen::MatrixXcd;
using Eigen::MatrixXd;
using test::make_chain;
using test::make_membrane;
using ::testing::HasSubstr;

// By dense LU, from the definition.
MatrixXcd body_compliance(const SecondOrderSystem& body, double w) {
  const std::complex<double> s(0.0, w);
  const MatrixXcd dynamic = MatrixXd(body.K).cast<std::complex<double>>() + s * MatrixXd(body.D) +
                            s * s * MatrixXd(body.M);
  return body.B.transpose() * dynamic.partialPivLu().solve(MatrixXcd(body.B));
}

std::complex<double> felt(std::complex<double> compliance, double stiffness) {
  return 1.0 / (1.0 / stiffness + compliance);
}

// Largest difference of the contact force over all frequencies, relative to the largest force.
double relative_error(const SecondOrderSystem& body, const ModalForceModel& model,
                      double stiffness) {
  double error = 0.0, most = 0.0;
  for (double w = 0.5; w < 6e3; w *= 1.08) {
    const auto full = felt(body_compliance(body, w)(0, 0), stiffness);
    error = std::max(error, std::abs(full - felt(compliance(model, w)(0, 0), stiffness)));
    most = std::max(most, std::abs(full));
  }
  return error / most;
}

MatrixXd static_answer(const SecondOrderSystem& body) {
  return body.B.transpose() * MatrixXd(body.K).ldlt().solve(body.B);
}

TEST(CongruenceReduction, IsExactForStaticForces) {
  test::Membrane three_points;
  three_points.side = 6;
  three_points.touched = {3, 14, 35};
  for (const Basis basis : {Basis::krylov, Basis::snapshots, Basis::modes}) {
    for (const auto& body : {make_membrane({}), make_membrane(three_points),
                             make_chain(20, 0.01, 900.0, 300.0, 1.0, 1e-4)}) {
      const BodyReduction reduction(body, basis);
      const MatrixXd expected = static_answer(body);
      for (int modes = 0; modes <= reduction.most_modes(); ++modes) {
        const MatrixXd got = static_compliance(reduction.model(modes));
        EXPECT_LE((got - expected).norm(), 1e-9 * expected.norm()) << modes;
      }
    }
  }
}

TEST(CongruenceReduction, IsWithinFivePerCentWithSixteenModes) {
  for (const int side : {6, 8, 14}) {
    for (const double bed : {4.0, 40.0}) {
      for (const double spring_damping : {2e-4, 2e-3}) {
        // In the gate, of the largest membranes only the softest, least damped one.
        if (!test::soaks() && side > 8 && (bed > 4.0 || spring_damping > 2e-4)) continue;
        test::Membrane of;
        of.side = side;
        of.bed = bed;
        of.spring_damping = spring_damping;
        const SecondOrderSystem body = make_membrane(of);
        const BodyReduction reduction(body);
        const int modes = std::min(16, reduction.most_modes());
        EXPECT_LE(relative_error(body, reduction.model(modes), 900.0), 0.05)
            << side << " nodes, bed " << bed << ", damping " << spring_damping;
      }
    }
  }
}

// Random springs, dampers and masses in a random network, fixed at one node.
SecondOrderSystem random_body(std::mt19937& random, int nodes) {
  std::uniform_real_distribution<double> unit(0, 1);
  std::uniform_int_distribution<int> node(0, nodes - 1);
  std::vector<Eigen::Triplet<double>> masses, springs{{0, 0, 500.0}}, dampers;
  for (int i = 0; i < nodes; ++i) {
    masses.emplace_back(i, i, 1e-3 + 0.05 * unit(random));
    if (i > 0) test::add_spring(springs, i - 1, i, 100 + 2000 * unit(random));
    const int other = node(random);
    if (other != i) test::add_spring(springs, i, other, 800 * unit(random));
    test::add_spring(dampers, i, (i + 1) % nodes, 0.5 * unit(random));
  }
  SecondOrderSystem body;
  for (SparseMatrix* matrix : {&body.M, &body.D, &body.K}) matrix->resize(nodes, nodes);
  body.M.setFromTriplets(masses.begin(), masses.end());
  body.K.setFromTriplets(springs.begin(), springs.end());
  body.D.setFromTriplets(dampers.begin(), dampers.end());
  body.B = MatrixXd::Zero(nodes, 2);
  body.B(nodes - 1, 0) = body.B(nodes / 2, 1) = 1.0;
  return body;
}

TEST(CongruenceReduction, IsPassiveForAnyBasis) {
  std::mt19937 random(3);
  std::normal_distribution<double> normal;
  for (int round = 0; round < 60; ++round) {
    const SecondOrderSystem body = random_body(random, 6 + round % 20);
    const MatrixXd arbitrary =
        MatrixXd::NullaryExpr(body.size(), 5, [&] { return normal(random); });
    for (const BodyReduction& reduction :
         {BodyReduction(body, arbitrary), BodyReduction(body, Basis::krylov),
          BodyReduction(body, Basis::snapshots), BodyReduction(body, Basis::modes)}) {
      for (int modes = 0; modes <= reduction.most_modes(); ++modes) {
        const ModalForceModel model = reduction.model(modes);
        EXPECT_EQ(refusal(model), "");
        for (double w = 1.0; w < 1e5; w *= 3.0) {
          // Force to velocity: its real part is the power absorbed at the points.
          const MatrixXcd mobility = std::complex<double>(0.0, w) * compliance(model, w);
          const Eigen::SelfAdjointEigenSolver<MatrixXcd> taken(mobility + mobility.adjoint());
          EXPECT_GE(taken.eigenvalues()[0], -1e-9 * mobility.norm());
        }
      }
    }
  }
}

TEST(CongruenceReduction, KeepsTheMassOfAFreeBody) {
  const SecondOrderSystem body = make_chain(12, 0.02, 4000.0, 0.0, 0.0, 2e-4);
  for (const Basis basis : {Basis::krylov, Basis::snapshots, Basis::modes}) {
    const BodyReduction reduction(body, basis);
    ASSERT_EQ(reduction.least_modes(), 1);
    for (int modes = 1; modes <= reduction.most_modes(); ++modes) {
      const ModalForceModel model = reduction.model(modes);
      EXPECT_EQ(model.omega[0], 0.0);
      const double w = 0.05;
      // 12 x 20 g, free.
      EXPECT_NEAR(std::abs(compliance(model, w)(0, 0)) * w * w * 0.24, 1.0, 1e-5);
    }
    EXPECT_LE(relative_error(body, reduction.model(reduction.most_modes()), 900.0), 1e-4);
    EXPECT_LE(relative_error(body, reduction.model(1), 900.0), 2.0);
  }
}

TEST(CongruenceReduction, SnapshotsOfARunServeAsBasis) {
  const SecondOrderSystem body = make_chain(30, 0.01, 2000.0, 400.0, 5.0, 1e-3);
  // Deflections at ten frequencies.
  MatrixXd snapshots(body.size(), 20);
  for (Index k = 0; k < 10; ++k) {
    const double w = 3.0 * std::pow(1.8, static_cast<double>(k));
    const std::complex<double> s(0.0, w);
    const MatrixXcd dynamic = MatrixXd(body.K).cast<std::complex<double>>() + s * MatrixXd(body.D) +
                              s * s * MatrixXd(body.M);
    const MatrixXcd shape = dynamic.partialPivLu().solve(MatrixXcd(body.B));
    snapshots.col(2 * k) = shape.real();
    snapshots.col(2 * k + 1) = shape.imag();
  }
  const BodyReduction reduction(body, snapshots);
  const double without = relative_error(body, reduction.model(0), 900.0);
  EXPECT_LE(relative_error(body, reduction.model(reduction.most_modes()), 900.0), 0.1 * without);
  EXPECT_THROW(BodyReduction(body, MatrixXd::Ones(3, 3)), std::invalid_argument);
}

std::string told(SecondOrderSystem body) {
  try {
    (void)checked(std::move(body));
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "";
}

TEST(SecondOrderSystem, ReportsTheCauseOfANonPassiveBody) {
  const SecondOrderSystem good = make_chain(6, 0.02, 400.0, 100.0, 1.0, 1e-3);
  EXPECT_EQ(told(good), "");
  SecondOrderSystem bad = good;
  bad.M.coeffRef(4, 4) = 0.0;
  EXPECT_THAT(told(bad), HasSubstr("M is not > 0: pivot"));
  EXPECT_THAT(told(bad), HasSubstr("at coordinate 4"));
  bad = good;
  bad.D.coeffRef(2, 2) -= 5.0;
  EXPECT_THAT(told(bad), HasSubstr("D is not >= 0"));
  EXPECT_THAT(told(bad), HasSubstr("give dampers >= 0"));
  bad = good;
  bad.K.coeffRef(0, 0) -= 150.0;
  EXPECT_THAT(told(bad), HasSubstr("K is not >= 0"));
  EXPECT_THAT(told(bad), HasSubstr("buckled"));
  bad = good;
  bad.K.coeffRef(1, 2) += 1.0;
  EXPECT_THAT(told(bad), HasSubstr("K is not symmetric"));
  bad = good;
  bad.K.coeffRef(1, 1) = std::nan("");
  EXPECT_THAT(told(bad), HasSubstr("K(1, 1) is nan"));
  bad = good;
  bad.B = MatrixXd::Ones(6, 2);
  EXPECT_THAT(told(bad), HasSubstr("depend on each other"));
  bad.B = MatrixXd::Ones(5, 1);
  EXPECT_THAT(told(bad), HasSubstr("B is 5 x 1"));
}

TEST(ModalForceModel, ForceAndMotionFormsAreEquivalent) {
  const ModalForceModel model = BodyReduction(make_membrane({}), Basis::snapshots).model(8);
  const StateSpace motion = displacement_of_force(model);
  const StateSpace force = force_of_displacement(model, 900.0);
  for (double w = 0.1; w < 1e4; w *= 2.0) {
    const std::complex<double> s(0.0, w), C = compliance(model, w)(0, 0);
    EXPECT_LE(std::abs(evaluate(motion, s)(0, 0) - C), 1e-9 * std::abs(C));
    EXPECT_LE(std::abs(evaluate(force, s)(0, 0) - felt(C, 900.0)), 1e-7 * 900.0);
  }
  // A steady contact: the force of a given motion, applied as input, gives that motion.
  const double given = 4e-3, f = given * evaluate(force, 0.0)(0, 0).real();
  EXPECT_NEAR(f / 900.0 + f * evaluate(motion, 0.0)(0, 0).real(), given, 1e-9);
  EXPECT_THROW((void)force_of_displacement(model, 0.0), std::invalid_argument);
}

TEST(ModalForceModel, StoresNoMoreThanItsInput) {
  const ModalForceModel model =
      BodyReduction(make_chain(9, 0.02, 900.0, 200.0, 0.5, 1e-4), Basis::krylov).model(5);
  const double dt = 1e-4;
  const StateSpace step = discretise_zero_order_hold(displacement_of_force(model), dt);
  std::mt19937 random(9);
  std::normal_distribution<double> normal;
  Eigen::VectorXd state = Eigen::VectorXd::Zero(10);
  double given = 0.0, force = 0.0;
  for (int k = 0; k < 20000; ++k) {
    // A step of the force gives energy to the residual term at once.
    const double next = 0.9 * force + normal(random);
    given += 0.5 * (next + force) * model.rest(0, 0) * (next - force);
    force = next;
    const Eigen::VectorXd before = state;
    state = step.A * state + step.B * force;
    given += force * (model.shape.transpose() * (state - before).head(5))(0);
    const double stored =
        stored_energy(model, state.head(5), state.tail(5), Eigen::VectorXd::Constant(1, force));
    ASSERT_LE(stored, given * (1.0 + 1e-9) + 1e-12) << "step " << k;
  }
}

TEST(ModalForceModel, RefusesSignsThatMakeEnergy) {
  const ModalForceModel good = BodyReduction(make_membrane({})).model(4);
  EXPECT_EQ(refusal(good), "");
  ModalForceModel bad = good;
  bad.damping[2] = -1e-3;
  EXPECT_THAT(refusal(bad), HasSubstr("damping of mode 2 is -0.001"));
  bad = good;
  bad.omega[1] = std::nan("");
  EXPECT_THAT(refusal(bad), HasSubstr("omega of mode 1"));
  bad = good;
  bad.rest(0, 0) = -1e-3;
  EXPECT_THAT(refusal(bad), HasSubstr("static rest is -0.001"));
  bad = good;
  bad.shape.resize(3, 1);
  EXPECT_THAT(refusal(bad), HasSubstr("sizes do not fit"));
}

}  // namespace
}  // namespace reckon::bench
