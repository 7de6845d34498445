// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Numbers of C++ as numpy arrays, without a copy.
#pragma once

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>

#include <memory>
#include <utility>
#include <vector>

namespace reckon::python {

/// An array of `width` columns (1: of one dimension) over the numbers, which it owns from now on.
template <typename T>
[[nodiscard]] pybind11::array array_of(std::vector<T>&& numbers, pybind11::ssize_t width = 1) {
  auto held = std::make_unique<std::vector<T>>(std::move(numbers));
  const auto rows = static_cast<pybind11::ssize_t>(held->size()) / width;
  const T* const data = held->data();
  const pybind11::capsule owner(held.get(),
                                [](void* all) { delete static_cast<std::vector<T>*>(all); });
  static_cast<void>(held.release());
  std::vector<pybind11::ssize_t> shape{rows};
  if (width > 1) shape.push_back(width);
  return pybind11::array_t<T>(std::move(shape), data, owner);
}

}  // namespace reckon::python
