// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Cost and force error of hands in contact, for each kind of touch and each way of sending.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "reckon/bench/studies/contact/contact_measures.hpp"
#include "reckon/bench/studies/contact/contact_scenes.hpp"
#include "reckon/peer/network/impairment.hpp"

namespace reckon::bench {

/// Condition for sending: a force threshold, or a fixed rate.
struct ContactSending {
  double threshold = 0;  ///< [N]; 0: fixed rate
  double rate_hz = 0;

  [[nodiscard]] bool operator==(const ContactSending&) const = default;
};

/// For example "15 mN" or "50 Hz".
[[nodiscard]] std::string sending_text(const ContactSending& sending);

/// Default settings of studies.
inline constexpr std::array kContactSendings{ContactSending{0.01, 0}, ContactSending{0.015, 0},
                                             ContactSending{0.02, 0}, ContactSending{0.03, 0},
                                             ContactSending{0.05, 0}, ContactSending{0.1, 0},
                                             ContactSending{0.2, 0},  ContactSending{0, 50}};

struct ContactRow {
  std::string scene;
  ContactSending sending;
  std::size_t hands = 0;
  double asked = 0, shown = 0;  ///< [N/m], requested by the scene and possible on the devices
  double packets_per_s = 0, octets_per_s = 0, for_force_per_s = 0;
  ForceError from_shown, from_asked;
  std::optional<double> from_twin;   ///< [N] RMS; no value if the scene has a stone
  std::optional<double> first_peak;  ///< divided by the twin's
  std::optional<std::array<Response, 2>> stroke;
  double linger = 0;         ///< [s]
  double servo_step_ns = 0;  ///< median, including its simulated device
  bool beaten = false;       ///< another row of the scene has no more packets and no greater p99

  /// If not, there are no errors to report.
  [[nodiscard]] bool touched() const noexcept { return from_shown.samples > 0; }
  /// An Entity State and an Attribute PDU from each hand in every servo step, divided by the
  /// packets sent.
  [[nodiscard]] double times_fewer() const noexcept {
    return packets_per_s > 0 ? 1000 * static_cast<double>(hands) / packets_per_s : 0;
  }
};

/// Called with the runs done and the total; false ends the study.
using ContactProgress = std::function<bool(std::size_t done, std::size_t all)>;

/// A row for each scene and sending, scene by scene; fewer if `go_on` ended it. @param longest [s],
/// of a run. Deterministic except for servo_step_ns; runs on all cores.
[[nodiscard]] std::vector<ContactRow> run_contact_study(std::span<const ContactScene> scenes,
                                                        std::span<const ContactSending> sendings,
                                                        const peer::ImpairmentConfig& network,
                                                        double longest,
                                                        const ContactProgress& go_on = {});

}  // namespace reckon::bench
