// A sky that was photographed.
#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <cstddef>
#include <utility>

#include "core/numeric.hpp"
#include "core/parallel.hpp"
#include "lights/environments.hpp"
#include "lights/sphere_distribution.hpp"
#include "raytracer/error.hpp"

namespace raytracer {

namespace {

/// The table to choose from has at most so many cells; of a larger picture each stands for a block of pixels.
constexpr std::size_t kMostCells = std::size_t{1} << 23U;

using Size = std::size_t;

/// Pixels first .. end - 1 of `size` that a cell of `count` covers, in whole or in part.
struct Range {
  Size first, end;
};
Range covered(Size cell, Size count, Size size) {
  return {cell * size / count, std::min(((cell + 1) * size + count - 1) / count, size)};
}

/// How much the pixel (or row) at `offset` from a range's first counts in the integral, over the range, of
/// what lies linearly between pixel centres: each reaches half a pixel beyond its own square on either side,
/// where an eighth of it lies. offset -1 and length are the neighbours.
float weight_in_range(std::ptrdiff_t offset, std::ptrdiff_t length) {
  if (offset < 0 || offset >= length) return 0.125F;
  return 1 - (offset == 0 ? 0.125F : 0.0F) - (offset == length - 1 ? 0.125F : 0.0F);
}

/// How much each cell shines, by the largest channel.
class CellWeights {
 public:
  explicit CellWeights(const EnvironmentPicture& picture)
      : rgb_(picture.rgb.data()),
        width_(static_cast<Size>(picture.width)),
        height_(static_cast<Size>(picture.height)) {
    Size block = 1;
    while ((width_ / block) * (height_ / block) > kMostCells) ++block;
    columns = std::max<Size>(width_ / block, 1);
    rows = std::max<Size>(height_ / block, 1);
    weights.resize(columns * rows);
    parallel_for(rows, [this](Size row) { fill_row(row); });
  }

  Size columns, rows;
  std::vector<float> weights;

 private:
  void fill_row(Size row) {
    const Range range = covered(row, rows, height_);
    std::vector<float> sums(width_, 0.0F);  // of the rows, weighted
    const auto length = static_cast<std::ptrdiff_t>(range.end - range.first);
    for (std::ptrdiff_t i = -1; i <= length; ++i) {
      const std::ptrdiff_t y = std::clamp<std::ptrdiff_t>(static_cast<std::ptrdiff_t>(range.first) + i, 0,
                                                          static_cast<std::ptrdiff_t>(height_) - 1);
      const float* pixels = rgb_ + static_cast<Size>(y) * width_ * 3;
      const float weight = weight_in_range(i, length) / static_cast<float>(length);
      for (Size x = 0; x < width_; ++x) {
        const float* p = pixels + 3 * x;
        const float more = p[1] > p[2] ? p[1] : p[2];
        sums[x] += weight * (p[0] > more ? p[0] : more);
      }
    }
    for (Size column = 0; column < columns; ++column) {
      const Range across = covered(column, columns, width_);
      const auto count = static_cast<std::ptrdiff_t>(across.end - across.first);
      float sum = 0;
      for (std::ptrdiff_t i = -1; i <= count; ++i) {
        const Size x = (across.first + width_ + static_cast<Size>(i + 1) - 1) % width_;
        sum += weight_in_range(i, count) * sums[x];
      }
      weights[row * columns + column] = sum / static_cast<float>(count);
    }
  }

  const float* rgb_;
  Size width_, height_;
};

/// Makes every value a radiance; returns the mean over all directions, and whether it is the same everywhere.
std::pair<Color3f, bool> clean(EnvironmentPicture& picture) {
  const auto width = static_cast<Size>(picture.width), height = static_cast<Size>(picture.height);
  const Color3f first(picture.rgb[0], picture.rgb[1], picture.rgb[2]);
  std::atomic<bool> is_constant{true};
  std::vector<Vector3d> sums(height);
  parallel_for(height, [&](Size y) {
    float* row = picture.rgb.data() + y * width * 3;
    bool is_same = true, is_good = true;
    for (Size i = 0; i < 3 * width; ++i) is_good &= row[i] >= 0 && row[i] < kInfinity;
    if (!is_good) {
      for (Size i = 0; i < 3 * width; ++i) row[i] = row[i] >= 0 && row[i] < kInfinity ? row[i] : 0.0F;
    }
    Vector3d sum(0.0);
    for (Size x = 0; x < width; ++x) {
      const Color3f color(row[3 * x], row[3 * x + 1], row[3 * x + 2]);
      is_same &= color == first;
      sum += Vector3d(color);
    }
    if (!is_same) is_constant.store(false, std::memory_order_relaxed);
    const double angle = kPi / static_cast<double>(height);
    const double solid_share = std::sin(angle * (static_cast<double>(y) + 0.5)) * std::sin(0.5 * angle);
    sums[y] = solid_share / static_cast<double>(width) * sum;
  });
  Vector3d mean(0.0);
  for (const Vector3d& one : sums) mean += one;
  return {Color3f(mean), is_constant.load()};
}

class ImageSky final : public Environment {
 public:
  ImageSky(EnvironmentPicture picture, const Color3f& mean, double strength, const glm::dmat3& to_world)
      : picture_(std::move(picture)),
        strength_(static_cast<float>(strength)),
        mean_(strength_ * mean),
        to_world_(to_world),
        to_picture_(glm::transpose(to_world)) {
    CellWeights cells(picture_);
    distribution_ = SphereDistribution(static_cast<int>(cells.columns), static_cast<int>(cells.rows),
                                       std::move(cells.weights));
  }

  Color3f radiance(const Vector3f& direction) const override {
    const Vector2f place = place_of_direction(to_picture_ * direction);
    const float x = place.x * static_cast<float>(picture_.width) - 0.5F;
    const float y = place.y * static_cast<float>(picture_.height) - 0.5F;
    const float left = std::floor(x), top = std::floor(y);
    const int column = static_cast<int>(left), row = static_cast<int>(top);
    const Color3f above = glm::mix(pixel(column, row), pixel(column + 1, row), x - left);
    const Color3f below = glm::mix(pixel(column, row + 1), pixel(column + 1, row + 1), x - left);
    return strength_ * glm::mix(above, below, y - top);
  }

  bool sample(const Vector2f& u, Vector3f& direction, float& pdf_there) const override {
    if (distribution_.is_empty()) return false;
    distribution_.sample(u, direction, pdf_there);
    direction = to_world_ * direction;
    return pdf_there > 0;
  }

  float pdf(const Vector3f& direction) const override { return distribution_.pdf(to_picture_ * direction); }

  Color3f mean() const override { return mean_; }

 private:
  Color3f pixel(int column, int row) const {
    const int width = picture_.width;
    column = column < 0 ? column + width : column >= width ? column - width : column;
    row = std::clamp(row, 0, picture_.height - 1);
    const float* p = picture_.rgb.data() +
                     3 * (static_cast<Size>(row) * static_cast<Size>(width) + static_cast<Size>(column));
    return {p[0], p[1], p[2]};
  }

  EnvironmentPicture picture_;
  float strength_;
  Color3f mean_;
  glm::mat3 to_world_, to_picture_;
  SphereDistribution distribution_;
};

}  // namespace

std::shared_ptr<const Environment> make_image_sky(EnvironmentPicture picture, double strength,
                                                  const glm::dmat3& to_world) {
  if (picture.width <= 0 || picture.height <= 0 ||
      picture.rgb.size() != 3 * static_cast<Size>(picture.width) * static_cast<Size>(picture.height)) {
    throw Error(ErrorKind::kScene, "a sky's picture has no pixels");
  }
  if (!(strength >= 0) || !std::isfinite(strength)) {
    throw Error(ErrorKind::kScene, "a sky's strength must be a number that is not below 0");
  }
  const auto [mean, is_constant] = clean(picture);
  if (is_constant || strength == 0) {
    return make_constant_sky(static_cast<float>(strength) *
                             Color3f(picture.rgb[0], picture.rgb[1], picture.rgb[2]));
  }
  return std::make_shared<ImageSky>(std::move(picture), mean, strength, to_world);
}

}  // namespace raytracer
