// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/tools/datagrams/trailing.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <concepts>
#include <cstdint>
#include <string_view>
#include <utility>

#include "reckon/pdu/pdu_types.hpp"

namespace reckon::tools {
namespace {

/// "40 octets", "1 octet".
std::string octets_text(std::size_t count) {
  return fmt::format("{} octet{}", count, count == 1 ? "" : "s");
}

/// Visitor of a decoded PDU that finds the count or length which leaves octets after the last
/// field. If several fit, the last one in wire order is the cause.
class CauseSearch {
 public:
  explicit CauseSearch(std::span<const std::byte> behind) : behind_(behind) {}

  template <typename T>
  void operator()(std::string_view name, T& value) {
    if constexpr (std::integral<T>) remember(&value, name);
  }
  template <typename Record, typename Count>
  void count(std::string_view name, std::span<const std::byte>& view, pdu::Records<Record, Count>) {
    remember(&view, name);
  }
  template <typename Record, typename Count>
  void records(std::string_view, std::span<const std::byte>& view, pdu::Records<Record, Count>) {
    constexpr std::size_t kSize = pdu::kFixedSize<Record>;
    if (!ends_here(view) || behind_.size() % kSize != 0) return;
    more_records(name_of(&view), view.size() / kSize, behind_.size() / kSize);
  }
  template <typename View>
  void walked(std::string_view, View& view) {
    if (!ends_here(view.bytes)) return;
    if constexpr (pdu::OctetView<View>)
      longer_block(name_of(&view.count), view);
    else if constexpr (std::is_assignable_v<decltype((view.count)), std::uint8_t>)
      look_for_records(view);
  }
  void walked(std::string_view, pdu::VariableDatums& view) {
    if (!ends_here(view.bytes)) return;
    if (look_for_records(view) || view.count == 0) return;
    pdu::VariableDatum last;
    for (const pdu::VariableDatum& datum : view.records()) last = datum;
    const auto there = static_cast<std::size_t>(end() - last.value.data());
    length_in_octets("variable_datum_length", last.length_bits, there, 8);
  }

  [[nodiscard]] std::string& cause() { return cause_; }

 private:
  [[nodiscard]] const std::byte* end() const { return behind_.data() + behind_.size(); }
  [[nodiscard]] bool ends_here(std::span<const std::byte> view) const {
    return view.data() != nullptr && view.data() + view.size() == behind_.data();
  }
  void remember(const void* place, std::string_view name) {
    if (known_ < numbers_.size()) numbers_[known_++] = {place, name};
  }
  [[nodiscard]] std::string_view name_of(const void* place) const {
    const auto known = std::span(numbers_).first(known_);
    const auto found = std::ranges::find(known, place, &Number::place);
    return found == known.end() ? "a count" : found->name;
  }

  void more_records(std::string_view name, std::size_t is, std::size_t more) {
    cause_ = fmt::format("{} is {}, and {} more {} present", name, is, more,
                         more == 1 ? "record is" : "records are");
  }
  template <typename View>
  bool look_for_records(View& view) {
    constexpr std::size_t kMost = 64;  // each walk starts again: some 20 us
    for (std::size_t more = 1; more <= kMost; ++more) {
      const pdu::WalkResult walked = View::walk(more, behind_);
      if (walked.error != pdu::DecodeError::none) return false;
      if (walked.size < behind_.size()) continue;
      more_records(name_of(&view.count), view.count, more);
      return true;
    }
    return false;
  }
  void longer_block(std::string_view name, const pdu::BitBlock& block) {
    length_in_octets(name, block.count, block.bytes.size() + behind_.size(), 4);
  }
  void longer_block(std::string_view name, const auto& block) {
    const std::size_t size = block.bytes.size();
    const bool may_be_count = size > 0 && (size + behind_.size()) % size == 0;
    cause_ = fmt::format("{} is {}, {} fewer than are present{}", name, octets_text(size),
                         behind_.size(), may_be_count ? ": a count in place of a length?" : "");
  }
  /// A length in bits of a value that is padded to `padded_to` octets: the cause if it is 0, or
  /// fits as a length in octets.
  void length_in_octets(std::string_view name, std::size_t bits, std::size_t there,
                        std::size_t padded_to) {
    const bool fits = bits <= there && there - bits < padded_to;
    if (!fits && bits > 0) return;
    cause_ = fmt::format("{} is {} bits, {} octets fewer than are present{}", name, bits,
                         (bits > 0 ? bits : there) - (bits + 7) / 8,
                         bits > 0 ? ": given in octets?" : "");
  }

  /// A number that may be a count, or a list with a count.
  struct Number {
    const void* place = nullptr;
    std::string_view name;
  };

  std::span<const std::byte> behind_;
  std::array<Number, 48> numbers_{};  // more than any type has before its last list
  std::size_t known_ = 0;
  std::string cause_;
};

template <typename... T>
std::string cause_of(std::span<const std::byte> octets, pdu::PduType type,
                     std::span<const std::byte> behind, pdu::TypeList<T...>) {
  CauseSearch search(behind);
  const auto attempt = [&]<typename Candidate>(std::type_identity<Candidate>) {
    if (Candidate::kPduType != type) return false;
    Candidate pdu;  // not const: const would show views of octets as records
    if (decode(octets, pdu) == pdu::DecodeError::none) fields(search, pdu);
    return true;
  };
  static_cast<void>((attempt(std::type_identity<T>{}) || ...));
  return std::move(search.cause());
}

}  // namespace

std::string start_in_hex(std::span<const std::byte> octets) {
  constexpr std::size_t kMost = 16;
  std::string text;
  for (const std::byte octet : octets.first(std::min(octets.size(), kMost)))
    text += fmt::format("{:02x}", std::to_integer<unsigned>(octet));
  return octets.size() > kMost ? text + "..." : text;
}

std::string explain_trailing(std::span<const std::byte> octets, const pdu::PduHeader& header,
                             std::size_t behind) {
  constexpr std::size_t kWord = 8;  // some senders pad to this size
  const std::span<const std::byte> rest = octets.last(behind);
  std::string text =
      fmt::format("{} after the last field: {}", octets_text(behind), start_in_hex(rest));
  const bool is_padding =
      behind < kWord && octets.size() % 4 == 0 &&
      std::ranges::all_of(rest, [](std::byte octet) { return octet == std::byte{0}; });
  const std::string cause = is_padding ? "padding: the length field must not count it"
                                       : cause_of(octets, header.pdu_type, rest, pdu::PduTypes{});
  if (!cause.empty()) text.append("; ").append(cause);
  return text;
}

}  // namespace reckon::tools
