// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Elastic test bodies: a square membrane of masses and springs on its own bed of springs, and a
// chain, fixed or free.
#pragma once

#include <vector>

#include "reckon/bench/reduction/second_order_system.hpp"

namespace reckon::test {

struct Membrane {
  int side = 14;                    ///< nodes of each edge
  double mass = 2e-3;               ///< of a node [kg]
  double spring = 600.0;            ///< between neighbours [N/m]
  double bed = 4.0;                 ///< of each node to the ground [N/m]
  double mass_damping = 2.0;        ///< a [1/s] of D = a M + b K
  double spring_damping = 2e-4;     ///< b [s]
  std::vector<int> touched = {-1};  ///< pressed nodes; -1: beside the middle
};

inline bench::SecondOrderSystem assembled(int nodes, double mass,
                                          const std::vector<Eigen::Triplet<double>>& springs,
                                          const std::vector<int>& touched, double mass_damping,
                                          double spring_damping) {
  bench::SecondOrderSystem body;
  body.M.resize(nodes, nodes);
  body.M.setIdentity();
  body.M *= mass;
  body.K.resize(nodes, nodes);
  body.K.setFromTriplets(springs.begin(), springs.end());
  body.D = mass_damping * body.M + spring_damping * body.K;
  body.B = Eigen::MatrixXd::Zero(nodes, static_cast<Eigen::Index>(touched.size()));
  for (std::size_t i = 0; i < touched.size(); ++i) {
    body.B(touched[i], static_cast<Eigen::Index>(i)) = 1.0;
  }
  return body;
}

inline void add_spring(std::vector<Eigen::Triplet<double>>& springs, int a, int b,
                       double stiffness) {
  springs.emplace_back(a, a, stiffness);
  springs.emplace_back(b, b, stiffness);
  springs.emplace_back(a, b, -stiffness);
  springs.emplace_back(b, a, -stiffness);
}

inline bench::SecondOrderSystem make_membrane(const Membrane& of) {
  std::vector<Eigen::Triplet<double>> springs;
  for (int y = 0; y < of.side; ++y) {
    for (int x = 0; x < of.side; ++x) {
      const int node = y * of.side + x;
      springs.emplace_back(node, node, of.bed);
      if (x + 1 < of.side) add_spring(springs, node, node + 1, of.spring);
      if (y + 1 < of.side) add_spring(springs, node, node + of.side, of.spring);
    }
  }
  const int middle = (of.side / 2) * of.side + of.side / 2;
  std::vector<int> touched = of.touched;
  for (int& node : touched) node = node < 0 ? middle : node;
  return assembled(of.side * of.side, of.mass, springs, touched, of.mass_damping,
                   of.spring_damping);
}

/// Masses in a row; the first is attached to the ground by `ground` [N/m], 0: free. Pressed at the
/// last.
inline bench::SecondOrderSystem make_chain(int masses, double mass, double spring, double ground,
                                           double mass_damping, double spring_damping) {
  std::vector<Eigen::Triplet<double>> springs{{0, 0, ground}};
  for (int i = 0; i + 1 < masses; ++i) add_spring(springs, i, i + 1, spring);
  return assembled(masses, mass, springs, {masses - 1}, mass_damping, spring_damping);
}

}  // namespace reckon::test
