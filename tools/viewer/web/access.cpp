// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/tools/viewer/web/access.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <random>

namespace reckon::tools {
namespace {

// Default ports, which browsers omit.
constexpr std::uint16_t kHttpPort = 80, kHttpsPort = 443;

}  // namespace

Access::Access(const std::vector<std::string>& addresses, std::uint16_t port, std::string word,
               bool is_secure)
    : scheme_(is_secure ? "https://" : "http://"), word_(std::move(word)) {
  for (const std::string& address : addresses) {
    hosts_.push_back(fmt::format("{}:{}", address, port));
    if (port == (is_secure ? kHttpsPort : kHttpPort)) hosts_.push_back(address);
  }
}

bool Access::is_own_host(std::string_view host) const noexcept {
  return std::find(hosts_.begin(), hosts_.end(), host) != hosts_.end();
}

bool Access::is_own_origin(std::string_view origin, std::string_view host) const noexcept {
  return is_own_host(host) && origin.starts_with(scheme_) && origin.substr(scheme_.size()) == host;
}

bool Access::is_word(std::string_view word) const noexcept {
  if (word_.empty() || word.size() != word_.size()) return false;
  unsigned differs = 0;
  for (std::size_t i = 0; i < word_.size(); ++i)
    differs |= static_cast<unsigned>(static_cast<unsigned char>(word[i]) ^
                                     static_cast<unsigned char>(word_[i]));
  return differs == 0;
}

std::string draw_word() {
  std::random_device random;
  std::string word;
  for (int i = 0; i < 4; ++i) word += fmt::format("{:08x}", random());
  return word;
}

}  // namespace reckon::tools
