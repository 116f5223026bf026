// How a Bsdf chooses where light comes from.
#include <cmath>

#include "materials/bsdf.hpp"
#include "sampling/hemisphere.hpp"

namespace raytracer {

bool Bsdf::sample(const Vector3f& out, float u_lobe, const Vector2f& u, BsdfSample& sample) const {
  if (is_black_) return false;
  if (is_matt_) return sample_matt(out, u, sample);
  const View* seen = look(out);
  if (seen == nullptr) return false;
  const View& view = *seen;
  const Vector3f& o = view.o;
  const Vector3f mirrored = to_world(view, {-o.x, -o.y, o.z});
  if (u_lobe < view.p_mirror) return finish_delta(sample, mirrored, mirror_ * color_, view.p_mirror, false);
  u_lobe -= view.p_mirror;
  if (u_lobe < view.p_passing) {
    return finish_delta(sample, -out, passing_ * view.coat_passes * color_, view.p_passing, true);
  }
  u_lobe -= view.p_passing;
  Vector3f i;
  if (u_lobe < view.p_coat) {
    if (coat_alpha_ <= 0) {
      const Color3f share((coat_share_ / coat_) * (1 - view.coat_passes));
      return finish_delta(sample, mirrored, share, view.p_coat, false);
    }
    const Vector3f h = coat_facets_.sample_bounded(coat_facets_.eye(o), u);
    i = 2 * glm::dot(o, h) * h - o;
    if (!(i.z > 0)) return false;
  } else if ((u_lobe -= view.p_coat) < view.p_facet) {
    const float rest = std::min(u_lobe / view.p_facet, 1.0F);
    if (alpha_x_ <= 0) return sample_smooth_facet(view, rest, out, sample);
    if (!sample_rough_facet(view, rest, u, i)) return false;
  } else {
    i = sample_cosine(u);
    // What rounding leaves over is the last lobe's that there is.
    if (u_lobe - view.p_facet >= view.p_back ? view.p_through > 0 : !(view.p_back > 0)) i.z = -i.z;
  }
  i *= 1.5F - 0.5F * glm::dot(i, i);  // of unit length but for rounding: a step of Newton's
  const Scattered scattered = scatter(view, i);
  if (!(scattered.pdf > 0 && scattered.pdf < kInfinity)) return false;
  sample.direction = to_world(view, i);
  const float cosine = glm::dot(normal_, sample.direction);
  const float geometric = glm::dot(geometric_normal_, sample.direction);
  if (!((cosine > 0 && geometric > 0) || (cosine < 0 && geometric < 0))) return false;
  sample.weight = scattered.value / scattered.pdf;
  sample.pdf = scattered.pdf;
  sample.is_delta = false;
  sample.is_transmission = i.z < 0;
  return true;
}

bool Bsdf::sample_matt(const Vector3f& out, const Vector2f& u, BsdfSample& sample) const {
  const bool is_above = glm::dot(normal_, out) > 0;
  if (is_above != (glm::dot(geometric_normal_, out) > 0)) return false;
  Vector3f tangent, bitangent;
  complete_frame(normal_, tangent, bitangent);
  const Vector3f i = sample_cosine(u);
  const Vector3f direction = i.x * tangent + i.y * bitangent + (is_above ? i.z : -i.z) * normal_;
  const float geometric = glm::dot(geometric_normal_, direction);
  if (!(i.z > 0) || !(is_above ? geometric > 0 : geometric < 0)) return false;
  // One by one: a whole struct at once is put together in memory first, for twice the time.
  sample.direction = direction;
  sample.weight = color_;
  sample.pdf = cosine_pdf(i.z);
  sample.is_delta = sample.is_transmission = false;
  return true;
}

bool Bsdf::sample_smooth_facet(const View& view, float u_lobe, const Vector3f& out,
                               BsdfSample& sample) const {
  const float p_reflect = view.smooth.reflect_probability();
  const Vector3f& o = view.o;
  if (u_lobe < p_reflect) {
    return finish_delta(sample, to_world(view, {-o.x, -o.y, o.z}), view.coat_passes * view.smooth.reflected,
                        view.p_facet * p_reflect, false);
  }
  const float p_through = view.p_facet * (1 - p_reflect);
  if (is_thin_) return finish_delta(sample, -out, view.coat_passes * view.smooth.through, p_through, true);
  const float eta = sides_[view.side].eta, through = fresnel_dielectric(o.z, eta).cosine_through;
  // The coat counts on its own side, where light is in the end or was in the beginning.
  const float passes = view.is_inside ? coat_passes(through, false) : view.coat_passes;
  return finish_delta(sample, to_world(view, glm::normalize(Vector3f(-o.x / eta, -o.y / eta, -through))),
                      passes * view.smooth.through / (eta * eta), p_through, true);
}

bool Bsdf::sample_rough_facet(const View& view, float u_lobe, const Vector2f& u, Vector3f& i) const {
  const Vector3f h = glass_ > 0 ? facets_.sample_visible(view.eye, u) : facets_.sample_bounded(view.eye, u);
  const float c = glm::dot(view.o, h);
  if (!(c > 0)) return false;
  i = 2 * c * h - view.o;
  if (glass_ <= 0) return i.z > 0;
  const FacetShares shares = facet_shares(view, std::min(1.0F, c));
  if (u_lobe < shares.reflect_probability()) return i.z > 0;
  if (is_thin_) {
    i.z = -i.z;
    return i.z < 0;
  }
  const float eta = sides_[view.side].eta;
  const float through = fresnel_dielectric(std::min(1.0F, c), eta).cosine_through;
  i = (c / eta - through) * h - view.o / eta;
  return i.z < 0;
}

bool Bsdf::finish_delta(BsdfSample& sample, const Vector3f& direction, const Color3f& share,
                        float probability, bool is_transmission) const {
  const float cosine = glm::dot(normal_, direction), geometric = glm::dot(geometric_normal_, direction);
  if (!((cosine > 0 && geometric > 0) || (cosine < 0 && geometric < 0))) return false;
  if (!(probability > 0)) return false;
  sample.direction = direction;
  sample.weight = share / probability;
  sample.pdf = probability;
  sample.is_delta = true;
  sample.is_transmission = is_transmission;
  return true;
}

Vector3f Bsdf::to_world(const View& view, const Vector3f& local) const {
  return local.x * tangent_ + local.y * bitangent_ + (view.is_below ? -local.z : local.z) * normal_;
}

}  // namespace raytracer
