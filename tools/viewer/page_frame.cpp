// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/tools/viewer/page_frame.hpp"

#include <fmt/format.h>
#include <sodium.h>

#include <algorithm>
#include <array>
#include <set>
#include <span>
#include <utility>

#include "reckon/tools/viewer/web/base64.hpp"

namespace reckon::tools {
namespace {

constexpr std::string_view kStyleLink = R"(<link rel="stylesheet" href="page.css">)";
constexpr std::string_view kScriptLink = R"(<script type="module" src="main.js"></script>)";

/// The file that such a line imports; empty for any other line.
std::string_view imported_by(std::string_view line) {
  constexpr std::string_view kFrom = " from './", kEnd = "';";
  const std::size_t at = line.rfind(kFrom);
  if (!line.starts_with("import ") || at == line.npos || !line.ends_with(kEnd)) return {};
  line.remove_prefix(at + kFrom.size());
  line.remove_suffix(kEnd.size());
  return line;
}

/// Concatenates modules.
class Bundle {
 public:
  explicit Bundle(const ReadPageFile& read) : read_(read) {}

  void add(std::string_view module) {
    if (!done_.insert(module).second) return;
    std::string own;
    std::string_view rest = read_(module);
    while (!rest.empty()) {
      const std::size_t length = std::min(rest.find('\n'), rest.size());
      add_line(rest.substr(0, length), own);
      rest.remove_prefix(std::min(length + 1, rest.size()));
    }
    text_ += own;
  }
  [[nodiscard]] std::string take() { return std::move(text_); }

 private:
  void add_line(std::string_view line, std::string& own) {
    constexpr std::string_view kExport = "export ";
    if (const std::string_view file = imported_by(line); !file.empty()) return add(file);
    if (line.starts_with(kExport)) line.remove_prefix(kExport.size());
    own.append(line) += '\n';
  }

  const ReadPageFile& read_;
  std::set<std::string_view> done_;
  std::string text_;
};

// In the form that a content security policy requires for a script or style.
std::string digest_of(std::string_view text) {
  std::array<unsigned char, crypto_hash_sha256_BYTES> digest{};
  crypto_hash_sha256(digest.data(), reinterpret_cast<const unsigned char*>(text.data()),
                     text.size());
  return base64(std::as_bytes(std::span(digest)));
}

void put_in_place(std::string& text, std::string_view place, std::string_view with) {
  text.replace(text.find(place), place.size(), with);
}

}  // namespace

std::string bundle_modules(std::string_view name, const ReadPageFile& read) {
  Bundle bundle(read);
  bundle.add(name);
  return bundle.take();
}

std::string page_frame(const ReadPageFile& read) {
  const std::string_view css = read("page.css");
  const std::string script = bundle_modules("main.js", read);
  std::string frame(read("index.html"));
  put_in_place(
      frame, kStyleLink,
      fmt::format(R"(<meta http-equiv="Content-Security-Policy" content="default-src 'none'; )"
                  R"(script-src 'sha256-{}'; style-src 'sha256-{}'; img-src data:; )"
                  R"(base-uri 'none'; form-action 'none'"><style>{}</style>)",
                  digest_of(script), digest_of(css), css));
  put_in_place(frame, kScriptLink,
               fmt::format(R"(<script type="application/json" {}</script>)"
                           R"(<script type="module">{}</script>)",
                           kFramePlace, script));
  return frame;
}

std::string filled_frame(std::string_view frame, std::string_view items) {
  const std::size_t place = frame.find(kFramePlace) + kFramePlace.size();
  std::string file(frame.substr(0, place));
  file.reserve(frame.size() + items.size());
  // In JSON, `<` occurs only in strings.
  for (const char letter : items)
    if (letter == '<')
      file += "\\u003c";
    else
      file += letter;
  return file.append(frame.substr(place));
}

}  // namespace reckon::tools
