// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The page as one file with a place for a recorded run. The file makes no request, and its content
// security policy allows only its own script. The page requests it to save a run, and also fills
// it.
#pragma once

#include <functional>
#include <string>
#include <string_view>

namespace reckon::tools {

/// Returns the text of a file of the page by its name, such as "main.js".
using ReadPageFile = std::function<std::string_view(std::string_view name)>;

/// In a frame, the recorded run is inserted after this text.
inline constexpr std::string_view kFramePlace = R"(id="saved">)";

/// A module and all its imports as one script; each module occurs once, before the modules that
/// import it. Imports are lines of the form `import { a, b } from './name.js';`.
[[nodiscard]] std::string bundle_modules(std::string_view name, const ReadPageFile& read);

/// index.html with page.css and main.js inlined.
[[nodiscard]] std::string page_frame(const ReadPageFile& read);

/// A saved file. @param items JSON: the list for replay.js; each `<` is escaped, so that it cannot
/// end its element
[[nodiscard]] std::string filled_frame(std::string_view frame, std::string_view items);

}  // namespace reckon::tools
