// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Bounds of the work that the files of one scene may cost, all together. Set-up code.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <stdexcept>

namespace reckon::haptics {

/// Kinds of work, each counted before it is done.
enum class LoadWork : std::uint8_t {
  octets,        ///< of files that are opened
  triangles,     ///< of meshes, and two for each pixel of a solid from a picture
  corner_pairs,  ///< of faces that are not convex: the square of their corners
  pixels,        ///< of pictures
  rows,          ///< of tracks and hand traces
  patches,       ///< triangles of meshes with patches, counted for each object
};
inline constexpr std::size_t kLoadWorks = 6;

/// The files of a scene exceed a bound; the text has the bound and the remedy.
struct LoadLimitError : std::invalid_argument {
  using std::invalid_argument::invalid_argument;
};

/// Counts the work of one pass over the files of a scene. A budget is active for its thread while
/// it exists; one made while another is active counts into that one. Readers deep in the
/// construction of an effect or a shape charge it without a parameter.
class LoadBudget {
 public:
  LoadBudget() noexcept;
  ~LoadBudget();
  LoadBudget(const LoadBudget&) = delete;
  LoadBudget& operator=(const LoadBudget&) = delete;

  /// Charges work before it is done, and lets LoadProgress check its clock. Without a budget each
  /// call is bounded alone. Some nanoseconds.
  /// @throws LoadLimitError if the sum exceeds limit(work); nothing is charged then
  static void take(LoadWork work, std::size_t count);
  /// Greatest amount in one pass.
  [[nodiscard]] static std::size_t limit(LoadWork work) noexcept;

 private:
  bool holds_ = false;
  std::array<std::size_t, kLoadWorks> taken_{};
};

}  // namespace reckon::haptics
