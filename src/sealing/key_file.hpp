// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The key file. Its holder is a member of a sealed exercise.
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "reckon/peer/sealing/random_source.hpp"
#include "reckon/peer/sealing/sealing_key.hpp"

namespace reckon::peer {

/// One secret of the group and its begin. Erased at its end.
struct GroupEpoch {
  std::uint16_t number = 1;
  std::optional<std::chrono::seconds> from;  ///< UTC since 1970; none: always
  KeyOctets secret{};

  GroupEpoch() = default;
  GroupEpoch(const GroupEpoch&) = default;
  GroupEpoch& operator=(const GroupEpoch&) = default;
  ~GroupEpoch() { wipe(secret); }
};

/// Content of a key file.
///
///   # Whoever can read this takes part.
///   group crane
///   suite aes-256-gcm
///   epoch 1 secret 64 hexadecimal digits
///   epoch 2 from 2026-12-01T06:00:00Z secret 64 hexadecimal digits
struct GroupKey {
  static constexpr std::size_t kMostEpochs = 64;

  std::string group;  ///< for people; 1 to 32 letters, digits, '-', '_' and '.'
  SealingSuite suite = SealingSuite::aes_256_gcm;
  std::vector<GroupEpoch> epochs;  ///< at least one; numbers and times increase

  /// Index of the epoch that is valid at this UTC: the last that has begun, else the first.
  [[nodiscard]] std::size_t epoch_at(std::chrono::nanoseconds utc) const noexcept;
  /// Index of the epoch with this number; nothing if the file has none.
  [[nodiscard]] std::optional<std::size_t> find(std::uint16_t number) const noexcept;
};

/// The key file cannot be used; what() has the place and the remedy, and never a secret.
class KeyFileError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// "aes-256-gcm" or "xchacha20-poly1305"; nothing for another word.
[[nodiscard]] std::optional<SealingSuite> suite_of(std::string_view word) noexcept;
[[nodiscard]] std::string_view word_of_suite(SealingSuite suite) noexcept;

/// "2026-12-01T06:00:00Z", 1970 to 2200. And the inverse.
[[nodiscard]] std::optional<std::chrono::seconds> parse_utc(std::string_view text) noexcept;
[[nodiscard]] std::string utc_text(std::chrono::seconds utc);

/// Reads the text of a key file; `file` is its name in messages.  @throws KeyFileError
[[nodiscard]] GroupKey parse_group_key(std::string_view text, const std::string& file);

/// Checks an open file with a secret: it must belong to the user of this process, and nobody else
/// may read or write it (mode 0600 or less). @param path name of the file in messages
/// @throws KeyFileError with the remedy
void check_owner_alone(const std::filesystem::path& path, int file);

/// Reads the file, checks it with check_owner_alone(), and checks that this CPU supports its suite.
/// From then on the process writes no core dump and cannot be traced (PR_SET_DUMPABLE,
/// RLIMIT_CORE).
/// @throws KeyFileError with the remedy
[[nodiscard]] GroupKey load_group_key(const std::filesystem::path& path);

/// The text of a file that parse_group_key() reads.
[[nodiscard]] std::string group_key_text(const GroupKey& key);

/// Saves the key in a file of mode 0600.
/// @param replace an old file is replaced atomically; else there must be none.
/// @throws KeyFileError
void save_group_key(const GroupKey& key, const std::filesystem::path& path, bool replace);

/// Twelve hexadecimal digits by which people compare secrets without showing them.
[[nodiscard]] std::string fingerprint(const GroupEpoch& epoch);

/// An epoch with a secret drawn at random. @throws RandomSourceError
[[nodiscard]] GroupEpoch draw_epoch(std::uint16_t number, std::optional<std::chrono::seconds> from,
                                    RandomSource random = system_random);

}  // namespace reckon::peer
