#include "materials/bsdf.hpp"

#include <cmath>

#include "sampling/hemisphere.hpp"

namespace raytracer {

namespace {

constexpr float kInversePi = 0.3183098861837907F;
// Facets of less roughness are a mirror or a clear pane: rounding of directions is no longer small to it.
constexpr float kLeastAlpha = 1e-4F;
// Facets that spread refracted light less than this are a clear pane, for the same reason.
constexpr float kLeastSpread = 2e-5F;
// Of light held back by facets, less than this is not worth making up for.
constexpr float kLeastLoss = 1e-5F;
constexpr float kCoatIor = 1.5F;

// Not a number counts as 0.
float share(float x) { return x > 0 ? std::min(x, 1.0F) : 0.0F; }
Color3f share(const Color3f& c) { return {share(c.x), share(c.y), share(c.z)}; }
float index_of_refraction(float x) { return x > 0 ? std::clamp(x, 1e-2F, 1e2F) : 1.0F; }
float cosine_of(const Vector3f& v) { return std::min(1.0F, std::abs(v.z)); }
float largest(const Color3f& c) { return std::max(c.x, std::max(c.y, c.z)); }

float reflect_probability(const Color3f& reflected, const Color3f& through) {
  const float r = largest(reflected), t = largest(through);
  return t > 0 ? r / (r + t) : 1.0F;
}

}  // namespace

// --- the closure
// ----------------------------------------------------------------------------------------------

Bsdf::Bsdf(const MaterialValues& material, const BsdfFrame& frame)
    : color_(share(material.color)),
      is_black_(material.is_area_light),
      is_matt_(!(material.shininess > 0) && !material.has_layer && !(material.metallic > 0) &&
               !(material.transmission > 0) && !(material.coat > 0)),
      is_delta_(is_black_),
      geometric_normal_(frame.geometric_normal),
      normal_(frame.normal) {
  if (is_black_ || is_matt_) return;
  looked_from_ = Vector3f(0);
  const float outside = index_of_refraction(frame.ior_outside);
  set_up_shares(material);
  // Without facets their roughness means nothing; taken for smooth they cost nothing.
  const bool has_facets = metal_ > 0 || glass_ > 0 || (opaque_ > 0 && material.has_layer);
  set_up_roughness(material, has_facets);
  set_up_sides(frame, index_of_refraction(material.ior) / outside);
  set_up_frame(frame);
  set_up_layers(material, outside);
  set_up_metal(material, outside);
  if (glass_ > 0 && alpha_x_ > 0 && has_compensation_) set_up_glass();
  is_delta_ = opaque_ <= 0 && alpha_x_ <= 0 && (coat_ <= 0 || coat_alpha_ <= 0);
}

void Bsdf::set_up_shares(const MaterialValues& material) {
  mirror_ = share(material.shininess);
  const float rest = 1 - mirror_, metallic = share(material.metallic);
  const float transmission = share(material.transmission);
  metal_ = rest * metallic;
  glass_ = rest * (1 - metallic) * transmission;
  opaque_ = rest * (1 - metallic) * (1 - transmission);
  passing_ = 0;
  coat_ = share(material.coat);
  coat_share_ = rest * coat_;
  is_thin_ = material.thin;
  has_compensation_ = material.energy_compensation;
}

// glTF's KHR_materials_anisotropy: alpha along one axis is drawn towards 1 by the strength squared.
void Bsdf::set_up_roughness(const MaterialValues& material, bool has_facets) {
  const float roughness = share(material.roughness), alpha = roughness * roughness;
  const float strength = std::min(1.0F, std::abs(material.anisotropy));
  const float stretched = strength > 0 ? alpha + (1 - alpha) * strength * strength : alpha;
  const bool is_smooth = !has_facets || !(stretched >= kLeastAlpha);
  const float wide = is_smooth ? 0.0F : stretched, narrow = is_smooth ? 0.0F : std::max(kLeastAlpha, alpha);
  alpha_x_ = material.anisotropy < 0 ? narrow : wide;
  alpha_y_ = material.anisotropy < 0 ? wide : narrow;
  const float coat_roughness = share(material.coat_roughness);
  coat_alpha_ = coat_roughness * coat_roughness;
  if (coat_alpha_ < kLeastAlpha) coat_alpha_ = 0;
  if (alpha_x_ > 0) facets_ = Ggx(alpha_x_, alpha_y_);
  if (coat_alpha_ > 0) coat_facets_ = Ggx(coat_alpha_, coat_alpha_);
}

// Between equal indices there is nothing to see; where they are nearly equal, facets hardly spread the light.
void Bsdf::set_up_sides(const BsdfFrame& frame, float layer_eta) {
  const float solid_eta = index_of_refraction(frame.ior_inside) / index_of_refraction(frame.ior_outside);
  sides_[0] = {};
  sides_[0].eta = is_thin_ ? layer_eta : solid_eta;
  sides_[1] = {};
  sides_[1].eta = 1 / sides_[0].eta;
  if (glass_ <= 0 || is_thin_) return;
  const float difference = std::abs(solid_eta - 1);
  if (difference < 1e-6F) {
    passing_ = glass_;
    glass_ = 0;
    if (metal_ <= 0 && opaque_ <= 0) alpha_x_ = alpha_y_ = 0;
  } else if (std::max(alpha_x_, alpha_y_) * difference < kLeastSpread) {
    alpha_x_ = alpha_y_ = 0;
  }
}

void Bsdf::set_up_frame(const BsdfFrame& frame) {
  is_isotropic_ = alpha_x_ == alpha_y_;
  if (!is_isotropic_) {
    const Vector3f along = frame.tangent - glm::dot(frame.tangent, normal_) * normal_;
    const float length = glm::length(along);
    if (length > 1e-6F && length < kInfinity) {
      tangent_ = along / length;
      bitangent_ = glm::cross(normal_, tangent_);
      return;
    }
  }
  complete_frame(normal_, tangent_, bitangent_);
}

// The layer stands on an opaque base only where the material says so; of a boundary only how far the indices
// are apart counts, so that no opaque base ever hides behind total reflection.
void Bsdf::set_up_layers(const MaterialValues& material, float outside) {
  const float eta = index_of_refraction(material.ior) / outside;
  layer_eta_ = std::max(eta, 1 / eta);
  specular_ = share(material.specular);
  // Glass has its reflection even where no layer was spoken of.
  if (!material.has_layer && !(material.transmission > 0)) specular_ = 0;
  if (layer_eta_ < 1.0005F) layer_eta_ = 1;
  layer_mean_passes_ = coat_mean_passes_ = 1;
  coat_mean_loss_ = 0;
  const bool has_layer = opaque_ > 0 && specular_ > 0 && layer_eta_ > 1;
  if (alpha_x_ > 0 || has_layer || coat_ > 0) {
    reflection_ = &ReflectionTable::get();
    cell_ = ReflectionTable::Grid::cell_of(alpha_x_);
  }
  if (!is_isotropic_) drawn_cell_ = DrawnCell(alpha_x_, alpha_y_);
  if (has_layer) {
    layer_eta_cell_ = ReflectionTable::eta_cell(layer_eta_);
    layer_mean_passes_ = 1 - specular_ * (is_isotropic_ ? reflection_->boundary_mean(cell_, layer_eta_cell_)
                                                        : DrawnReflectionTable::get().boundary_mean(
                                                              drawn_cell_, layer_eta_cell_));
  }
  if (coat_ <= 0) return;
  const float coat_eta = kCoatIor / outside;
  coat_eta_ = std::max(coat_eta, 1 / coat_eta);
  coat_cell_ = ReflectionTable::Grid::cell_of(coat_alpha_);
  coat_eta_cell_ = ReflectionTable::eta_cell(coat_eta_);
  coat_mean_passes_ = 1 - coat_ * reflection_->boundary_mean(coat_cell_, coat_eta_cell_);
  if (metal_ > 0 && alpha_x_ > 0 && has_compensation_) set_up_coat_loss();
}

// The table is of coats in air; elsewhere they reflect less, and as much less is lost.
void Bsdf::set_up_coat_loss() {
  const CoatTable& table = CoatTable::get();
  const float in_air = reflection_->boundary_mean(coat_cell_, ReflectionTable::eta_cell(kCoatIor));
  coat_loss_share_ = std::min(coat_, (1 - coat_mean_passes_) / in_air);
  coat_loss_cell_ = CoatTable::coat_cell(coat_alpha_);
  coat_base_cell_ = CoatTable::Grid::cell_of(is_isotropic_ ? alpha_x_ : drawn_cell_.reflection.alpha);
  coat_mean_loss_ = coat_loss_share_ * table.mean(coat_base_cell_, coat_loss_cell_);
  if (coat_mean_loss_ < kLeastLoss) coat_mean_loss_ = 0;
}

// Light between facets, Kulla and Conty 2017: what facets hold back, 1 - E, comes back from a matt lobe
// (1 - E(o)) (1 - E(i)) / (pi (1 - mean E)); each reflection on the way takes Fresnel's mean, so that after
// all F^2 E / (1 - F (1 - E)) of it is left (with means; the first of the two F is that of the light that
// was held back, the second that of the last reflection).
void Bsdf::set_up_metal(const MaterialValues& material, float outside) {
  mirror_mean_loss_ = 0;
  const bool is_rough = alpha_x_ > 0;
  if (is_rough && has_compensation_ && (metal_ > 0 || (glass_ > 0 && is_thin_))) {
    mirror_mean_loss_ = 1 - (is_isotropic_ ? reflection_->mirror_mean(cell_)
                                           : DrawnReflectionTable::get().mirror_mean(drawn_cell_));
    if (mirror_mean_loss_ < kLeastLoss) mirror_mean_loss_ = 0;
  }
  if (metal_ <= 0) return;
  is_measured_ = material.conductor.has_value();
  if (is_measured_) {
    conductor_ = ConductorSquares(*material.conductor, outside);
    metal_mean_ = color_ * fresnel_conductor_mean(conductor_);
  } else {
    metal_f0_ = color_;
    metal_mean_ = fresnel_schlick_mean(metal_f0_);
  }
  const float mean = 1 - mirror_mean_loss_;
  metal_multiple_ = metal_mean_ * metal_mean_ * mean / (Color3f(1) - metal_mean_ * mirror_mean_loss_);
}

// The same for glass: what facets hold back leaves on both sides. The share x (1 - F) that goes through, with
// F the mean reflectance from this side, keeps light reversible where x / (1 - x) is the other side's loss
// over this side's (Kulla and Conty 2017, their section on dielectrics).
void Bsdf::set_up_glass() {
  if (is_thin_) {
    const float eta = std::max(sides_[0].eta, sides_[1].eta);
    sides_[0].mean_loss = mirror_mean_loss_;
    sides_[0].back = both_faces(specular_ * fresnel_dielectric_mean(eta));
    sides_[0].through = 1 - sides_[0].back;
    return;
  }
  const GlassTable& table = GlassTable::get();
  glass_cell_ = GlassTable::Grid::cell_of(alpha_x_);
  for (GlassSide& side : sides_) {
    side.eta_cell = GlassTable::eta_cell(side.eta);
    side.mean_loss = 1 - (is_isotropic_ ? table.mean(glass_cell_, side.eta_cell, specular_)
                                        : DrawnGlassTable::get().mean(drawn_cell_, side.eta_cell, specular_));
  }
  const float sum = sides_[0].mean_loss + sides_[1].mean_loss;
  if (sides_[0].mean_loss < kLeastLoss || sides_[1].mean_loss < kLeastLoss) {
    sides_[0].mean_loss = sides_[1].mean_loss = 0;
    return;
  }
  for (int k = 0; k < 2; ++k) {
    const float share_through = sides_[1 - k].mean_loss / sum;
    sides_[k].through = share_through * (1 - fresnel_dielectric_mean(sides_[k].eta));
    sides_[k].back = 1 - sides_[k].through;
  }
}

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
  const float pdf = glass_ > 0 ? reflect_probability(shares.reflected, shares.through) *
                                     facets_.visible_reflection_pdf(view.eye, density)
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
  result.pdf += view.p_facet * (1 - reflect_probability(shares.reflected, shares.through)) *
                facets_.visible_reflection_pdf(view.eye, density);
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
  result.pdf += view.p_facet * (1 - reflect_probability(shares.reflected, shares.through)) *
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

// --- sampling
// -------------------------------------------------------------------------------------------------

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
  sample.pdf = i.z * kInversePi;
  sample.is_delta = sample.is_transmission = false;
  return true;
}

bool Bsdf::sample_smooth_facet(const View& view, float u_lobe, const Vector3f& out,
                               BsdfSample& sample) const {
  const float p_reflect = reflect_probability(view.smooth.reflected, view.smooth.through);
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
  if (u_lobe < reflect_probability(shares.reflected, shares.through)) return i.z > 0;
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
