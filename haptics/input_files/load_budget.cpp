// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/haptics/input_files/load_budget.hpp"

#include <string>

#include "reckon/haptics/input_files/load_progress.hpp"

namespace reckon::haptics {
namespace {

struct Limit {
  std::size_t most;
  const char* what;
  const char* remedy;
};
// In the order of LoadWork. docs/robustness.md has the table, with inputs that reach each bound.
constexpr Limit kLimits[kLoadWorks] = {
    {512 << 20, "octets in all files", "use smaller files, or fewer"},
    {10 << 20, "triangles in all meshes and pictures", "use coarser ones, or fewer"},
    {100'000'000, "pairs of corners in faces that are not convex",
     "triangulate the mesh before its export"},
    {1 << 24, "pixels in all pictures", "scale them down, or use fewer"},
    {1'000'000, "rows in all tables of motion", "sample them more coarsely, or use fewer"},
    {20'000'000, "triangles in all copies of meshes with patches", "reduce the copies"},
};

thread_local LoadBudget* current_budget = nullptr;

}  // namespace

LoadBudget::LoadBudget() noexcept : holds_(current_budget == nullptr) {
  if (holds_) current_budget = this;
}

LoadBudget::~LoadBudget() {
  if (holds_) current_budget = nullptr;
}

std::size_t LoadBudget::limit(LoadWork work) noexcept {
  return kLimits[static_cast<std::size_t>(work)].most;
}

void LoadBudget::take(LoadWork work, std::size_t count) {
  LoadProgress::look();
  const auto row = static_cast<std::size_t>(work);
  const Limit& limit = kLimits[row];
  std::size_t none = 0;
  std::size_t& taken = current_budget != nullptr ? current_budget->taken_[row] : none;
  if (count > limit.most - taken)
    throw LoadLimitError("more than " + std::to_string(limit.most) + " " + limit.what + " of one " +
                         "scene; " + limit.remedy);
  taken += count;
}

}  // namespace reckon::haptics
