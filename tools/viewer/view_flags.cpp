// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/tools/viewer/view_flags.hpp"

#include <fmt/format.h>

#include <charconv>
#include <cstdio>
#include <system_error>
#include <vector>

#include "reckon/tools/viewer/viewing.hpp"

namespace reckon::tools {

namespace {

void add_common_flags(CommandLine& line, std::string& listen, bool& open) {
  line.option("--listen", listen,
              "address of this host that the page is served at (default: 127.0.0.1, this host "
              "alone; 0.0.0.0: all)");
  line.flag("--open", open, "open the page in the browser of this host");
}

}  // namespace

void add_view_flags(CommandLine& line, ViewFlags& flags) {
  line.option("--port", flags.port,
              "TCP port of the page (default: 8642 or the next free; 0: any)");
  add_common_flags(line, flags.listen, flags.open);
}

void add_view_switch(CommandLine& line, ViewSwitch& typed) {
  line.flag("--view", typed.view,
            "serve a page for the browser, at this port of this host (--view=9000; default: 8642 "
            "or the next free)");
  add_common_flags(line, typed.listen, typed.open);
}

std::optional<ViewFlags> flags_of_switch(const ViewSwitch& typed) {
  const std::string& view = typed.view;
  if (view.empty() || view == "false") {
    if (!typed.listen.empty() || typed.open)
      throw UsageError(fmt::format("{} is about the page: add --view to serve one",
                                   typed.open ? "--open" : "--listen"));
    return std::nullopt;
  }
  ViewFlags flags;
  if (!typed.listen.empty()) flags.listen = typed.listen;
  flags.open = typed.open;
  if (view == "true") return flags;
  std::uint64_t port = 0;
  const auto [end, error] = std::from_chars(view.data(), view.data() + view.size(), port);
  if (error != std::errc() || end != view.data() + view.size())
    throw UsageError(fmt::format("--view={}: write a port, as in --view=9000, or none", view));
  flags.port = port;
  return flags;
}

ViewServerOptions server_options(const ViewFlags& flags) {
  constexpr std::uint64_t kLastPort = 65535;
  if (flags.port && *flags.port > kLastPort)
    throw UsageError(
        fmt::format("port {} of the page: ports are 0 to {}; 0 takes any", *flags.port, kLastPort));
  ViewServerOptions options;
  options.address = flags.listen;
  if (flags.port) options.port = static_cast<std::uint16_t>(*flags.port);
  options.word = draw_word();
  return options;
}

std::vector<std::string> invitation(const std::vector<std::string>& addresses) {
  std::vector<std::string> lines{
      "other hosts reach the page too: whoever does can look, and whoever has the word can push"};
  for (const std::string& address : addresses) lines.push_back("  " + address);
  return lines;
}

void tell_addresses(const ViewServer& server, const ViewFlags& flags, const Console& console) {
  fmt::print(console.out, "{}\n", server.address());
  std::fflush(console.out);
  const std::vector<std::string> others = server.addresses_for_others();
  if (!others.empty()) fmt::print(console.err, "{}\n", fmt::join(invitation(others), "\n"));
  if (flags.open) open_browser(server.address());
}

}  // namespace reckon::tools
