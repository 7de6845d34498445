// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The springs of all remote hands at a device, as one force.
#pragma once

#include <span>

#include "reckon/haptics/contact/guest_share.hpp"
#include "reckon/haptics/contact/remote_contact.hpp"
#include "reckon/haptics/contact/tool.hpp"
#include "reckon/haptics/exchange/servo_tally.hpp"
#include "reckon/haptics/passivity/energy_port.hpp"

namespace reckon::haptics {

/// The port's capacity for hands, after the walls.
struct PortMeans {
  double spare = 0.0;  ///< [N/m], at the first probe
  double level = 0.0;  ///< [J]
};

/// At the first probe of a device with `axes` axes, 3 or 6. Servo thread.
template <int axes>
class HandSprings {
 public:
  using Load = PortLoadOf<axes>;

  /// Adds springs and dampers of the touched hands to `sum`. Guests get the rest.
  void load(std::span<RemoteContact* const> hands, const PortMeans& means, const ToolOf<axes>& tool,
            const StepContext& step, ServoTally& tally, Load& sum) noexcept;
  /// Softens all springs by the same factor if they are together stiffer than the device can
  /// render. They would buzz at the expense of the ledger.
  /// @param most stiffness that the device can render after the walls
  void soften(double most, const ToolOf<axes>& tool, const StepContext& step, ServoTally& tally,
              Load& sum) noexcept;

  [[nodiscard]] const GuestShare& guests() const noexcept { return guests_; }
  /// Share of the springs of all hands that the device can render.
  [[nodiscard]] double crowd_share() const noexcept { return crowd_share_; }

 private:
  GuestShare guests_;
  double crowd_share_ = 1.0;
};

}  // namespace reckon::haptics
