// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Plain DIS has no message by which programs agree on their IDs. To prevent two programs of one
// host from being the same entity, each holds its application number on this host while it runs.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "reckon/peer/network/descriptor.hpp"
#include "reckon/peer/network/link.hpp"

namespace reckon::peer {

/// Where an application number must be the only one of its kind.
struct ApplicationScope {
  GroupAddress group;
  std::uint8_t exercise = 1;
  std::uint16_t site = 1;
};

/// Holds an application number until its destruction; the kernel also frees the number when the
/// process is killed. If several processes request a number at the same time, one gets it. It works
/// between programs that use this library and share the network namespace; the user and the process
/// do not matter.
class ApplicationHold {
 public:
  /// Highest number of an application; higher numbers address all applications.
  static constexpr std::uint16_t kMost = 65534;

  /// Holds `wanted`, or if there is none, the smallest free number.
  /// @throws std::invalid_argument if `wanted` is 0 or above kMost, std::runtime_error with the
  /// holder and the remedy if it is taken or none is free, std::system_error
  ApplicationHold(const ApplicationScope& scope, std::optional<std::uint16_t> wanted);

  [[nodiscard]] std::uint16_t number() const noexcept { return number_; }
  /// If smaller numbers were taken: a sentence for the user with the number and the holder of
  /// number 1; else empty.
  [[nodiscard]] const std::string& report() const noexcept { return report_; }

 private:
  [[nodiscard]] bool hold(const ApplicationScope& scope, std::uint16_t number);

  Descriptor socket_;
  std::uint16_t number_ = 0;
  std::string report_;
};

}  // namespace reckon::peer
