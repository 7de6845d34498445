// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Flags of the verbs for the address of a page.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "reckon/tools/command_line/command_line.hpp"
#include "reckon/tools/viewer/browser_redirect.hpp"
#include "reckon/tools/viewer/view_server.hpp"

namespace reckon::tools {

/// As typed.
struct ViewFlags {
  std::optional<std::uint64_t> port;
  std::string listen = "127.0.0.1";
  bool open = false;
  std::pair<std::string, std::string> tls;  ///< certificate and key; empty: not given
  bool behind_tunnel = false;
};

/// Declares --port, --listen, --tls, --behind-tunnel and --open.
void add_view_flags(CommandLine& line, ViewFlags& flags);

/// The flags of a verb that can serve its own page, as typed.
struct ViewSwitch {
  std::string view;  ///< "true" or a port; empty: not given
  ViewFlags page;    ///< with the port of --view
};

/// Declares --view[=PORT], --listen, --tls, --behind-tunnel and --open.
void add_view_switch(CommandLine& line, ViewSwitch& typed);
/// Parses them; none if --view was not given.
/// @throws UsageError for an invalid port, and for a flag of the page without --view
[[nodiscard]] std::optional<ViewFlags> flags_of_switch(const ViewSwitch& typed);

/// The first given flag other than --port; empty: none.
[[nodiscard]] std::string_view given_flag(const ViewFlags& flags);

/// Server options for the flags, with a new access word. @param has_key the exercise is sealed: the
/// page needs the word, and other hosts reach it only by TLS or a tunnel
/// @throws UsageError for an invalid port, for --listen with a key without encryption, and as
/// check_tls
[[nodiscard]] ViewServerOptions server_options(const ViewFlags& flags, bool has_key);

/// Lines which state that other hosts can reach the page, what they may do, and the addresses.
[[nodiscard]] std::vector<std::string> invitation(const std::vector<std::string>& addresses,
                                                  bool has_key);

/// Prints the address on out, and the notes about access by other hosts on err.
void tell_addresses(const ViewServer& server, bool has_key, const Console& console);

/// Opens the browser if requested; keep the result as long as the page.
[[nodiscard]] std::unique_ptr<BrowserRedirect> open_browser(const ViewFlags& flags,
                                                            const std::string& address);

}  // namespace reckon::tools
