// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/haptics/hid/report_descriptor.hpp"

#include <algorithm>

namespace reckon::haptics {
namespace {

using Octets = std::span<const std::uint8_t>;

// 6.2.2.2: the type and the tag of a short item.
enum class ItemType : std::uint8_t { main, global, local };
enum class MainTag : std::uint8_t { input = 8, output, collection, feature, end };
enum class GlobalTag : std::uint8_t {
  page = 0,
  least = 1,
  most = 2,
  exponent = 5,
  unit = 6,
  bits = 7,
  report = 8,
  count = 9,
  push = 10,
  pop = 11
};
enum class LocalTag : std::uint8_t { usage = 0, first = 1, last = 2, delimiter = 10 };
constexpr std::uint8_t kLongItem = 0xFE;
constexpr std::uint32_t kIsConstant = 1, kIsVariable = 2;
constexpr std::uint32_t kSeconds = 0x1001;  // 6.2.2.7: seconds, in the system SI linear
constexpr std::size_t kMostPushed = 16, kDeepest = 64;
constexpr std::uint32_t kNumberBits = 8;

struct Item {
  unsigned type = 0, tag = 0, octets = 0;
  std::uint32_t value = 0;

  [[nodiscard]] std::int64_t with_sign() const noexcept {
    if (octets == 0 || octets == 4) return static_cast<std::int32_t>(value);
    const std::uint32_t sign = 1U << (8 * octets - 1);
    return static_cast<std::int64_t>(value ^ sign) - sign;
  }
};

struct Globals {
  std::uint32_t page = 0, bits = 0, count = 0, unit = 0;
  std::int64_t least = 0;
  Item most;
  int exponent = 0;
  std::uint8_t report = 0;

  // 6.2.2.7: the maximum has a sign only if the minimum is negative.
  [[nodiscard]] std::int64_t greatest() const noexcept {
    return least < 0 ? most.with_sign() : std::int64_t{most.value};
  }
};

class Reader {
 public:
  explicit Reader(Octets octets) : rest_(octets) {}

  std::optional<HidReports> read() {
    if (rest_.empty() || rest_.size() > HidReports::kMostOctets) return std::nullopt;
    while (!rest_.empty())
      if (!read_item()) return std::nullopt;
    if (!open_.empty()) return std::nullopt;
    return std::move(out_);
  }

 private:
  bool read_item() {
    const std::uint8_t head = rest_[0];
    if (head == kLongItem) {
      if (rest_.size() < 3 || rest_.size() < std::size_t{3} + rest_[1]) return false;
      rest_ = rest_.subspan(std::size_t{3} + rest_[1]);
      return true;
    }
    Item item{(head >> 2) & 3U, static_cast<unsigned>(head >> 4), head & 3U, 0};
    if (item.octets == 3) item.octets = 4;
    if (rest_.size() < 1 + item.octets) return false;
    for (unsigned i = 0; i < item.octets; ++i)
      item.value |= static_cast<std::uint32_t>(rest_[1 + i]) << 8 * i;
    rest_ = rest_.subspan(1 + item.octets);
    if (static_cast<ItemType>(item.type) == ItemType::global) return take_global(item);
    if (static_cast<ItemType>(item.type) == ItemType::local) return take_local(item);
    if (static_cast<ItemType>(item.type) != ItemType::main) return false;
    const bool is_good = take_main(item);
    usages_.clear();
    first_.reset();
    return is_good;
  }

  bool take_global(const Item& item) {
    switch (static_cast<GlobalTag>(item.tag)) {
      case GlobalTag::page:
        now_.page = item.value;
        return item.value <= 0xFFFF;
      case GlobalTag::least:
        now_.least = item.with_sign();
        return true;
      case GlobalTag::most:
        now_.most = item;
        return true;
      case GlobalTag::exponent:  // four bits with a sign; some devices write it as an octet
        now_.exponent = static_cast<int>(item.value & 0xF);
        if (now_.exponent > 7) now_.exponent -= 16;
        return true;
      case GlobalTag::unit:
        now_.unit = item.value;
        return true;
      case GlobalTag::bits:
        now_.bits = item.value;
        return item.value <= HidReports::kMostBits;
      case GlobalTag::report:
        now_.report = static_cast<std::uint8_t>(item.value);
        return item.value >= 1 && item.value <= 255;
      case GlobalTag::count:
        now_.count = item.value;
        return item.value <= HidReports::kMostBits;
      case GlobalTag::push:
        if (pushed_.size() == kMostPushed) return false;
        pushed_.push_back(now_);
        return true;
      case GlobalTag::pop:
        if (pushed_.empty()) return false;
        now_ = pushed_.back();
        pushed_.pop_back();
        return true;
      default:
        return true;  // physical minimum and maximum
    }
  }

  bool take_local(const Item& item) {
    switch (static_cast<LocalTag>(item.tag)) {
      case LocalTag::usage:
        return add_usages(item, item.value, item.value);
      case LocalTag::first:
        first_ = item;
        return true;
      case LocalTag::last: {
        if (!first_ || first_->value > item.value) return false;
        const Item first = *first_;
        first_.reset();
        return add_usages(first, first.value, item.value);
      }
      case LocalTag::delimiter:
        return false;  // alternative usages: no known device has them
      default:
        return true;  // designators and strings
    }
  }

  // 5.4: a usage of at most two octets belongs to the usage page in force at the main item.
  bool add_usages(const Item& item, std::uint32_t from, std::uint32_t to) {
    if (to - from >= HidReports::kMostUsages - usages_.size()) return false;
    for (std::uint32_t i = 0; i <= to - from; ++i) usages_.push_back({from + i, item.octets <= 2});
    return true;
  }
  [[nodiscard]] std::uint32_t usage_at(std::size_t place) const noexcept {
    if (usages_.empty()) return 0;
    const auto [usage, is_short] = usages_[std::min(place, usages_.size() - 1)];
    return is_short ? hid_usage(now_.page, usage) : usage;
  }

  bool take_main(const Item& item) {
    switch (static_cast<MainTag>(item.tag)) {
      case MainTag::collection: {
        if (open_.size() == kDeepest) return false;
        const std::size_t place = out_.collections.size();
        out_.collections.push_back({usage_at(0), open_.empty() ? place : open_.back()});
        open_.push_back(place);
        return true;
      }
      case MainTag::end:
        if (open_.empty()) return false;
        open_.pop_back();
        return true;
      case MainTag::input:
        return add_fields(HidKind::input, item.value);
      case MainTag::output:
        return add_fields(HidKind::output, item.value);
      case MainTag::feature:
        return add_fields(HidKind::feature, item.value);
      default:
        return true;
    }
  }

  bool add_fields(HidKind kind, std::uint32_t what) {
    std::uint32_t& used = out_.bits[static_cast<std::size_t>(kind)][now_.report];
    if (used == 0) used = kNumberBits;
    const std::uint64_t bits = std::uint64_t{now_.bits} * now_.count;
    if (open_.empty() || used + bits > HidReports::kMostBits) return false;
    const std::uint32_t first = used;
    used += static_cast<std::uint32_t>(bits);
    if ((what & kIsConstant) != 0 || bits == 0) return true;
    if (now_.bits > 32 || now_.least > now_.greatest() ||
        out_.fields.size() + now_.count > HidReports::kMostFields)
      return false;
    HidField field;
    field.kind = kind;
    field.report = now_.report;
    field.collection = open_.back();
    field.least = now_.least;
    field.most = now_.greatest();
    field.bits = now_.bits;
    field.is_seconds = now_.unit == kSeconds;
    field.exponent = now_.exponent;
    const bool is_array = (what & kIsVariable) == 0;
    if (is_array && !add_choices(field)) return false;
    for (std::uint32_t i = 0; i < now_.count; ++i) {
      field.usage = is_array ? 0 : usage_at(i);
      field.bit = first + i * now_.bits;
      out_.fields.push_back(field);
    }
    return true;
  }
  bool add_choices(HidField& field) {
    field.first_choice = out_.choices.size();
    field.choices = usages_.size();
    if (out_.choices.size() + usages_.size() > HidReports::kMostChoices) return false;
    for (std::size_t i = 0; i < usages_.size(); ++i) out_.choices.push_back(usage_at(i));
    return true;
  }

  struct Usage {
    std::uint32_t usage = 0;
    bool is_short = false;
  };

  Octets rest_;
  HidReports out_;
  Globals now_;
  std::vector<Globals> pushed_;
  std::vector<Usage> usages_;
  std::optional<Item> first_;
  std::vector<std::size_t> open_;
};

}  // namespace

bool HidReports::is_within(std::size_t collection, std::uint32_t usage) const noexcept {
  while (collection < collections.size()) {
    const HidCollection& one = collections[collection];
    if (one.usage == usage) return true;
    if (one.parent == collection) return false;
    collection = one.parent;
  }
  return false;
}

std::size_t HidReports::size(HidKind kind, std::uint8_t report) const noexcept {
  return (bits[static_cast<std::size_t>(kind)][report] + 7) / 8;
}

std::optional<HidReports> hid_reports(Octets descriptor) { return Reader(descriptor).read(); }

std::optional<std::int64_t> number_in(Octets report, const HidField& field) noexcept {
  if (std::size_t{field.bit} + field.bits > 8 * report.size()) return std::nullopt;
  std::uint64_t number = 0;
  for (std::uint32_t i = 0; i < field.bits; ++i) {
    const std::uint32_t bit = field.bit + i;
    number |= static_cast<std::uint64_t>(report[bit / 8] >> bit % 8 & 1U) << i;
  }
  const std::uint64_t sign = std::uint64_t{1} << (field.bits - 1);
  const auto plain = static_cast<std::int64_t>(number);
  return field.least < 0 && (number & sign) != 0 ? plain - static_cast<std::int64_t>(2 * sign)
                                                 : plain;
}

void put_number(std::span<std::uint8_t> report, const HidField& field,
                std::int64_t number) noexcept {
  if (std::size_t{field.bit} + field.bits > 8 * report.size()) return;
  for (std::uint32_t i = 0; i < field.bits; ++i) {
    const std::uint32_t bit = field.bit + i;
    const auto mask = static_cast<std::uint8_t>(1U << bit % 8);
    const bool is_set = (static_cast<std::uint64_t>(number) >> i & 1U) != 0;
    report[bit / 8] =
        static_cast<std::uint8_t>(is_set ? report[bit / 8] | mask : report[bit / 8] & ~mask);
  }
}

}  // namespace reckon::haptics
