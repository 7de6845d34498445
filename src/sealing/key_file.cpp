// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/peer/sealing/key_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <utility>

namespace reckon::peer {
namespace {

constexpr std::array kSuites = {
    std::pair{SealingSuite::aes_256_gcm, std::string_view("aes-256-gcm")},
    std::pair{SealingSuite::xchacha20_poly1305, std::string_view("xchacha20-poly1305")}};
constexpr std::size_t kLongestName = 32;

/// Takes the next word of the line; empty at its end.
std::string_view next_word(std::string_view& line) {
  const auto is_blank = [](char letter) {
    return letter == ' ' || letter == '\t' || letter == '\r';
  };
  const auto begin = std::ranges::find_if_not(line, is_blank);
  const auto end = std::find_if(begin, line.end(), is_blank);
  const std::string_view word(begin, end);
  line = {end, line.end()};
  return word;
}

template <typename Number>
std::optional<Number> number_of(std::string_view text, int base = 10) {
  Number number{};
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number, base);
  if (error != std::errc{} || end != text.data() + text.size()) return std::nullopt;
  return number;
}

bool is_name(std::string_view text) {
  const auto is_letter = [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '-' ||
           c == '_' || c == '.';
  };
  return !text.empty() && text.size() <= kLongestName && std::ranges::all_of(text, is_letter);
}

bool read_secret(std::string_view digits, KeyOctets& secret) {
  if (digits.size() != 2 * secret.size()) return false;
  for (std::size_t i = 0; i < secret.size(); ++i) {
    const auto octet = number_of<std::uint8_t>(digits.substr(2 * i, 2), 16);
    if (!octet) return false;
    secret[i] = static_cast<std::byte>(*octet);
  }
  return true;
}

/// Reads the lines of one file. Messages never show its words: one of them is the secret.
class KeyReader {
 public:
  explicit KeyReader(const std::string& file) : file_(file) {}

  void read_line(std::string_view line) {
    ++number_;
    line = line.substr(0, line.find('#'));
    const std::string_view word = next_word(line);
    if (word.empty()) return;
    if (word == "group") {
      read_group(line);
    } else if (word == "suite") {
      read_suite(line);
    } else if (word == "epoch") {
      read_epoch(line);
    } else {
      fail("a line begins with group, suite or epoch");
    }
    if (!next_word(line).empty()) fail("the line has extra text at its end");
  }

  [[nodiscard]] GroupKey finish() {
    number_ = 0;
    if (key_.group.empty()) fail("has no line 'group NAME'");
    if (!has_suite_) fail("has no line 'suite aes-256-gcm' or 'suite xchacha20-poly1305'");
    if (key_.epochs.empty()) fail("has no line 'epoch N secret ..'; `reckon key new` makes a file");
    return std::move(key_);
  }

 private:
  [[noreturn]] void fail(std::string_view sentence) const {
    throw KeyFileError(number_ == 0 ? fmt::format("{}: {}", file_, sentence)
                                    : fmt::format("{}:{}: {}", file_, number_, sentence));
  }

  void read_group(std::string_view& line) {
    const std::string_view name = next_word(line);
    if (!is_name(name)) fail("'group' needs a name of 1 to 32 letters, digits, '-', '_' and '.'");
    if (!key_.group.empty()) fail("a second 'group': a file has one group");
    key_.group = name;
  }

  void read_suite(std::string_view& line) {
    const auto suite = suite_of(next_word(line));
    if (!suite) fail("'suite' needs aes-256-gcm or xchacha20-poly1305");
    if (has_suite_) fail("a second 'suite': a file has one suite");
    key_.suite = *suite;
    has_suite_ = true;
  }

  void read_epoch(std::string_view& line) {
    if (key_.epochs.size() == GroupKey::kMostEpochs)
      fail("more than 64 epochs: remove the expired ones");
    GroupEpoch epoch;
    const auto number = number_of<std::uint16_t>(next_word(line));
    if (!number) fail("'epoch' needs a number, 0 to 65535");
    epoch.number = *number;
    std::string_view word = next_word(line);
    if (word == "from") {
      epoch.from = parse_utc(next_word(line));
      if (!epoch.from) fail("'from' needs a time in UTC, for example 2026-12-01T06:00:00Z");
      word = next_word(line);
    }
    if (word != "secret" || !read_secret(next_word(line), epoch.secret))
      fail("'secret' needs 64 hexadecimal digits");
    check_order(epoch);
    key_.epochs.push_back(epoch);
  }

  void check_order(const GroupEpoch& epoch) const {
    if (key_.epochs.empty()) return;
    const GroupEpoch& before = key_.epochs.back();
    if (epoch.number <= before.number) fail("numbers of epochs must increase from line to line");
    if (!epoch.from) fail("each epoch after the first needs 'from TIME'");
    if (before.from && *epoch.from <= *before.from)
      fail("times of epochs must increase from line to line");
  }

  const std::string& file_;
  std::size_t number_ = 0;
  bool has_suite_ = false;
  GroupKey key_;
};

}  // namespace

std::size_t GroupKey::epoch_at(std::chrono::nanoseconds utc) const noexcept {
  std::size_t held = 0;
  for (std::size_t i = 1; i < epochs.size(); ++i)
    if (epochs[i].from && *epochs[i].from <= utc) held = i;
  return held;
}

std::optional<std::size_t> GroupKey::find(std::uint16_t number) const noexcept {
  for (std::size_t i = 0; i < epochs.size(); ++i)
    if (epochs[i].number == number) return i;
  return std::nullopt;
}

std::optional<SealingSuite> suite_of(std::string_view word) noexcept {
  for (const auto& [suite, name] : kSuites)
    if (name == word) return suite;
  return std::nullopt;
}

std::string_view word_of_suite(SealingSuite suite) noexcept {
  return suite == kSuites[0].first ? kSuites[0].second : kSuites[1].second;
}

std::optional<std::chrono::seconds> parse_utc(std::string_view text) noexcept {
  constexpr std::string_view kForm = "dddd-dd-ddTdd:dd:ddZ";
  if (text.size() != kForm.size()) return std::nullopt;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const bool is_digit = text[i] >= '0' && text[i] <= '9';
    if (kForm[i] == 'd' ? !is_digit : text[i] != kForm[i]) return std::nullopt;
  }
  const auto part = [&](std::size_t at, std::size_t size) {
    return number_of<int>(text.substr(at, size)).value_or(0);
  };
  using namespace std::chrono;
  const year_month_day day{year(part(0, 4)), month(static_cast<unsigned>(part(5, 2))),
                           std::chrono::day(static_cast<unsigned>(part(8, 2)))};
  // Nanoseconds, in which clocks are compared, end in 2262.
  if (!day.ok() || part(0, 4) < 1970 || part(0, 4) > 2200 || part(11, 2) > 23 || part(14, 2) > 59 ||
      part(17, 2) > 59)
    return std::nullopt;
  return sys_days(day).time_since_epoch() + hours(part(11, 2)) + minutes(part(14, 2)) +
         seconds(part(17, 2));
}

std::string utc_text(std::chrono::seconds utc) {
  using namespace std::chrono;
  const auto date = floor<days>(utc);
  const year_month_day day{sys_days(date)};
  const hh_mm_ss time(utc - date);
  return fmt::format("{:04}-{:02}-{:02}T{:02}:{:02}:{:02}Z", static_cast<int>(day.year()),
                     static_cast<unsigned>(day.month()), static_cast<unsigned>(day.day()),
                     time.hours().count(), time.minutes().count(), time.seconds().count());
}

GroupKey parse_group_key(std::string_view text, const std::string& file) {
  KeyReader reader(file);
  while (!text.empty()) {
    const std::size_t end = std::min(text.find('\n'), text.size());
    reader.read_line(text.substr(0, end));
    text.remove_prefix(std::min(end + 1, text.size()));
  }
  return reader.finish();
}

std::string group_key_text(const GroupKey& key) {
  std::string text = fmt::format(
      "# Key of a sealed exercise. It admits anyone who reads it: transfer it only by a secure "
      "channel.\n"
      "group {}\nsuite {}\n",
      key.group, word_of_suite(key.suite));
  for (const GroupEpoch& epoch : key.epochs) {
    text += fmt::format("epoch {} ", epoch.number);
    if (epoch.from) text += fmt::format("from {} ", utc_text(*epoch.from));
    text += "secret ";
    for (const std::byte octet : epoch.secret)
      text += fmt::format("{:02x}", static_cast<unsigned>(octet));
    text += '\n';
  }
  return text;
}

// The fingerprint uses a suite with which nothing is sealed.
std::string fingerprint(const GroupEpoch& epoch) {
  constexpr std::size_t kOctets = 6;
  EnvelopeHeader header;
  header.suite = SealingSuite{0};
  header.epoch = epoch.number;
  const KeyOctets key = derive_key(epoch.secret, header);
  std::string text;
  for (const std::byte octet : std::span(key).first<kOctets>())
    text += fmt::format("{:02x}", static_cast<unsigned>(octet));
  return text;
}

GroupEpoch draw_epoch(std::uint16_t number, std::optional<std::chrono::seconds> from,
                      RandomSource random) {
  GroupEpoch epoch;
  epoch.number = number;
  epoch.from = from;
  if (!random(epoch.secret)) throw RandomSourceError();
  return epoch;
}

}  // namespace reckon::peer
