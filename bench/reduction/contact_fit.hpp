// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Coefficients of the simple contact, fitted to recent results of the full model (thesis 5.7):
// least squares within the limits of the device, with an expiry. Geometry is never fitted: depths
// are along the normal of a known surface.
//
//   const ContactFit fit = fit_contact(samples, {.device_damping = 1.0, .sample_period = 1e-3});
//   if (fit.worth_sending()) expiring = ExpiringContact(fit, now, fallback);
#pragma once

#include <span>
#include <string>

namespace reckon::bench {

/// One sample of a contact.
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

/// Limits of a fit, and the parameters of its assessment.
struct FitLimits {
  double device_damping = 1.0;  ///< guaranteed [N s/m], > 0
  double sample_period = 1e-3;  ///< of the servo [s], > 0
  double memory = 0.1;          ///< time in which a sample's weight falls by the factor e [s], > 0
  double horizon = 0.1;         ///< time for which the fit is to be used [s], > 0
  double reach = 1.5;           ///< greatest depth of use over the deepest sample's, >= 1
};

struct ContactFit {
  ContactCoefficients contact;
  double error = 0.0;       ///< rms over the window, weighted [N]
  double hold_error = 0.0;  ///< rms error of holding each force for the horizon [N], 0: unknown
  double deepest = 0.0;     ///< end of the fit [m]
  double lasts = 0.0;       ///< [s] from the last sample
  std::string binding;      ///< the binding limit; empty if there is none

  /// Whether the fit is better than holding the last force. False too if the window is shorter than
  /// the time of use.
  [[nodiscard]] bool worth_sending() const noexcept { return error < hold_error; }
};

/// Share of the passive limit 2 (b - B)/T up to which stiffness is used.
inline constexpr double kStiffnessShare = 0.95;

/// Least squares over the samples inside. k1, k3, b >= 0, b is at most half the device's damping,
/// and the slope at `deepest` is at most kStiffnessShare of the passive limit. The minimum under
/// these limits is exact, because all sets of binding limits are tried. So the fit is passive on
/// that device for any samples.
/// @param samples in order of time; at least 4 inside
/// @throws std::invalid_argument for too few samples, one that is not finite or out of order, or
/// limits out of range. Cost: O(samples), then 26 systems of six unknowns.
[[nodiscard]] ContactFit fit_contact(std::span<const ContactSample> samples,
                                     const FitLimits& limits);

/// A fit until it expires, then the fallback. Plain data.
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

}  // namespace reckon::bench
