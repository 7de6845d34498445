// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Coefficients of the simple contact, tuned to what the full model has said of late (thesis 5.7):
// least squares under what the device may render, with an expiry. Geometry is never fitted: depths
// are along the normal of a surface that is known.
//
//   const ContactFit fit = fit_contact(samples, {.device_damping = 1.0, .sample_period = 1e-3});
//   if (fit.worth_sending()) expiring = ExpiringContact(fit, now, fallback);
#pragma once

#include <span>
#include <string>

namespace reckon::haptics {

/// One moment of a contact.
struct ContactSample {
  double time = 0.0;   ///< [s]
  double depth = 0.0;  ///< [m], > 0 inside
  double rate = 0.0;   ///< of the depth [m/s]
  double force = 0.0;  ///< against the depth, of the full model [N]
};

/// F = k1 d + k3 d^3 + b d' inside, 0 outside and never a pull.
struct ContactCoefficients {
  double k1 = 0.0;       ///< [N/m]
  double k3 = 0.0;       ///< [N/m^3]
  double damping = 0.0;  ///< [N s/m]

  [[nodiscard]] double force(double depth, double rate) const noexcept;
  /// Slope of the force over depth [N/m].
  [[nodiscard]] double stiffness(double depth) const noexcept;
};

/// What a fit must keep to, and what it is judged by.
struct FitLimits {
  double device_damping = 1.0;  ///< that one is sure of [N s/m], > 0
  double sample_period = 1e-3;  ///< of the servo [s], > 0
  double memory = 0.1;          ///< time over which a sample's weight falls by e [s], > 0
  double horizon = 0.1;         ///< for which the fit is to be used [s], > 0
  double reach = 1.5;           ///< how much deeper than the deepest sample it may be used, >= 1
};

struct ContactFit {
  ContactCoefficients contact;
  double error = 0.0;       ///< rms over the window, weighted [N]
  double hold_error = 0.0;  ///< rms of holding each force for the horizon [N], 0: not known
  double deepest = 0.0;     ///< where the fit ends [m]
  double lasts = 0.0;       ///< [s] from the last sample
  std::string binding;      ///< which limit binds, empty where none does

  /// A fit that is no better than holding the last force is not, nor one over a shorter window
  /// than it is to be used for.
  [[nodiscard]] bool worth_sending() const noexcept { return error < hold_error; }
};

/// The share of the passive limit 2 (b - B)/T up to which stiffness is used.
inline constexpr double kStiffnessShare = 0.95;

/// Least squares over the samples inside; k1, k3, b >= 0, b at most half the device's damping, and
/// slope at `deepest` at most kStiffnessShare of the passive limit: the exact least under these, by
/// trying which of them bind. So the fit is passive on that device whatever the samples were.
/// @param samples in order of time; at least 4 inside
/// @throws std::invalid_argument for too few samples, one not finite or out of order, or limits out
/// of range. Cost: O(samples), then 26 systems of six unknowns.
[[nodiscard]] ContactFit fit_contact(std::span<const ContactSample> samples,
                                     const FitLimits& limits);

/// A fit while it lasts, then what one fell back from. Plain data.
class ExpiringContact {
 public:
  /// @param from time of the last sample [s]
  ExpiringContact(const ContactFit& fit, double from, const ContactCoefficients& fallback) noexcept
      : fit_(fit.contact),
        fallback_(fallback),
        deepest_(fit.deepest),
        from_(from),
        until_(from + fit.lasts) {}

  [[nodiscard]] bool is_valid(double time, double depth) const noexcept {
    return time >= from_ && time <= until_ && depth <= deepest_;
  }
  [[nodiscard]] const ContactCoefficients& at(double time, double depth) const noexcept {
    return is_valid(time, depth) ? fit_ : fallback_;
  }

 private:
  ContactCoefficients fit_, fallback_;
  double deepest_, from_, until_;
};

}  // namespace reckon::haptics
