// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Key files on disk: their permissions, and how one is written.
#include <fcntl.h>
#include <fmt/format.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstring>
#include <span>
#include <string>
#include <string_view>
#include <utility>

#include "reckon/peer/sealing/key_file.hpp"

namespace reckon::peer {
namespace {

constexpr std::size_t kLongestFile = 16384;
constexpr mode_t kOwnerAlone = 0600;

class File {
 public:
  File(const std::filesystem::path& path, int flags)
      : number_(::open(path.c_str(), flags | O_CLOEXEC, kOwnerAlone)) {}
  ~File() { close(); }
  File(const File&) = delete;
  File& operator=(const File&) = delete;

  [[nodiscard]] bool is_open() const { return number_ >= 0; }
  [[nodiscard]] int number() const { return number_; }
  bool close() {
    const int number = std::exchange(number_, -1);
    return number < 0 || ::close(number) == 0;
  }

 private:
  int number_;
};

[[noreturn]] void fail(const std::filesystem::path& path, std::string_view sentence) {
  throw KeyFileError(fmt::format("{}: {}", path.string(), sentence));
}

// Hides the process's memory from core dumps and from debuggers of the same user.
void keep_out_of_core_dumps() noexcept {
  static_cast<void>(::prctl(PR_SET_DUMPABLE, 0));
  rlimit limit{};
  if (::getrlimit(RLIMIT_CORE, &limit) != 0) return;
  limit.rlim_cur = 0;
  static_cast<void>(::setrlimit(RLIMIT_CORE, &limit));
}

/// A text that is erased at its end.
class SecretText {
 public:
  ~SecretText() { wipe(std::as_writable_bytes(std::span(octets_))); }
  [[nodiscard]] bool read(const File& file) {
    while (size_ < octets_.size()) {
      const ssize_t got = ::read(file.number(), octets_.data() + size_, octets_.size() - size_);
      if (got < 0 && errno == EINTR) continue;
      if (got <= 0) return got == 0;
      size_ += static_cast<std::size_t>(got);
    }
    return false;  // longer than any key file
  }
  [[nodiscard]] std::string_view view() const { return {octets_.data(), size_}; }

 private:
  std::array<char, kLongestFile> octets_{};
  std::size_t size_ = 0;
};

bool write_whole(const File& file, std::string_view text) {
  while (!text.empty()) {
    const ssize_t put = ::write(file.number(), text.data(), text.size());
    if (put < 0 && errno == EINTR) continue;
    if (put <= 0) return false;
    text.remove_prefix(static_cast<std::size_t>(put));
  }
  return ::fsync(file.number()) == 0;
}

}  // namespace

void check_owner_alone(const std::filesystem::path& path, int file) {
  struct stat state {};
  if (::fstat(file, &state) != 0 || !S_ISREG(state.st_mode))
    fail(path, "is not a file; name a key file");
  if (state.st_uid != ::geteuid())
    fail(path, fmt::format("belongs to another user (uid {}), who can read and change it: copy it "
                           "to your own file with `install -m 600`",
                           state.st_uid));
  if ((state.st_mode & (S_IRWXG | S_IRWXO)) != 0)
    fail(path, fmt::format("is readable by other users (mode {:04o}): chmod 600 {}",
                           state.st_mode & 07777, path.string()));
}

GroupKey load_group_key(const std::filesystem::path& path) {
  const File file(path, O_RDONLY | O_NONBLOCK);
  if (!file.is_open())
    fail(path, errno == ENOENT ? "does not exist; `reckon key new FILE` creates a key file"
                               : fmt::format("cannot be read: {}", std::strerror(errno)));
  check_owner_alone(path, file.number());
  keep_out_of_core_dumps();
  SecretText text;
  if (!text.read(file)) fail(path, "cannot be read, or is too long for a key file");
  GroupKey key = parse_group_key(text.view(), path.string());
  if (!can_seal(key.suite))
    fail(path,
         "this CPU has no AES instructions; create a key for all members with `reckon key new "
         "--suite xchacha20-poly1305`");
  return key;
}

void save_group_key(const GroupKey& key, const std::filesystem::path& path, bool replace) {
  const std::filesystem::path written = replace ? path.string() + ".new" : path.string();
  File file(written, O_WRONLY | O_CREAT | O_EXCL);
  if (!file.is_open())
    fail(written, errno == EEXIST ? "already exists and is unchanged; name another file"
                                  : fmt::format("cannot be created: {}", std::strerror(errno)));
  std::string text = group_key_text(key);
  const bool good = write_whole(file, text) && file.close() &&
                    (!replace || ::rename(written.c_str(), path.c_str()) == 0);
  const int error = errno;
  wipe(std::as_writable_bytes(std::span(text)));
  if (good) return;
  ::unlink(written.c_str());
  fail(written, fmt::format("cannot be written: {}", std::strerror(error)));
}

}  // namespace reckon::peer
