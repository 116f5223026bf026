#include "textures/image_texture.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <utility>

#include "core/lane_math.hpp"
#include "textures/texture_block.hpp"

namespace raytracer {
namespace {

/// What a footprint averages over: probes along a line, each of them round.
struct Probes {
  int level = 0;         // of the pyramid
  float next_share = 0;  // how much of the next level is mixed in
  int count = 1;
  Vector2f half_line{0};  // from the middle to the line's end, in texels of level 0
};

constexpr int kMostProbes = 64;

/// A look at level l, being bilinear between averages of 4^l texels, blurs what level 0 shows by a variance
/// of (4^l - 1) / 4 texels: (4^l - 1) / 12 of the averages and (4^l - 1) / 6 of the slopes between them. The
/// level, and the share of the next, that blur by `variance`.
void choose_level(float variance, int level_count, Probes& probes) {
  const float scale = 1 + 4 * variance;  // 4^l
  const int level = std::ilogb(scale) / 2;
  if (level >= level_count - 1) {
    probes.level = level_count - 1;
    return;
  }
  const float size = std::ldexp(1.0f, 2 * level);
  probes.level = level;
  probes.next_share = (scale - size) / (3 * size);
}

/// The ellipse that has the second moments of the parallelogram between `dx` and `dy`, in texels.
struct Ellipse {
  float long_variance = 0, short_variance = 0;
  Vector2f axis{1, 0};  // unit length, the long one
};

Ellipse ellipse_of(const Vector2f& dx, const Vector2f& dy) {
  // A side of length d, evenly covered, has the variance d^2 / 12.
  const float xx = (dx.x * dx.x + dy.x * dy.x) / 12, yy = (dx.y * dx.y + dy.y * dy.y) / 12;
  const float xy = (dx.x * dx.y + dy.x * dy.y) / 12;
  const float mean = 0.5f * (xx + yy), half = 0.5f * (xx - yy);
  const float radius = std::sqrt(half * half + xy * xy);
  Ellipse ellipse{mean + radius, std::max(mean - radius, 0.0f)};
  const Vector2f axis = half > 0 ? Vector2f(half + radius, xy) : Vector2f(xy, radius - half);
  const float length = glm::length(axis);
  if (length > 0) ellipse.axis = axis / length;
  return ellipse;
}

Probes probes_for(const Ellipse& ellipse, int level_count) {
  Probes probes;
  float round = ellipse.short_variance;
  // Half of a line, evenly covered, that has the variance which the round probes lack.
  const auto half_length = [&] { return std::sqrt(3 * std::max(ellipse.long_variance - round, 0.0f)); };
  const auto spacing = [&] { return std::sqrt(1 + 4 * round); };  // a texel of the level
  float length = half_length();
  if (2 * length > kMostProbes * spacing()) {
    const float wider = 2 * length / kMostProbes;
    round = (wider * wider - 1) / 4;
    length = half_length();
  }
  choose_level(round, level_count, probes);
  probes.count = std::clamp(static_cast<int>(std::ceil(2 * length / spacing())), 1, kMostProbes);
  probes.half_line = length * ellipse.axis;
  return probes;
}

class ImageTexture final : public Texture {
 public:
  ImageTexture(std::shared_ptr<const TexelPyramid> pyramid, const TexturePlacement& placement, bool is_mean)
      : pyramid_(std::move(pyramid)),
        offset_(placement.offset),
        wrap_(placement.wrap),
        is_mean_(is_mean),
        size_(pyramid_->width(), pyramid_->height()) {
    const auto angle = static_cast<double>(placement.rotate);
    const auto cosine = static_cast<float>(cosine_of_degrees(angle));
    const auto sine = static_cast<float>(sine_of_degrees(angle));
    along_u_ = placement.scale * Vector2f(cosine, sine);
    along_v_ = placement.scale * Vector2f(-sine, cosine);
  }

  Color3f at(const TexturePoint& point) const override {
    const Vector2f uv = placed(point.uv) + offset_, dx = placed(point.uv_dx), dy = placed(point.uv_dy);
    return finished(point.is_rough    ? somewhere(uv, texels_of(dx, dy))
                    : point.is_coarse ? over_parallelogram(uv, dx, dy)
                                      : average(uv, dx, dy, kSmallOfMany));
  }

  void colors_at(const TextureBlock& points, ColorBlock& colors) const override {
    Vector2Block uv, dx, dy;
    for (int i = 0; i < kBlockSize; ++i) {
      uv.set(i, placed(points.uv.at(i)) + offset_);
      dx.set(i, placed(points.uv_dx.at(i)));
      dy.set(i, placed(points.uv_dy.at(i)));
    }
    alignas(64) float texels[kBlockSize];
    if (points.is_rough) {
      for (int i = 0; i < kBlockSize; ++i) texels[i] = texels_of(dx.at(i), dy.at(i));
      for (int i = 0; i < points.count; ++i) colors.set(i, finished(somewhere(uv.at(i), texels[i])));
    } else {
      BlockMask is_large;
      for (int i = 0; i < kBlockSize; ++i) is_large.set(i, !is_small(dx.at(i), dy.at(i), kSmallOfMany));
      pyramid_->bilinear(uv, points.count, wrap_, colors);
      for (int i = 0; i < points.count; ++i) {
        if (is_large.has(i)) colors.set(i, average(uv.at(i), dx.at(i), dy.at(i), kSmallOfMany));
      }
      for (int i = 0; i < kBlockSize; ++i) colors.set(i, finished(colors.at(i)));
    }
  }

  bool is_exact() const override { return true; }

 private:
  Vector2f placed(const Vector2f& uv) const { return uv.x * along_u_ + uv.y * along_v_; }

  Color3f finished(const Color3f& color) const {
    return is_mean_ ? Color3f((color.x + color.y + color.z) / 3) : color;
  }

  // How many texels lie in a footprint.
  float texels_of(const Vector2f& dx, const Vector2f& dy) const {
    return std::abs(dx.x * dy.y - dx.y * dy.x) * size_.x * size_.y;
  }

  // One look at the level whose texels are about as large as the footprint.
  Color3f somewhere(const Vector2f& uv, float texels) const {
    constexpr int kExponent = 23, kBias = 127;
    const bool is_some = texels >= 2 && texels < kInfinity;
    const int exponent = (std::bit_cast<std::int32_t>(texels) >> kExponent) - kBias;
    const int level = is_some ? (exponent + 1) / 2 : 0;
    return pyramid_->nearest(std::min(level, pyramid_->level_count() - 1), uv, wrap_);
  }

  // Half a texel is blurred more by being bilinear than by its size. Of samples with many neighbours, which
  // will show what is lost between them, that goes for a whole one.
  static constexpr float kSmall = 0.25f, kSmallOfMany = 2;

  // A look blurs softly beyond what it stands for. Four of a quarter each come close to the parallelogram
  // that a sample stands for: the error of the strongest detail, black and white noise, falls from 3.1 to 1.4
  // of 255.
  Color3f over_parallelogram(const Vector2f& uv, const Vector2f& dx, const Vector2f& dy) const {
    if (is_small(dx, dy, kSmall)) return pyramid_->bilinear(0, uv, wrap_);
    const Vector2f right = 0.5f * dx, below = 0.5f * dy;
    const Vector2f corner = uv - 0.5f * (right + below);
    const auto quarter = [&](const Vector2f& from) { return average(from, right, below, kSmall); };
    return 0.25f * (quarter(corner) + quarter(corner + right) + quarter(corner + below) +
                    quarter(corner + right + below));
  }

  bool is_small(const Vector2f& dx, const Vector2f& dy, float small) const {
    const Vector2f right = dx * size_, below = dy * size_;
    const bool is_between_texels = glm::dot(right, right) + glm::dot(below, below) < small;
    return is_between_texels || pyramid_->level_count() == 1;
  }

  Color3f average(const Vector2f& uv, const Vector2f& dx, const Vector2f& dy, float small) const {
    if (is_small(dx, dy, small)) return pyramid_->bilinear(0, uv, wrap_);
    const Ellipse ellipse = ellipse_of(dx * size_, dy * size_);
    constexpr float kEndless = 1e15f;  // so far beyond any picture that only the average of all is left
    if (!(ellipse.short_variance < kEndless && ellipse.long_variance < kEndless * kEndless)) {
      return pyramid_->bilinear(pyramid_->level_count() - 1, uv, wrap_);
    }
    const Probes probes = probes_for(ellipse, pyramid_->level_count());
    const Vector2f step = probes.half_line / size_ * (2.0f / static_cast<float>(probes.count));
    Color3f sum(0);
    for (int i = 0; i < probes.count; ++i) {
      const float place = static_cast<float>(i) - 0.5f * static_cast<float>(probes.count - 1);
      sum += look(probes, uv + place * step);
    }
    return sum / static_cast<float>(probes.count);
  }

  Color3f look(const Probes& probes, const Vector2f& uv) const {
    constexpr float kTooLittle = 1.0f / 64;
    if (probes.next_share < kTooLittle) return pyramid_->bilinear(probes.level, uv, wrap_);
    const Color3f next = pyramid_->bilinear(probes.level + 1, uv, wrap_);
    if (probes.next_share > 1 - kTooLittle) return next;
    const Color3f color = pyramid_->bilinear(probes.level, uv, wrap_);
    return color + probes.next_share * (next - color);
  }

  std::shared_ptr<const TexelPyramid> pyramid_;
  Vector2f along_u_{1, 0}, along_v_{0, 1}, offset_;
  TextureWrap wrap_;
  bool is_mean_;
  Vector2f size_;
};

}  // namespace

TexturePointer make_image_texture(std::shared_ptr<const TexelPyramid> pyramid,
                                  const TexturePlacement& placement) {
  const bool is_mean = pyramid->is_mean();
  return std::make_shared<ImageTexture>(std::move(pyramid), placement, is_mean);
}

}  // namespace raytracer
