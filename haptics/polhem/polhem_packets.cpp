// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/haptics/polhem/polhem_packets.hpp"

#include <algorithm>

namespace reckon::haptics {
namespace {

constexpr int kPressed = 5'000;  // more than a gimbal can turn
constexpr int kButton = 10'000;
constexpr std::int16_t kSetCounts = 1;

std::uint16_t word_at(std::span<const std::uint8_t> octets, std::size_t word) noexcept {
  return static_cast<std::uint16_t>(octets[2 * word] | octets[2 * word + 1] << 8);
}

}  // namespace

std::optional<PolhemReport> polhem_report(PolhemForm form,
                                          std::span<const std::uint8_t> transfer) noexcept {
  if (transfer.size() != static_cast<std::size_t>(form)) return std::nullopt;
  const auto count = [&](std::size_t word) {
    return static_cast<std::int16_t>(word_at(transfer, word));
  };
  PolhemReport report;
  report.arm = {count(0), count(1), count(2)};
  report.info = word_at(transfer, transfer.size() / 2 - 1);
  if (form == PolhemForm::eight) return report;
  report.button = count(3) > kPressed;
  const int outermost = count(3) - (report.button ? kButton : 0);
  report.gimbal = {count(5), count(4), static_cast<std::int16_t>(outermost)};
  return report;
}

std::array<std::uint8_t, 14> octets_of(const PolhemCommand& command) noexcept {
  std::array<std::int16_t, 7> words{};
  if (command.counts) {
    // The gimbal's counts take the place of the currents.
    std::copy_n(command.counts->begin() + 3, 3, words.begin());
    words[3] = kSetCounts;
    std::copy_n(command.counts->begin(), 3, words.begin() + 4);
  } else {
    std::ranges::copy(command.currents, words.begin());
  }
  std::array<std::uint8_t, 14> octets{};
  for (std::size_t i = 0; i < words.size(); ++i) {
    const auto word = static_cast<std::uint16_t>(words[i]);
    octets[2 * i] = static_cast<std::uint8_t>(word & 0xFF);
    octets[2 * i + 1] = static_cast<std::uint8_t>(word >> 8);
  }
  return octets;
}

}  // namespace reckon::haptics
