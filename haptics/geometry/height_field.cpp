// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/haptics/geometry/height_field.hpp"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "reckon/haptics/input_files/load_budget.hpp"

namespace reckon::haptics {
namespace {

using Index = std::uint32_t;

constexpr std::uint32_t kTop = 1, kSide = 2, kBottom = 3;  // materials

void check_length(std::string_view name, double value, double least) {
  if (value >= least && value <= 1e3) return;
  throw std::invalid_argument("heights: " + std::string(name) + " is " + std::to_string(value) +
                              " m: give " + (least > 0.0 ? "0.1 mm" : "0 m") + " to 1 km");
}

/// Numbers the vertices: pixels row by row from the bottom row of the picture, then the feet of its
/// border, then the middle of the bottom.
class SolidMaker {
 public:
  SolidMaker(const HeightsShape& shape, const GreyImage& picture)
      : shape_(shape), picture_(picture), columns_(picture.width), rows_(picture.height) {}

  TriangleSoup make() {
    soup_.names = {"top", "side", "bottom"};
    soup_.vertices.reserve(columns_ * rows_ + 2 * (columns_ + rows_));
    soup_.triangles.reserve(2 * columns_ * rows_ + 4 * (columns_ + rows_));
    add_vertices();
    add_top();
    add_walls();
    return std::move(soup_);
  }

 private:
  [[nodiscard]] Index at(std::size_t column, std::size_t row) const {
    return static_cast<Index>(row * columns_ + column);
  }
  void add_vertices() {
    const double width = shape_.width, x_step = width / static_cast<double>(columns_ - 1);
    const double length = length_of(shape_, picture_);
    const double y_step = length / static_cast<double>(rows_ - 1);
    for (std::size_t row = 0; row < rows_; ++row)
      for (std::size_t column = 0; column < columns_; ++column)
        soup_.vertices.emplace_back(
            static_cast<double>(column) * x_step - 0.5 * width,
            static_cast<double>(row) * y_step - 0.5 * length,
            shape_.height * static_cast<double>(picture_.pixels[at(column, rows_ - 1 - row)]));
  }
  void add(Index a, Index b, Index c, std::uint32_t material) {
    const auto place = static_cast<std::uint32_t>(soup_.triangles.size() + 1);
    soup_.triangles.push_back({{a, b, c}, place, {material, 0}});
  }
  void add_top() {
    for (std::size_t row = 0; row + 1 < rows_; ++row)
      for (std::size_t column = 0; column + 1 < columns_; ++column) {
        const Index a = at(column, row), b = at(column + 1, row);
        const Index c = at(column + 1, row + 1), d = at(column, row + 1);
        add(a, b, c, kTop);
        add(a, c, d, kTop);
      }
  }
  /// Pixels of the border, counterclockwise seen from above.
  [[nodiscard]] std::vector<Index> border() const {
    std::vector<Index> round;
    for (std::size_t i = 0; i + 1 < columns_; ++i) round.push_back(at(i, 0));
    for (std::size_t i = 0; i + 1 < rows_; ++i) round.push_back(at(columns_ - 1, i));
    for (std::size_t i = columns_ - 1; i > 0; --i) round.push_back(at(i, rows_ - 1));
    for (std::size_t i = rows_ - 1; i > 0; --i) round.push_back(at(0, i));
    return round;
  }
  void add_walls() {
    const std::vector<Index> upper = border();
    const auto first = static_cast<Index>(soup_.vertices.size());
    const auto count = static_cast<Index>(upper.size());
    for (const Index vertex : upper) {
      const Eigen::Vector3d above = soup_.vertices[vertex];
      soup_.vertices.emplace_back(above.x(), above.y(), -shape_.base);
    }
    const Index middle = first + count;
    soup_.vertices.emplace_back(0.0, 0.0, -shape_.base);
    for (Index i = 0; i < count; ++i) {
      const Index next = (i + 1) % count;
      add(first + i, first + next, upper[next], kSide);
      add(first + i, upper[next], upper[i], kSide);
      add(middle, first + next, first + i, kBottom);
    }
  }
  const HeightsShape& shape_;
  const GreyImage& picture_;
  std::size_t columns_, rows_;
  TriangleSoup soup_;
};

}  // namespace

GreyImage heights_of(const HeightsShape& shape) {
  check_length("width", shape.width, 1e-4);
  check_length("length", shape.length, 0.0);
  check_length("height", shape.height, 0.0);
  check_length("base", shape.base, 1e-4);
  GreyImage picture = read_image(shape.file);
  if (picture.pixels.size() > kMostFieldPixels)
    throw std::invalid_argument(shape.file.string() + ": has " +
                                std::to_string(picture.pixels.size()) +
                                " pixels, and a solid allows 1048576: scale the picture down");
  try {
    LoadBudget::take(LoadWork::triangles, 2 * picture.pixels.size());
  } catch (const LoadLimitError& error) {
    throw std::invalid_argument(shape.file.string() +
                                ": this picture exceeds a limit: " + error.what());
  }
  return picture;
}

GreyImage thinned(const GreyImage& picture, std::size_t most_pixels) {
  const double share =
      std::sqrt(static_cast<double>(most_pixels) / static_cast<double>(picture.pixels.size()));
  if (share >= 1.0) return picture;
  const auto fewer = [&](std::size_t count) {
    return std::max<std::size_t>(2, static_cast<std::size_t>(share * static_cast<double>(count)));
  };
  GreyImage out{fewer(picture.width), fewer(picture.height), {}};
  for (std::size_t row = 0; row < out.height; ++row) {
    const std::size_t from = row * (picture.height - 1) / (out.height - 1) * picture.width;
    for (std::size_t column = 0; column < out.width; ++column)
      out.pixels.push_back(picture.pixels[from + column * (picture.width - 1) / (out.width - 1)]);
  }
  return out;
}

double length_of(const HeightsShape& shape, const GreyImage& picture) noexcept {
  if (shape.length > 0.0) return shape.length;
  return shape.width * static_cast<double>(picture.height - 1) /
         static_cast<double>(picture.width - 1);
}

TriangleSoup solid_of(const HeightsShape& shape, const GreyImage& picture) {
  return SolidMaker(shape, picture).make();
}

}  // namespace reckon::haptics
