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

void add_view_flags(CommandLine& line, ViewFlags& flags) {
  line.option("--port", flags.port,
              "TCP port of the page (default: 8642 or the next free; 0: any)");
  line.option("--listen", flags.listen,
              "address of this host that the page is served at (default: 127.0.0.1, this host "
              "alone; 0.0.0.0: all)");
  line.flag("--open", flags.open, "open the page in the browser of this host");
}

void add_view_switch(CommandLine& line, std::string& view) {
  line.flag("--view", view,
            "serve a page for the browser, at this port of this host (--view=9000; default: 8642 "
            "or the next free)");
}

std::optional<ViewFlags> flags_of_switch(const std::string& view) {
  if (view.empty() || view == "false") return std::nullopt;
  ViewFlags flags;
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

void tell_addresses(const ViewServer& server, const ViewFlags& flags, const Console& console) {
  fmt::print(console.out, "{}\n", server.address());
  std::fflush(console.out);
  const std::vector<std::string> others = server.addresses_for_others();
  if (!others.empty())
    fmt::print(console.err,
               "other hosts reach it too: whoever does can look, and whoever has the word can "
               "push\n  {}\n",
               fmt::join(others, "\n  "));
  if (flags.open) open_browser(server.address());
}

}  // namespace reckon::tools
