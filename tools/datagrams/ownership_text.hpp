// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Ownership of bodies in words: versions, causes, and the messages by which peers agree on owners.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>

#include "reckon/pdu/codec/enumerations.hpp"
#include "reckon/peer/ownership/tenure.hpp"

namespace reckon::tools {

/// "2.5": the fifth hand-over after act 2 gave the body away.
[[nodiscard]] std::string version_text(std::uint64_t version);
/// "founded", "granted" or "adopted"; see peer::cause_of().
[[nodiscard]] std::string_view cause_text(std::uint64_t version) noexcept;
/// The types of PDUs in which peers agree on owners.
[[nodiscard]] constexpr bool may_be_about_owners(pdu::PduType type) noexcept {
  return type == pdu::PduType::assured_record || type == pdu::PduType::transfer_ownership ||
         type == pdu::PduType::acknowledge;
}
/// "gives 3 2.5, 7 2.1 to 4a11c0de": numbers of bodies from 0, with their new versions; a peer by
/// its epoch. Empty if the PDU, or the content of an Assured Record, is no message about owners.
[[nodiscard]] std::string ownership_text(std::span<const std::byte> pdu);

}  // namespace reckon::tools
