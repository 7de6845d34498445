// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The page as one file, and a place in it for what it plays: no request leaves it, and its content
// policy lets its own script alone run. The page asks for it where it saves, and fills it too.
#pragma once

#include <functional>
#include <string>
#include <string_view>

namespace reckon::tools {

/// Gives the text of a file of the page by its name, as in "main.js".
using ReadPageFile = std::function<std::string_view(std::string_view name)>;

/// Behind it in a frame belongs what the page plays.
inline constexpr std::string_view kFramePlace = R"(id="saved">)";

/// A module and all that it imports, each once and before who imports it, as one script. Imports
/// are lines of the form `import { a, b } from './name.js';`.
[[nodiscard]] std::string bundle_modules(std::string_view name, const ReadPageFile& read);

/// index.html with page.css and main.js in itself.
[[nodiscard]] std::string page_frame(const ReadPageFile& read);

/// A saved file. @param items JSON: the list of replay.js; no `<` of it ends the place that it is
/// in
[[nodiscard]] std::string filled_frame(std::string_view frame, std::string_view items);

}  // namespace reckon::tools
