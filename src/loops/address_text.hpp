// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// A source address as text for notices, without allocation.
#pragma once

#include <array>
#include <string_view>

#include "reckon/aoim/presence/source_address.hpp"

namespace reckon::peer {

/// "10.0.0.9:5555" or "[fe80::1]:5555"; only the address if there is no port; "an unknown address"
/// for none. A value, some 100 ns.
class AddressText {
 public:
  explicit AddressText(const aoim::SourceAddress& address) noexcept;
  [[nodiscard]] std::string_view view() const noexcept { return text_.data(); }

 private:
  std::array<char, 64> text_{};  // NUL at the end
};

}  // namespace reckon::peer
