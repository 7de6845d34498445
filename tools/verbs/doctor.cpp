// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <string>
#include <vector>

#include "reckon/peer/network/host_limits.hpp"
#include "reckon/tools/command_line/command_line.hpp"
#include "reckon/tools/terminal/json_text.hpp"
#include "reckon/tools/terminal/text_table.hpp"

namespace reckon::tools {
namespace {

struct DoctorOptions {
  std::string interface;
  std::uint64_t groups = peer::HostNeeds{}.groups;
  bool ipv6 = false;
  bool json = false;
};

/// How a level is written, and its ANSI colour.
struct LevelText {
  std::string_view word;
  std::string_view colour;
};

LevelText text_of(peer::FindingLevel level) {
  switch (level) {
    case peer::FindingLevel::ok:
      return {"ok", "\x1b[32m"};
    case peer::FindingLevel::note:
      return {"note", "\x1b[36m"};
    case peer::FindingLevel::warning:
      return {"warn", "\x1b[33m"};
    case peer::FindingLevel::problem:
      break;
  }
  return {"fail", "\x1b[31m"};
}

void print_finding(const Console& console, const peer::Finding& finding) {
  const LevelText level = text_of(finding.level);
  const std::string_view colour = console.colour ? level.colour : "";
  fmt::print(console.out, "{}{:<4}{}  {}\n", colour, level.word, console.colour ? "\x1b[0m" : "",
             finding.what);
  if (!finding.remedy.empty()) fmt::print(console.out, "      fix: {}\n", finding.remedy);
}

void print_json(std::FILE* out, const peer::Finding& finding) {
  std::string line;
  JsonObject(line)
      .text("level", text_of(finding.level).word)
      .text("what", finding.what)
      .text("remedy", finding.remedy)
      .end("\n");
  std::fwrite(line.data(), 1, line.size(), out);
}

void print_summary(std::FILE* err, const std::vector<peer::Finding>& findings) {
  const auto count = [&](peer::FindingLevel level) {
    return static_cast<std::uint64_t>(
        std::count_if(findings.begin(), findings.end(),
                      [=](const peer::Finding& finding) { return finding.level == level; }));
  };
  fmt::print(err, "{}: {} ok, {}, {}, {} failed\n", counted(findings.size(), "finding"),
             count(peer::FindingLevel::ok), counted(count(peer::FindingLevel::note), "note"),
             counted(count(peer::FindingLevel::warning), "warning"),
             count(peer::FindingLevel::problem));
}

peer::InterfaceChoice choose(const DoctorOptions& options) {
  try {
    return peer::choose_interface(options.interface, options.ipv6);
  } catch (const std::runtime_error& error) {
    throw EnvironmentError(error.what());
  }
}

int run_doctor(Arguments arguments, const Console& console) {
  DoctorOptions options;
  CommandLine line("doctor",
                   "Looks at what a peer needs of this host and says how to mend what is wrong.",
                   "reckon doctor\nreckon doctor --iface eth0 --json");
  line.option("--iface", options.interface,
              "interface name, address or index (default: chosen by score, told on stderr)");
  line.option("--groups", options.groups, "multicast groups that a scene would join");
  line.flag("--ipv6", options.ipv6, "look at IPv6 instead of IPv4");
  line.flag("--json", options.json, "one JSON object per finding");
  if (const auto status = line.parse(arguments, console)) return *status;

  const peer::InterfaceChoice choice = choose(options);
  fmt::print(console.err, "{}", choice.explanation);
  peer::HostNeeds needs;
  needs.groups = options.groups;
  needs.ipv6 = options.ipv6;
  const std::vector<peer::Finding> findings = peer::examine_host(choice.interface, needs);

  for (const peer::Finding& finding : findings) {
    if (options.json)
      print_json(console.out, finding);
    else
      print_finding(console, finding);
  }
  print_summary(console.err, findings);
  const bool failed = std::any_of(findings.begin(), findings.end(), [](const peer::Finding& f) {
    return f.level == peer::FindingLevel::problem;
  });
  return exit_status(failed ? ExitCode::findings : ExitCode::good);
}

}  // namespace

namespace verb {

Verb doctor() {
  return {"doctor", "say what is wrong with this host and how to mend it", run_doctor};
}

}  // namespace verb

}  // namespace reckon::tools
