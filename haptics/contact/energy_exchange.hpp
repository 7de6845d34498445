// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Energy exchange between the port of a device and the owners of the hands that it touches.
#pragma once

#include <cstddef>
#include <span>

#include "reckon/haptics/contact/remote_contact.hpp"
#include "reckon/haptics/passivity/energy_ledger.hpp"

namespace reckon::haptics {

/// Greatest loan of one port [J]. A higher value allows larger restoring forces (120 mJ: 7.4 N to a
/// grip of 300 N/m that sank in). A lower value adds less energy that nobody put in.
inline constexpr double kGreatestLoan = 0.12;
/// Part of that loan for hands, borrowing power [W] for hands and for walls, and greatest speed of
/// the own hand [m/s] at which a loan for hands grows. Two hands that borrow more, sooner or in
/// motion ring, and pay for it with the loan.
inline constexpr double kGreatestHandLoan = 0.03;
inline constexpr double kHandLoanPower = 0.01;
inline constexpr double kWallLoanPower = 0.05;
inline constexpr double kCalm = 0.02;

/// Energy demand on the port of a device in a step.
struct PortNeeds {
  double spare = 0.0;    ///< [N/m], see first_tier()
  double walls = 0.0;    ///< [J], see StaticContact::lacks()
  double speed = 0.0;    ///< [m/s], of the hand
  bool at_rest = false;  ///< the hand has been at rest and short of energy for a while
  double dt = 0.0;       ///< [s]
};

/// One servo step of the exchange: repays or takes a loan, answers requests and requests missing
/// energy. A request that we cannot meet is passed on to the other neighbours, so that energy
/// reaches the end of a row of hands.
///
/// A loan is energy that nobody put in. Three kinds of contact get one: a contact that began
/// inside, a contact whose force was cut to zero, and a contact that is short of energy for long
/// while the hand is at rest in contact; none after a separation. There the port may be empty with
/// nobody left to fill it: hands that start overlapping, an outage in contact, a late discovery, a
/// start inside a wall, a released switch, a trip, a row of hands that was pressed quickly. The
/// loan is repaid before anything is given, even if the contact ends.
/// @return number of engaged contacts.
std::size_t exchange_energy(std::span<RemoteContact* const> near, EnergyLedger& ledger,
                            const PortNeeds& needs) noexcept;

}  // namespace reckon::haptics
