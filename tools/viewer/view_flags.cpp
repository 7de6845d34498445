// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/tools/viewer/view_flags.hpp"

#include <fmt/format.h>

#include <charconv>
#include <cstdio>
#include <stdexcept>
#include <system_error>

namespace reckon::tools {

namespace {

void add_common_flags(CommandLine& line, ViewFlags& flags) {
  line.option("--listen", flags.listen,
              "address to serve the page on (default: 127.0.0.1, only this host; 0.0.0.0: all)");
  line.option("--tls", flags.tls,
              "serve the page over HTTPS with this certificate and its key (PEM)", "CERT KEY");
  line.flag("--behind-tunnel", flags.behind_tunnel,
            "with a key: permit --listen without --tls, because only a VPN or SSH tunnel reaches "
            "that address");
  line.flag("--open", flags.open, "open the page in the browser of this host");
}

bool is_of_this_host(const std::string& address) {
  return address.starts_with("127.") || address == "::1";
}

}  // namespace

void add_view_flags(CommandLine& line, ViewFlags& flags) {
  line.option("--port", flags.port,
              "TCP port of the page (default: 8642 or the next free; 0: any)");
  add_common_flags(line, flags);
}

void add_view_switch(CommandLine& line, ViewSwitch& typed) {
  line.flag("--view", typed.view,
            "serve a browser page on this port (--view=9000; default: 8642 or the next free)");
  add_common_flags(line, typed.page);
}

std::string_view given_flag(const ViewFlags& flags) {
  if (flags.open) return "--open";
  if (!flags.tls.first.empty()) return "--tls";
  if (flags.behind_tunnel) return "--behind-tunnel";
  return flags.listen == ViewFlags().listen ? "" : "--listen";
}

std::optional<ViewFlags> flags_of_switch(const ViewSwitch& typed) {
  const std::string& view = typed.view;
  if (view.empty() || view == "false") {
    if (const std::string_view given = given_flag(typed.page); !given.empty())
      throw UsageError(fmt::format("{} needs a page: add --view", given));
    return std::nullopt;
  }
  ViewFlags flags = typed.page;
  if (view == "true") return flags;
  std::uint64_t port = 0;
  const auto [end, error] = std::from_chars(view.data(), view.data() + view.size(), port);
  if (error != std::errc() || end != view.data() + view.size())
    throw UsageError(
        fmt::format("--view={}: write a port, as in --view=9000, or --view alone", view));
  flags.port = port;
  return flags;
}

ViewServerOptions server_options(const ViewFlags& flags, bool has_key) {
  constexpr std::uint64_t kLastPort = 65535;
  if (flags.port && *flags.port > kLastPort)
    throw UsageError(fmt::format("port {} of the page: write 0 to {}; 0 chooses a free one",
                                 *flags.port, kLastPort));
  const bool has_tls = !flags.tls.first.empty();
  if (has_key && !has_tls && !flags.behind_tunnel && !is_of_this_host(flags.listen))
    throw UsageError(fmt::format(
        "--listen {}: this exercise has a key, and its page would cross the network unencrypted: "
        "add --tls CERT KEY, or --behind-tunnel if only a VPN or SSH tunnel reaches that address",
        flags.listen));
  ViewServerOptions options;
  options.address = flags.listen;
  if (flags.port) options.port = static_cast<std::uint16_t>(*flags.port);
  options.word = draw_word();
  options.needs_word = has_key;
  options.tls = {flags.tls.first, flags.tls.second};
  try {
    if (has_tls) check_tls(options.tls);
  } catch (const std::runtime_error& error) {
    throw UsageError(error.what());
  }
  return options;
}

std::vector<std::string> invitation(const std::vector<std::string>& addresses, bool has_key) {
  std::vector<std::string> lines{has_key
                                     ? "other hosts can open the page with its word, and push:"
                                     : "other hosts can open the page, and push with its word:"};
  for (const std::string& address : addresses) lines.push_back("  " + address);
  return lines;
}

void tell_addresses(const ViewServer& server, bool has_key, const Console& console) {
  fmt::print(console.out, "{}\n", server.address());
  std::fflush(console.out);
  const std::vector<std::string> others = server.addresses_for_others();
  if (!others.empty())
    fmt::print(console.err, "{}\n", fmt::join(invitation(others, has_key), "\n"));
}

std::unique_ptr<BrowserRedirect> open_browser(const ViewFlags& flags, const std::string& address) {
  return flags.open ? std::make_unique<BrowserRedirect>(address) : nullptr;
}

}  // namespace reckon::tools
