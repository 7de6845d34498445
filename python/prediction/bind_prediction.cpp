// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/python/prediction/bind_prediction.hpp"

#include <pybind11/numpy.h>

#include <limits>
#include <vector>

#include "reckon/deadreckon/motion/drm.hpp"
#include "reckon/deadreckon/motion/geocentric.hpp"
#include "reckon/deadreckon/wire_conversion.hpp"
#include "reckon/python/captures/arrays.hpp"

namespace reckon::python {
namespace py = pybind11;
namespace {

template <typename T>
using Column = py::array_t<T, py::array::c_style | py::array::forcecast>;

/// Columns of n states, in the order and the types of StateColumns; vectors are (n, 3).
struct Inputs {
  Column<double> location;
  Column<float> orientation, velocity, acceleration, angular_velocity;
  Column<std::uint8_t> algorithm;
  Column<std::uint32_t> appearance;
};

pdu::EntityState state_of(const Inputs& inputs, std::size_t row) {
  const auto vector = [row](const auto& column) {
    const auto* const at = column.data() + 3 * row;
    return pdu::Vector3Float{at[0], at[1], at[2]};
  };
  pdu::EntityState state;
  const double* const at = inputs.location.data() + 3 * row;
  state.location = {at[0], at[1], at[2]};
  const float* const angles = inputs.orientation.data() + 3 * row;
  state.orientation = {angles[0], angles[1], angles[2]};
  state.linear_velocity = vector(inputs.velocity);
  state.dead_reckoning.linear_acceleration = vector(inputs.acceleration);
  state.dead_reckoning.angular_velocity = vector(inputs.angular_velocity);
  state.dead_reckoning.algorithm =
      static_cast<pdu::DeadReckoningAlgorithm>(inputs.algorithm.data()[row]);
  state.appearance = inputs.appearance.data()[row];
  return state;
}

struct Outputs {
  std::vector<double> location, orientation, velocity;
};

void add(const deadreckon::Pose& pose, Outputs& out) {
  const deadreckon::Euler angles = deadreckon::euler_from_quaternion(pose.orientation);
  out.location.insert(out.location.end(),
                      {pose.position.x(), pose.position.y(), pose.position.z()});
  out.orientation.insert(out.orientation.end(), {angles.psi, angles.theta, angles.phi});
  out.velocity.insert(out.velocity.end(),
                      {pose.velocity.x(), pose.velocity.y(), pose.velocity.z()});
}

/// Fills in a result without a pose, for a state that receivers refuse.
void add_nothing(Outputs& out) {
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  for (std::vector<double>* column : {&out.location, &out.orientation, &out.velocity})
    column->insert(column->end(), 3, kNan);
}

/// Either one time for each state, or one state with any number of times.
Outputs predict(const Inputs& inputs, const double* tau, std::size_t times, std::size_t states) {
  Outputs out;
  for (std::vector<double>* column : {&out.location, &out.orientation, &out.velocity})
    column->reserve(3 * times);
  deadreckon::KinematicState state;
  auto error = deadreckon::ConversionError::none;
  for (std::size_t i = 0; i < times; ++i) {
    if (i < states) error = deadreckon::from_wire(state_of(inputs, i), state);
    if (error == deadreckon::ConversionError::none) {
      add(deadreckon::extrapolate(state, tau[i]), out);
    } else {
      add_nothing(out);
    }
  }
  return out;
}

py::tuple predict_columns(Column<double> location, Column<float> orientation,
                          Column<float> velocity, Column<float> acceleration,
                          Column<float> angular_velocity, Column<std::uint8_t> algorithm,
                          Column<std::uint32_t> appearance, const Column<double>& tau) {
  const auto states = static_cast<std::size_t>(algorithm.size());
  const auto times = static_cast<std::size_t>(tau.size());
  const auto is_of = [states](const auto& column) {
    return static_cast<std::size_t>(column.size()) == 3 * states;
  };
  if (!is_of(location) || !is_of(orientation) || !is_of(velocity) || !is_of(acceleration) ||
      !is_of(angular_velocity) || static_cast<std::size_t>(appearance.size()) != states)
    throw py::value_error(
        "the columns of the states differ in length: select the same rows of all");
  if (states != times && states != 1)
    throw py::value_error(std::to_string(times) + " times for " + std::to_string(states) +
                          " states: pass one time for each state, or one state");
  const Inputs inputs{std::move(location),     std::move(orientation),      std::move(velocity),
                      std::move(acceleration), std::move(angular_velocity), std::move(algorithm),
                      std::move(appearance)};
  Outputs out;
  {
    const py::gil_scoped_release others_run;
    out = predict(inputs, tau.data(), times, states);
  }
  return py::make_tuple(array_of(std::move(out.location), 3),
                        array_of(std::move(out.orientation), 3),
                        array_of(std::move(out.velocity), 3));
}

}  // namespace

void bind_prediction(py::module_& module) { module.def("predict_columns", predict_columns); }

}  // namespace reckon::python
