// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Energy between the port of a device and the owners of the hands that it touches.
#pragma once

#include <cstddef>
#include <span>

#include "reckon/haptics/contact/remote_contact.hpp"
#include "reckon/haptics/passivity/energy_port.hpp"

namespace reckon::haptics {

/// Most that one port may owe [J]. Higher gives larger forces back (120 mJ: 7.4 N to a grip of
/// 300 N/m that sank in), lower is less that nobody put in.
inline constexpr double kGreatestLoan = 0.12;
/// How much of that for hands, how fast it may borrow [W] for hands and for walls, and for which
/// speed of its own hand at most [m/s] for others. Two hands that get more, sooner or in motion
/// ring, and pay for it with the loan.
inline constexpr double kGreatestHandLoan = 0.03;
inline constexpr double kHandLoanPower = 0.01;
inline constexpr double kWallLoanPower = 0.05;
inline constexpr double kCalm = 0.02;

/// What the port of a device has to answer for in a step.
struct PortNeeds {
  double spare = 0.0;    ///< [N/m], see first_tier()
  double walls = 0.0;    ///< [J], see StaticContact::lacks()
  double speed = 0.0;    ///< [m/s], of the hand
  bool at_rest = false;  ///< the hand is still, and energy has been short, for longer
  double dt = 0.0;       ///< [s]
};

/// One servo step of it: repays or takes a loan, answers those who asked, asks for what is short.
/// A need of one neighbour is passed on to the others, as far as we cannot meet it, so that energy
/// reaches the end of a row of hands.
///
/// A loan is energy that nobody put in. Only a contact that began inside gets one, one whose force
/// was cut to nothing, or one that is short for longer while the hand holds still, for there the
/// port may be empty with nobody left who could fill it: hands that start overlapping, an outage in
/// contact, a late discovery, a start inside a wall, a switch let go, a trip, a row of hands that
/// was pressed quickly. It is paid back before anything is given, whatever becomes of the
/// contact. @return contacts engaged.
std::size_t exchange_energy(std::span<RemoteContact* const> near, EnergyPort& port,
                            const PortNeeds& needs) noexcept;

}  // namespace reckon::haptics
