// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Reads the numerical oracles and makes random states, for the tests of this folder.
#pragma once

#include <Eigen/Geometry>
#include <cstdlib>
#include <fstream>
#include <nlohmann/json.hpp>
#include <random>
#include <string>

#include "reckon/deadreckon/motion/kinematic_state.hpp"
#include "reckon/tests/support/reference_data.hpp"

namespace reckon::deadreckon::test {

inline nlohmann::json oracle(const std::string& file) {
  std::ifstream in(reckon::test::reference_data() / "oracles" / file);
  return nlohmann::json::parse(in);
}

/// A bare number, or one in a string with more digits than a double has.
inline double number(const nlohmann::json& j) {
  return j.is_string() ? std::strtod(j.get<std::string>().c_str(), nullptr) : j.get<double>();
}

inline Eigen::Vector3d vector(const nlohmann::json& j) {
  return {number(j.at(0)), number(j.at(1)), number(j.at(2))};
}

/// [w, x, y, z].
inline Eigen::Quaterniond quaternion(const nlohmann::json& j) {
  return {number(j.at(0)), number(j.at(1)), number(j.at(2)), number(j.at(3))};
}

/// Largest component difference, for either sign of q.
inline double difference(const Eigen::Quaterniond& a, const Eigen::Quaterniond& b) {
  const double plus = (a.coeffs() - b.coeffs()).lpNorm<Eigen::Infinity>();
  const double minus = (a.coeffs() + b.coeffs()).lpNorm<Eigen::Infinity>();
  return std::min(plus, minus);
}

/// Repeatable random vectors, rotations and states.
class Random {
 public:
  explicit Random(unsigned seed) : engine_(seed) {}

  double real(double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(engine_);
  }
  Eigen::Vector3d vector(double size) {
    return {real(-size, size), real(-size, size), real(-size, size)};
  }
  Eigen::Vector3d direction() {
    Eigen::Vector3d v = vector(1);
    while (v.norm() < 0.1) v = vector(1);
    return v.normalized();
  }
  Eigen::Quaterniond rotation() {
    return Eigen::Quaterniond(Eigen::AngleAxisd(real(-3.1, 3.1), direction()));
  }
  Pose pose() { return {vector(10), rotation(), vector(3), vector(3)}; }
  KinematicState state(pdu::DeadReckoningAlgorithm algorithm, double rate) {
    return {algorithm, vector(1000), rotation(), vector(100), vector(20), rate * direction()};
  }

 private:
  std::mt19937 engine_;
};

}  // namespace reckon::deadreckon::test
