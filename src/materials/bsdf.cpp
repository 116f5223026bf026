#include "materials/bsdf.hpp"

#include <cmath>

#include "sampling/hemisphere.hpp"

namespace raytracer {

namespace {

float cosine_of(const Vector3f& v) { return std::min(1.0F, std::abs(v.z)); }
float largest(const Color3f& c) { return std::max(c.x, std::max(c.y, c.z)); }

}  // namespace

// --- parts of values
// ------------------------------------------------------------------------------------------

Color3f Bsdf::metal_fresnel(float cosine) const {
  return is_measured_ ? color_ * fresnel_conductor(conductor_, cosine) : fresnel_schlick(metal_f0_, cosine);
}

Bsdf::FacetShares Bsdf::facet_shares(const View& view, float cosine) const {
  FacetShares shares{Color3f(0), Color3f(0)};
  if (metal_ > 0) shares.reflected = metal_ * metal_fresnel(cosine);
  if (opaque_ > 0 && specular_ > 0) {
    shares.reflected += Color3f(opaque_ * specular_ * fresnel_dielectric(cosine, layer_eta_).reflectance);
  }
  if (glass_ > 0) {
    const Boundary boundary = fresnel_dielectric(cosine, sides_[view.side].eta);
    float reflectance = boundary.is_total ? 1.0F : specular_ * boundary.reflectance;
    if (is_thin_) reflectance = both_faces(reflectance);
    shares.reflected += Color3f(glass_ * reflectance);
    shares.through = glass_ * (1 - reflectance) * color_;
    // From inside, what goes through meets the coat beyond, which throws its share back.
    if (coat_ > 0 && view.is_inside) {
      const float passes = coat_passes(boundary.cosine_through, false);
      shares.reflected += (1 - passes) * shares.through * color_;
    }
  }
  return shares;
}

float Bsdf::mirror_loss(const Vector3f& v) const {
  if (!is_isotropic_) return 1 - DrawnReflectionTable::get().mirror(drawn_cell_, v);
  return 1 - reflection_->mirror(cell_, cosine_of(v));
}

float Bsdf::glass_loss(const GlassSide& side, const Vector3f& v) const {
  if (is_thin_) return mirror_loss(v);
  if (!is_isotropic_) return 1 - DrawnGlassTable::get().albedo(drawn_cell_, side.eta_cell, specular_, v);
  return 1 - GlassTable::get().albedo(glass_cell_, side.eta_cell, specular_, cosine_of(v));
}

float Bsdf::layer_passes(const Vector3f& v) const {
  if (specular_ <= 0 || layer_eta_ <= 1) return 1;
  if (alpha_x_ <= 0) return 1 - specular_ * fresnel_dielectric(cosine_of(v), layer_eta_).reflectance;
  const float reflected =
      is_isotropic_ ? reflection_->boundary(cell_, layer_eta_cell_, layer_eta_, cosine_of(v))
                    : DrawnReflectionTable::get().boundary(drawn_cell_, layer_eta_cell_, layer_eta_, v);
  return 1 - specular_ * reflected;
}

float Bsdf::coat_passes(float cosine, bool is_inside) const {
  if (coat_ <= 0 || is_inside) return 1;
  if (coat_alpha_ <= 0) return 1 - coat_ * fresnel_dielectric(cosine, coat_eta_).reflectance;
  return 1 - coat_ * reflection_->boundary(coat_cell_, coat_eta_cell_, coat_eta_, cosine);
}

float Bsdf::coat_loss(const Vector3f& v) const {
  return coat_loss_share_ * CoatTable::get().loss(coat_base_cell_, coat_loss_cell_, cosine_of(v));
}

// Light from a matt lobe below the coat: what goes in at o and comes out at i, and what the coat throws back
// from below, the share 1 - T of diffuse light, and the lobe returns again: a geometric series, T(o) T(i)
// (1 + a (1 - T) + ...). With a white lobe nothing is lost, and reversed it is the same (as Kulla and Conty
// 2017 do between facets; the coat does not bend light here, so its mean is the same from below).
Color3f Bsdf::coated(const View& view, float i_passes, const Color3f& albedo) const {
  return view.coat_passes * i_passes / (Color3f(1) - albedo * (1 - coat_mean_passes_));
}

// The base under its layer: what goes in at o and comes out at i, and what the layer throws back from below
// goes round until it is out, hence the mean. With a white base nothing is lost, reversed it is the same
// (Ashikhmin, Premoze and Shirley 2000, "A Microfacet-based BRDF Generator", equation 15, with the layer's
// true albedo).
Color3f Bsdf::matt_reflection(const View& view, const Vector3f& i, float i_passes) const {
  const bool has_coat = coat_ > 0 && !view.is_inside;
  Color3f result{0};
  if (opaque_ > 0) {
    result = color_ * (opaque_ * view.layer_passes * layer_passes(i) / layer_mean_passes_);
    if (has_coat) result *= coated(view, i_passes, color_);
  }
  if (metal_ > 0 && mirror_mean_loss_ > 0) {
    Color3f metal = metal_multiple_ * (metal_ * view.mirror_loss * mirror_loss(i) / mirror_mean_loss_);
    if (has_coat) metal *= coated(view, i_passes, metal_mean_);
    result += metal;
  }
  // What facets return and the coat throws back, they return once more.
  if (metal_ > 0 && view.coat_loss > 0) {
    result += metal_mean_ * metal_mean_ * (metal_ * view.coat_loss * coat_loss(i) / coat_mean_loss_);
  }
  const GlassSide& side = sides_[view.side];
  if (glass_ > 0 && side.mean_loss > 0) {
    // From inside, what a coat beyond throws back comes here, too.
    const float thrown_back = view.is_inside ? side.through * (1 - coat_mean_passes_) : 0.0F;
    Color3f glass(glass_ * view.glass_loss * glass_loss(side, i) / side.mean_loss);
    glass *= Color3f(side.back) + thrown_back * color_ * color_;
    if (has_coat) glass *= coated(view, i_passes, Color3f(1));
    result += glass;
  }
  return result;
}

Color3f Bsdf::matt_transmission(const View& view, const Vector3f& i) const {
  const float squeezed = is_thin_ ? 1.0F : sides_[view.side].eta * sides_[view.side].eta;
  return color_ * (glass_ * sides_[view.side].through * view.glass_loss *
                   glass_loss(sides_[view.other_side], i) / (sides_[view.other_side].mean_loss * squeezed));
}

// --- what out sees
// --------------------------------------------------------------------------------------------

const Bsdf::View* Bsdf::look(const Vector3f& out) const {
  if (out != looked_from_) {
    looked_from_ = out;
    can_look_ = look_anew(out, view_);
  }
  return can_look_ ? &view_ : nullptr;
}

bool Bsdf::look_anew(const Vector3f& out, View& view) const {
  const float cosine = glm::dot(normal_, out), geometric = glm::dot(geometric_normal_, out);
  if (!((cosine > 0 && geometric > 0) || (cosine < 0 && geometric < 0))) return false;
  view.is_below = cosine < 0;
  view.o = {glm::dot(tangent_, out), glm::dot(bitangent_, out), std::min(1.0F, std::abs(cosine))};
  const bool is_solid = !is_thin_ && (glass_ > 0 || passing_ > 0);
  view.is_inside = view.is_below && is_solid;
  view.side = view.is_below && !is_thin_ ? 1 : 0;
  view.other_side = view.is_below || is_thin_ ? 0 : 1;
  view.coat_passes = coat_passes(view.o.z, view.is_inside);
  view.layer_passes = opaque_ > 0 ? layer_passes(view.o) : 1.0F;
  view.mirror_loss = mirror_mean_loss_ > 0 ? mirror_loss(view.o) : 0.0F;
  view.glass_loss =
      glass_ > 0 && sides_[view.side].mean_loss > 0 ? glass_loss(sides_[view.side], view.o) : 0.0F;
  view.coat_loss = coat_mean_loss_ > 0 && !view.is_inside ? coat_loss(view.o) : 0.0F;
  if (alpha_x_ > 0) view.eye = facets_.eye(view.o);
  choose_lobes(view);
  return true;
}

// Each as often as it has a share of the light, by its largest channel: a luminance would leave blue to
// chance.
void Bsdf::choose_lobes(View& view) const {
  const float brightest = largest(color_);
  view.p_mirror = mirror_ * brightest;
  view.p_coat = coat_ > 0 ? (coat_share_ / coat_) * (1 - view.coat_passes) : 0.0F;
  const float below = view.coat_passes;
  view.p_passing = passing_ * brightest * below;
  if (alpha_x_ <= 0) {
    view.smooth = facet_shares(view, view.o.z);
    view.p_facet = below * (largest(view.smooth.reflected) + largest(view.smooth.through));
  } else {
    const float metal = metal_ > 0 ? metal_ * largest(metal_mean_) * (1 - view.mirror_loss) : 0.0F;
    view.p_facet = below * (metal + opaque_ * (1 - view.layer_passes) + glass_ * (1 - view.glass_loss));
  }
  float back = opaque_ * brightest * view.layer_passes + glass_ * sides_[view.side].back * view.glass_loss;
  if (metal_ > 0) back += metal_ * largest(metal_multiple_) * view.mirror_loss;
  view.p_back = below * back;
  if (view.coat_loss > 0) view.p_back += metal_ * largest(metal_mean_ * metal_mean_) * view.coat_loss;
  view.p_through = below * glass_ * sides_[view.side].through * view.glass_loss * brightest;
  const float sum =
      view.p_mirror + view.p_passing + view.p_coat + view.p_facet + view.p_back + view.p_through;
  const float scale = sum > 0 ? 1 / sum : 0.0F;
  for (float* p :
       {&view.p_mirror, &view.p_passing, &view.p_coat, &view.p_facet, &view.p_back, &view.p_through}) {
    *p *= scale;
  }
}

// --- values and densities
// -------------------------------------------------------------------------------------

void Bsdf::add_coat(const View& view, const Vector3f& i, Scattered& result) const {
  const Ggx::Eye eye = coat_facets_.eye(view.o);
  const Vector3f h = glm::normalize(view.o + i);
  const float density = coat_facets_.density(h);
  const float fresnel =
      fresnel_dielectric(std::clamp(glm::dot(view.o, h), 0.0F, 1.0F), coat_eta_).reflectance;
  result.value += Color3f(coat_share_ * fresnel * density * coat_facets_.joint_visibility(eye, i) * i.z);
  result.pdf += view.p_coat * coat_facets_.bounded_reflection_pdf(eye, density);
}

void Bsdf::add_facet_reflection(const View& view, const Vector3f& i, Scattered& result) const {
  const Vector3f h = glm::normalize(view.o + i);
  const float density = facets_.density(h);
  const FacetShares shares = facet_shares(view, std::clamp(glm::dot(view.o, h), 0.0F, 1.0F));
  result.value += shares.reflected * (density * facets_.joint_visibility(view.eye, i) * i.z);
  const float pdf = glass_ > 0
                        ? shares.reflect_probability() * facets_.visible_reflection_pdf(view.eye, density)
                        : facets_.bounded_reflection_pdf(view.eye, density);
  result.pdf += view.p_facet * pdf;
}

// Through a thin pane the reflection goes on as its mirror image.
void Bsdf::add_thin_transmission(const View& view, const Vector3f& i, Scattered& result) const {
  const Vector3f mirrored(i.x, i.y, -i.z);
  const Vector3f h = glm::normalize(view.o + mirrored);
  const float density = facets_.density(h);
  const FacetShares shares = facet_shares(view, std::clamp(glm::dot(view.o, h), 0.0F, 1.0F));
  result.value += shares.through * (density * facets_.joint_visibility(view.eye, mirrored) * mirrored.z);
  result.pdf +=
      view.p_facet * (1 - shares.reflect_probability()) * facets_.visible_reflection_pdf(view.eye, density);
}

// Walter et al. 2007, "Microfacet Models for Refraction through Rough Surfaces", equations 16, 17 and 21,
// with indices relative to that on o's side, and light squeezed.
void Bsdf::add_facet_transmission(const View& view, const Vector3f& i, Scattered& result) const {
  const float eta = sides_[view.side].eta;
  Vector3f h = view.o + eta * i;
  const float length = glm::length(h);
  if (!(length > 0)) return;
  h /= h.z < 0 ? -length : length;
  const float c = glm::dot(view.o, h), through = -glm::dot(i, h);
  if (!(c > 0 && through > 0)) return;
  const float density = facets_.density(h);
  const FacetShares shares = facet_shares(view, std::min(1.0F, c));
  const float jacobian = through / (length * length);  // times eta^2
  const float masking = facets_.visible(view.eye) * facets_.visible(i);
  result.value += shares.through * (masking * density * c * jacobian / view.o.z);
  result.pdf += view.p_facet * (1 - shares.reflect_probability()) *
                facets_.visible_pdf(view.eye, c, density) * jacobian * eta * eta;
}

// What facets below the coat return gets the lesser of what the coat lets through on both ways: as good as
// the way in alone for what is mirrored, reversible, and never more than came in.
Bsdf::Scattered Bsdf::scatter(const View& view, const Vector3f& i) const {
  const bool is_reflection = i.z > 0;
  const float cosine = std::min(1.0F, std::abs(i.z));
  const bool is_i_inside = !is_thin_ && (glass_ > 0 || passing_ > 0) && view.is_below == is_reflection;
  const float i_passes = coat_passes(cosine, is_i_inside);
  Scattered matt, facets;
  if (is_reflection) {
    if (view.p_back > 0) {
      matt = {matt_reflection(view, i, i_passes) * cosine_pdf(cosine), view.p_back * cosine_pdf(cosine)};
    }
    if (alpha_x_ > 0 && view.p_facet > 0) add_facet_reflection(view, i, facets);
  } else {
    if (view.p_through > 0) {
      facets = {matt_transmission(view, i) * cosine_pdf(cosine), view.p_through * cosine_pdf(cosine)};
    }
    if (alpha_x_ > 0 && glass_ > 0) {
      is_thin_ ? add_thin_transmission(view, i, facets) : add_facet_transmission(view, i, facets);
    }
  }
  if (coat_ > 0) {
    facets.value *= std::min(view.coat_passes, i_passes);
    if (is_reflection && coat_alpha_ > 0 && view.p_coat > 0) add_coat(view, i, matt);
  }
  return {matt.value + facets.value, matt.pdf + facets.pdf};
}

Bsdf::Scattered Bsdf::scatter(const Vector3f& out, const Vector3f& in) const {
  if (is_delta_) return {};
  const float cosine = glm::dot(normal_, in), geometric = glm::dot(geometric_normal_, in);
  if (!((cosine > 0 && geometric > 0) || (cosine < 0 && geometric < 0))) return {};
  if (is_matt_) {
    const bool is_above = glm::dot(normal_, out) > 0;
    if (is_above != (cosine > 0) || is_above != (glm::dot(geometric_normal_, out) > 0)) return {};
    const float pdf = cosine_pdf(std::abs(cosine));
    return {color_ * pdf, pdf};
  }
  const View* view = look(out);
  if (view == nullptr) return {};
  return scatter(*view,
                 {glm::dot(tangent_, in), glm::dot(bitangent_, in), view->is_below ? -cosine : cosine});
}

Color3f Bsdf::evaluate(const Vector3f& out, const Vector3f& in) const { return scatter(out, in).value; }

float Bsdf::pdf(const Vector3f& out, const Vector3f& in) const { return scatter(out, in).pdf; }

Color3f Bsdf::evaluate(const Vector3f& out, const Vector3f& in, float& pdf) const {
  const Scattered scattered = scatter(out, in);
  pdf = scattered.pdf;
  return scattered.value;
}

}  // namespace raytracer
