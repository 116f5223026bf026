// What a Bsdf takes from its material, once.
#include <cmath>

#include "materials/bsdf.hpp"
#include "sampling/hemisphere.hpp"

namespace raytracer {

namespace {

// Facets of less roughness are a mirror or a clear pane: rounding of directions is no longer small to it.
constexpr float kLeastAlpha = 1e-4F;
// Facets that spread refracted light less than this are a clear pane, for the same reason.
constexpr float kLeastSpread = 2e-5F;
// Of light held back by facets, less than this is not worth making up for.
constexpr float kLeastLoss = 1e-5F;
constexpr float kCoatIor = 1.5F;

// Not a number counts as 0.
float share(float x) { return x > 0 ? std::min(x, 1.0F) : 0.0F; }
float index_of_refraction(float x) { return x > 0 ? std::clamp(x, 1e-2F, 1e2F) : 1.0F; }

}  // namespace

Bsdf::Bsdf(const MaterialValues& material, const BsdfFrame& frame)
    : color_(color_share(material.color)),
      is_black_(material.is_area_light),
      is_matt_(is_matt(material)),
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

}  // namespace raytracer
