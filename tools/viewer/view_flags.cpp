// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/tools/viewer/view_flags.hpp"

#include <fmt/format.h>

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

ViewServerOptions server_options(const ViewFlags& flags) {
  constexpr std::uint64_t kLastPort = 65535;
  if (flags.port && *flags.port > kLastPort)
    throw UsageError(fmt::format("--port {}: ports are 0 to {}", *flags.port, kLastPort));
  ViewServerOptions options;
  options.address = flags.listen;
  if (flags.port) options.port = static_cast<std::uint16_t>(*flags.port);
  options.word = draw_word();
  return options;
}

void tell_address(const std::string& address, const ViewFlags& flags, const Console& console) {
  fmt::print(console.out, "{}\n", address);
  std::fflush(console.out);
  ViewServerOptions options;
  options.address = flags.listen;
  const std::string opened = opened_text(options);
  if (!opened.empty()) fmt::print(console.err, "{}\n", opened);
  if (flags.open) open_browser(address);
}

}  // namespace reckon::tools
