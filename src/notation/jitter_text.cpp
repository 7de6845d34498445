// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/peer/notation/jitter_text.hpp"

#include <fmt/format.h>

#include "reckon/pdu/seconds.hpp"
#include "reckon/peer/notation/units.hpp"

namespace reckon::peer {
namespace {

constexpr std::string_view kBoth = "a time, such as 5ms, or a share of the delay, such as 40%";

JitterText share_of_delay(std::string_view text, std::chrono::nanoseconds delay,
                          std::string_view delay_example) {
  const Quantity share = parse_quantity(text, "");
  if (!share.good() || !(share.value >= 0 && share.value <= 1))
    return {{}, fmt::format("'{}' is not a share from 0% to 100%; write {}", text, kBoth)};
  if (share.value > 0 && delay.count() == 0)
    return {{},
            fmt::format(
                "'{}' is a share of the delay, which is 0; write {} too, or a time, such as 5ms",
                text, delay_example)};
  return {to_nanoseconds(share.value * pdu::to_seconds(delay)), {}};
}

}  // namespace

bool is_share_of_delay(std::string_view text) noexcept {
  const std::size_t last = text.find_last_not_of(' ');
  return last != text.npos && text[last] == '%';
}

JitterText read_jitter(std::string_view text, std::chrono::nanoseconds delay,
                       std::string_view delay_example) {
  if (is_share_of_delay(text)) return share_of_delay(text, delay, delay_example);
  const Quantity time = parse_quantity(text, "s");
  // A number alone could be a time or a share; only zero is unambiguous.
  const bool has_unit = text.find_first_of("smhnu") != text.npos;
  if (!time.good() || !(time.value >= 0) || (time.value > 0 && !has_unit))
    return {{}, fmt::format("'{}' is not a jitter; write {}", text, kBoth)};
  const std::chrono::nanoseconds jitter = to_nanoseconds(time.value);
  if (jitter == std::chrono::nanoseconds::max())
    return {{}, fmt::format("'{}' exceeds the longest jitter; write {}", text, kBoth)};
  return {jitter, {}};
}

}  // namespace reckon::peer
