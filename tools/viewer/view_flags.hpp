// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The flags that say where a page is served, as the verbs share them.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "reckon/tools/command_line/command_line.hpp"
#include "reckon/tools/viewer/view_server.hpp"

namespace reckon::tools {

/// As typed.
struct ViewFlags {
  std::optional<std::uint64_t> port;
  std::string listen = "127.0.0.1";
  bool open = false;
};

/// Declares --port, --listen and --open.
void add_view_flags(CommandLine& line, ViewFlags& flags);

/// The flags of a verb that serves itself, as typed.
struct ViewSwitch {
  std::string view;    ///< "true" or a port; empty: not given
  std::string listen;  ///< empty: not given
  bool open = false;
};

/// Declares --view[=PORT], --listen and --open.
void add_view_switch(CommandLine& line, ViewSwitch& typed);
/// What they say; nothing where --view was not given.
/// @throws UsageError for what is no port, and for --listen or --open without --view
[[nodiscard]] std::optional<ViewFlags> flags_of_switch(const ViewSwitch& typed);

/// What they mean, with a new word. @throws UsageError for a port that there is not
[[nodiscard]] ViewServerOptions server_options(const ViewFlags& flags);

/// Lines that say that others reach it too, what they may do, and by which addresses.
[[nodiscard]] std::vector<std::string> invitation(const std::vector<std::string>& addresses);

/// Prints the address on out, and on err whom else it lets in, and by which addresses; opens the
/// browser where that is asked for.
void tell_addresses(const ViewServer& server, const ViewFlags& flags, const Console& console);

}  // namespace reckon::tools
