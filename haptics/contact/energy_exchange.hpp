// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Energy between the port of a device and the owners of the hands that it touches.
#pragma once

#include <cstddef>
#include <span>

#include "reckon/haptics/contact/remote_contact.hpp"
#include "reckon/haptics/passivity/energy_port.hpp"

namespace reckon::haptics {

/// Most that one port may owe [J], and how fast it may borrow [W]. Higher gets larger overlaps
/// going (12 mJ: 20 mm between grips of 300 N/m), lower is less that nobody put in.
inline constexpr double kGreatestLoan = 0.012;
inline constexpr double kLoanPower = 0.010;

/// One servo step of it: repays or takes a loan, answers those who asked, asks for what is short.
/// A need of one neighbour is passed on to the others, as far as we cannot meet it, so that energy
/// reaches the end of a row of hands.
///
/// A loan is energy that nobody put in. Only a contact that began inside gets one, for there both
/// ports may be empty with nobody left who could fill them: hands that start overlapping, an outage
/// in contact, a late discovery. It is paid back before anything is given, whatever becomes of the
/// contact. @param spare see first_tier()  @param dt [s]  @return contacts engaged.
std::size_t exchange_energy(std::span<RemoteContact* const> near, EnergyPort& port, double spare,
                            double dt) noexcept;

}  // namespace reckon::haptics
