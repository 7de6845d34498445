// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The flags that say where a page is served, as the verbs share them.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

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

/// The flag of a verb that serves itself: --view[=PORT].
void add_view_switch(CommandLine& line, std::string& view);
/// What it says; nothing where it was not given. @throws UsageError for what is no port
[[nodiscard]] std::optional<ViewFlags> flags_of_switch(const std::string& view);

/// What they mean, with a new word. @throws UsageError for a port that there is not
[[nodiscard]] ViewServerOptions server_options(const ViewFlags& flags);

/// Prints the address on out, and on err whom else it lets in, and by which addresses; opens the
/// browser where that is asked for.
void tell_addresses(const ViewServer& server, const ViewFlags& flags, const Console& console);

}  // namespace reckon::tools
