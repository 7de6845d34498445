// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The flags that say where a page is served, as the verbs share them.
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

/// The flags of a verb that serves itself, as typed.
struct ViewSwitch {
  std::string view;  ///< "true" or a port; empty: not given
  ViewFlags page;    ///< the port is that of --view
};

/// Declares --view[=PORT], --listen, --tls, --behind-tunnel and --open.
void add_view_switch(CommandLine& line, ViewSwitch& typed);
/// What they say; nothing where --view was not given.
/// @throws UsageError for what is no port, and for a flag of the page without --view
[[nodiscard]] std::optional<ViewFlags> flags_of_switch(const ViewSwitch& typed);

/// The first flag that was given, --port aside; empty: none.
[[nodiscard]] std::string_view given_flag(const ViewFlags& flags);

/// What they mean, with a new word. @param has_key the exercise is sealed: the page needs the word,
/// and other hosts reach it by TLS or a tunnel alone
/// @throws UsageError for a port that there is not, for --listen with a key in clear, and as
/// check_tls
[[nodiscard]] ViewServerOptions server_options(const ViewFlags& flags, bool has_key);

/// Lines that say that others reach it too, what they may do, and by which addresses.
[[nodiscard]] std::vector<std::string> invitation(const std::vector<std::string>& addresses,
                                                  bool has_key);

/// Prints the address on out, and on err whom else it lets in, and by which addresses.
void tell_addresses(const ViewServer& server, bool has_key, const Console& console);

/// Opens the browser where that is asked for; what is returned lives as long as the page.
[[nodiscard]] std::unique_ptr<BrowserRedirect> open_browser(const ViewFlags& flags,
                                                            const std::string& address);

}  // namespace reckon::tools
