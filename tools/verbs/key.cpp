// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <chrono>
#include <string>

#include "reckon/peer/clocks/clock.hpp"
#include "reckon/peer/sealing/key_file.hpp"
#include "reckon/tools/command_line/command_line.hpp"
#include "reckon/tools/command_line/verb_rows.hpp"

namespace reckon::tools {
namespace {

using peer::GroupKey;
using peer::SealingSuite;

constexpr std::string_view kFastest = "fastest";

struct KeyOptions {
  std::string action;
  std::string file;
  std::string group = "exercise";
  std::string suite = std::string(kFastest);
  std::string from;
};

SealingSuite suite_of(const KeyOptions& options) {
  if (options.suite != kFastest) return peer::suite_of(options.suite).value();
  return peer::can_seal(SealingSuite::aes_256_gcm) ? SealingSuite::aes_256_gcm
                                                   : SealingSuite::xchacha20_poly1305;
}

std::chrono::seconds time_of(const KeyOptions& options) {
  const auto time = peer::parse_utc(options.from);
  if (!time)
    throw UsageError(fmt::format(
        "--from '{}' is not a time in UTC: write it as 2026-12-01T06:00:00Z", options.from));
  return *time;
}

void make_file(const KeyOptions& options, const Console& console) {
  GroupKey key;
  key.group = options.group;
  key.suite = suite_of(options);
  key.epochs.push_back(peer::draw_epoch(1, std::nullopt));
  // Checks the key with the reader before it is written.
  static_cast<void>(peer::parse_group_key(peer::group_key_text(key), "--group"));
  peer::save_group_key(key, options.file, false);
  fmt::print(console.err,
             "{} is the key of '{}' ({}). Anyone who can read it can take part: transfer it "
             "safely, and give it as [network] key or by --key.\n",
             options.file, key.group, peer::word_of_suite(key.suite));
}

void add_epoch(const KeyOptions& options, const Console& console) {
  const std::chrono::seconds from = time_of(options);
  if (from <= peer::SteadyClock().utc_now())
    throw UsageError(
        fmt::format("--from {} is past: this host would change its epoch at once, and members "
                    "without the new file could not receive it; write a time when all have it",
                    options.from));
  GroupKey key = peer::load_group_key(options.file);
  const auto number = static_cast<std::uint16_t>(key.epochs.back().number + 1);
  key.epochs.push_back(peer::draw_epoch(number, from));
  const std::string& file = options.file;
  static_cast<void>(peer::parse_group_key(peer::group_key_text(key), file));
  peer::save_group_key(key, file, true);
  fmt::print(console.err, "epoch {} of {} begins at {}: every member needs this file before\n",
             number, file, options.from);
}

void show(const KeyOptions& options, const Console& console) {
  const GroupKey key = peer::load_group_key(options.file);
  const std::size_t now = key.epoch_at(peer::SteadyClock().utc_now());
  fmt::print(console.out, "group  {}\nsuite  {}\n", key.group, peer::word_of_suite(key.suite));
  for (std::size_t i = 0; i < key.epochs.size(); ++i) {
    const peer::GroupEpoch& epoch = key.epochs[i];
    fmt::print(console.out, "epoch  {}  from {}  fingerprint {}{}\n", epoch.number,
               epoch.from ? peer::utc_text(*epoch.from) : "the beginning", peer::fingerprint(epoch),
               i == now ? "  holds now" : "");
  }
}

int run_key(Arguments arguments, const Console& console) {
  KeyOptions options;
  CommandLine line("key", "The key file of a sealed exercise: create one, add a secret, show it.",
                   "reckon key new crane.key --group crane\n"
                   "reckon key next crane.key --from 2026-12-01T06:00:00Z\n"
                   "reckon key show crane.key\n"
                   "reckon peer scenes/two_hands.toml --key crane.key");
  line.choice("ACTION", options.action, {"new", "next", "show"},
              "new: create a file with a random secret; next: add a secret for a later time; show: "
              "the content without secrets");
  line.word("FILE", options.file, false, "key file; only its owner may read it");
  line.option("--group", options.group, "new: name of the group, for display");
  line.choice("--suite", options.suite,
              {std::string(kFastest), "aes-256-gcm", "xchacha20-poly1305"},
              "new: cipher suite; aes-256-gcm needs AES instructions in the CPU of each member "
              "(default: fastest on this CPU)");
  line.option("--from", options.from, "next: start time in UTC, for example 2026-12-01T06:00:00Z");
  if (const auto status = line.parse(arguments, console)) return *status;
  if (options.action.empty()) throw UsageError("write an action: reckon key new, next or show");
  if (options.file.empty())
    throw UsageError(fmt::format("name a key file: reckon key {} FILE", options.action));
  try {
    if (options.action == "new") make_file(options, console);
    if (options.action == "next") add_epoch(options, console);
    if (options.action == "show") show(options, console);
  } catch (const peer::KeyFileError& error) {
    throw UsageError(error.what());
  }
  return exit_status(ExitCode::good);
}

}  // namespace

namespace verb {

Verb key() { return verb_of(verb_row("key"), run_key); }

}  // namespace verb

}  // namespace reckon::tools
