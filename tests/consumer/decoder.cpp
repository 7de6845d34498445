// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Ten lines against an installed Reckon: encode an Entity State, decode it, compare.
#include <array>
#include <cstdio>
#include <string_view>

#include "reckon/pdu/entity/entity_state.hpp"

int main() {
  reckon::pdu::EntityState sent, received;
  sent.entity_id = {1, 10, 7};
  std::array<std::byte, 144> datagram{};
  if (encode(sent, datagram) != datagram.size()) return 1;
  const auto error = decode(datagram, received);
  const std::string_view fault =
      error == reckon::pdu::DecodeError::none ? "good" : std::string_view(rule(error));
  std::printf("%.*s: entity %d\n", static_cast<int>(fault.size()), fault.data(),
              received.entity_id.entity);
  return error == reckon::pdu::DecodeError::none && received.entity_id == sent.entity_id ? 0 : 1;
}
