// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/haptics/passivity/energy_ledger.hpp"

namespace reckon::haptics {
namespace {

constexpr double kMostGift = 0.9;  // of the present energy

}  // namespace

double EnergyLedger::credit(double energy) noexcept {
  const double room = std::max(0.0, kMostKept + booked_ - std::max(0.0, level_));
  const double fits = energy > 0 ? std::min(energy, room) : 0.0;
  level_ += fits;
  unearned_ += fits;
  return fits;
}

double EnergyLedger::credit(double energy, double seen) noexcept {
  const double fits = credit(std::min({energy, seen + unseen_, receivable()}));
  unseen_ -= std::max(0.0, fits - seen);
  receivable_ -= fits;
  return fits;
}

void EnergyLedger::give_back(double energy) noexcept {
  level_ -= energy;
  receivable_ = std::min(kReceivedAtOnce, receivable_ + energy);
}

double EnergyLedger::receivable() const noexcept {
  const double room = std::max(0.0, kReceivedAtOnce + booked_ - std::max(0.0, level_));
  return std::min(receivable_, room);
}

// Energy from others that no spring stores.
double EnergyLedger::waiting() const noexcept {
  return std::max(0.0, std::min(unearned_, level_) - booked_);
}

void EnergyLedger::wait(double dt) noexcept {
  unseen_ = std::min(kUnseen, unseen_ + kUnseenPower * dt);
  const double most = std::max(0.0, kReceivedAtOnce - waiting());
  receivable_ = std::min(most, receivable_ + received_power_ * dt);
  oscillations_.wait(dt);
}

double EnergyLedger::greatest_gift() const noexcept {
  return std::min(kMostGift * std::max(0.0, level_), spendable());
}

double EnergyLedger::give(double wanted) noexcept {
  const double gift = wanted > 0 ? std::min(greatest_gift(), wanted) : 0.0;
  level_ -= gift;
  receivable_ = std::min(kReceivedAtOnce, receivable_ + gift);
  return gift;
}

void EnergyLedger::borrow(double energy) noexcept {
  level_ += energy;
  owed_ += energy;
}

void EnergyLedger::pay_back(double energy) noexcept {
  const double paid = std::clamp(energy, 0.0, std::min(owed_, spendable()));
  level_ -= paid;
  owed_ -= paid;
}

}  // namespace reckon::haptics
