// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/peer/network/application_hold.hpp"

#include <fmt/format.h>
#include <sys/socket.h>
#include <sys/un.h>

#include <algorithm>
#include <cerrno>
#include <cstddef>
#include <fstream>
#include <stdexcept>
#include <system_error>

namespace reckon::peer {
namespace {

constexpr const char* kNoSocket = "cannot create the socket that reserves an application number";

// Connections of programs that want to know the holder of a number. They stay in the queue, because
// the socket is never accepted from.
constexpr int kAsking = 64;

int unix_socket() noexcept {
  return ::socket(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0);
}

/// A name without a file: the kernel frees it with the socket.
struct AbstractName {
  sockaddr_un address{};
  socklen_t length = 0;

  AbstractName(const ApplicationScope& scope, std::uint16_t number) {
    const std::string name = fmt::format("reckon-dis {} {} {}:{}", scope.group.text(),
                                         scope.exercise, scope.site, number);
    address.sun_family = AF_UNIX;
    std::copy(name.begin(), name.end(), address.sun_path + 1);
    length = static_cast<socklen_t>(offsetof(sockaddr_un, sun_path) + 1 + name.size());
  }
  [[nodiscard]] const sockaddr* get() const noexcept {
    return reinterpret_cast<const sockaddr*>(&address);
  }
};

// "process 4711 (truck)", or a less specific description if the kernel does not reveal more.
std::string holder_of(const ApplicationScope& scope, std::uint16_t number) {
  const std::string unknown = "another program";
  const Descriptor asking(unix_socket(), kNoSocket);
  const AbstractName name(scope, number);
  if (::connect(asking.get(), name.get(), name.length) != 0) return unknown;
  ucred holder{};
  socklen_t length = sizeof holder;
  if (::getsockopt(asking.get(), SOL_SOCKET, SO_PEERCRED, &holder, &length) != 0 || holder.pid <= 0)
    return unknown;
  std::string program;
  std::getline(std::ifstream(fmt::format("/proc/{}/comm", holder.pid)), program);
  std::replace_if(
      program.begin(), program.end(), [](char c) { return c < ' ' || c > '~'; }, '?');
  const std::string process = fmt::format("process {}", holder.pid);
  return program.empty() ? process : fmt::format("{} ({})", process, program);
}

}  // namespace

ApplicationHold::ApplicationHold(const ApplicationScope& scope, std::optional<std::uint16_t> wanted)
    : socket_(unix_socket(), kNoSocket) {
  if (wanted) {
    if (*wanted == 0 || *wanted > kMost)
      throw std::invalid_argument(
          fmt::format("application {} is not valid: choose 1 to {}", *wanted, kMost));
    if (hold(scope, *wanted)) return;
    throw std::runtime_error(fmt::format(
        "application {0} of site {1} is used on this host by {2}, and other programs cannot tell "
        "two with one ID apart: choose another application, or none for the next free one",
        *wanted, scope.site, holder_of(scope, *wanted)));
  }
  for (std::uint16_t number = 1; number <= kMost; ++number) {
    if (!hold(scope, number)) continue;
    if (number > 1)
      report_ =
          fmt::format("this is application {} of site {}, because 1 is used on this host by {}",
                      number, scope.site, holder_of(scope, 1));
    return;
  }
  throw std::runtime_error(
      fmt::format("all {} applications of site {} are used on this host: choose another site",
                  kMost, scope.site));
}

// False if another socket has it.
bool ApplicationHold::hold(const ApplicationScope& scope, std::uint16_t number) {
  const AbstractName name(scope, number);
  if (::bind(socket_.get(), name.get(), name.length) != 0) {
    if (errno == EADDRINUSE) return false;
    throw std::system_error(errno, std::generic_category(), kNoSocket);
  }
  if (::listen(socket_.get(), kAsking) != 0)
    throw std::system_error(errno, std::generic_category(), kNoSocket);
  number_ = number;
  return true;
}

}  // namespace reckon::peer
