// How a surface scatters light at a point: the closure of a Material, textures resolved.
#pragma once

#include "materials/albedo_tables.hpp"
#include "materials/coat_table.hpp"
#include "materials/drawn_tables.hpp"
#include "materials/fresnel.hpp"
#include "materials/ggx.hpp"
#include "raytracer/material.hpp"
#include "raytracer/vector3f.hpp"

namespace raytracer {

/// A colour of a surface: each channel within 0 and 1, what is not a number 0.
inline Color3f color_share(const Color3f& color) {
  const auto share = [](float x) {
    const float positive = x > 0 ? x : 0.0F;
    return positive < 1 ? positive : 1.0F;
  };
  return {share(color.x), share(color.y), share(color.z)};
}

/// Whether a material scatters light as a matt surface and does nothing else with it.
inline bool is_matt(const MaterialValues& material) {
  return !(material.shininess > 0) && !material.has_layer && !(material.metallic > 0) &&
         !(material.transmission > 0) && !(material.coat > 0);
}

/// Where a Bsdf stands. All unit length, world space. `normal` and `tangent` need not be orthogonal.
struct BsdfFrame {
  Vector3f geometric_normal{0, 1, 0};  ///< of the surface: outwards on closed shapes, whichever side is seen
  Vector3f normal{0, 1, 0};            ///< shading normal, on the side of the geometric one
  Vector3f tangent{0};                 ///< along u, for anisotropy; 0: any
  /// The indices of refraction of what the geometric normal points into and of what is behind the surface;
  /// outside of everything: 1. Of a surface that lets light in, one of them is its own.
  float ior_outside = 1, ior_inside = 1;
};

struct BsdfSample {
  Vector3f direction{0};  ///< unit length, away from the surface
  /// What the light from there counts for: value * |cosine to the shading normal| / pdf; of a delta its share
  /// of the light over the probability of its choice. So a path's weight is multiplied by this in any case.
  Color3f weight{0};
  float pdf = 0;          ///< per steradian, of all lobes together; of a delta the probability of its choice
  bool is_delta = false;  ///< mirror or clear glass: no other direction has anything to do with it
  bool is_transmission = false;  ///< it goes on on the other side of the surface
};

/// Directions are unit length, in world space, and point away from the surface: `out` to where the light goes
/// (the eye), `in` to where it comes from. Values are for radiance: light that is refracted into index i from
/// o is squeezed by (i / o)^2, so that a clear ball in a uniform sky shows the sky.
///
/// What the material says, from the top down, each layer with what the one above lets through:
///   - a perfect mirror with the share `shininess`, tinted; all the rest shares the rest,
///   - a coat: facets of index 1.5,
///   - facets (GGX) of metal, of the layer over an opaque base, and of glass, with one roughness in common,
///   - what scatters as a matt surface does: the opaque base, and what facets pass on among themselves.
///
/// Belongs to one thread: it remembers the last `out`, since a path asks for the same one several times.
class Bsdf {
 public:
  /// Values out of their range count as the nearest within, what is not a number as 0. Textures are left
  /// alone: whoever has them resolved gives a material with their values. The material need not outlive it.
  Bsdf(const MaterialValues& material, const BsdfFrame& frame);

  /// value(out, in) * |cosine of in to the shading normal|, per channel, delta lobes left out. 0 where in or
  /// out is on the wrong side of either normal.
  Color3f evaluate(const Vector3f& out, const Vector3f& in) const;
  /// The density per steradian with which sample() chooses `in`, delta lobes left out.
  float pdf(const Vector3f& out, const Vector3f& in) const;
  /// Both at once, for little more than the price of one.
  Color3f evaluate(const Vector3f& out, const Vector3f& in, float& pdf) const;
  /// Chooses where light comes from. `u_lobe` and `u` in [0, 1). False: the path ends here.
  bool sample(const Vector3f& out, float u_lobe, const Vector2f& u, BsdfSample& sample) const;

  /// Whether sample() never chooses anything but a delta, so that evaluate() is 0.
  bool is_delta() const { return is_delta_; }

 private:
  /// A value times cosine and the density of its direction.
  struct Scattered {
    Color3f value{0};
    float pdf = 0;
  };
  /// Shares of light of what facets reflect and let through.
  struct FacetShares {
    Color3f reflected, through;
    /// How often to choose reflection, by the largest channels.
    float reflect_probability() const {
      const float r = std::max(reflected.x, std::max(reflected.y, reflected.z));
      const float t = std::max(through.x, std::max(through.y, through.z));
      return t > 0 ? r / (r + t) : 1.0F;
    }
  };
  /// What the glass does to light from one side of the surface.
  struct GlassSide {
    float eta;  ///< the index behind over the one before
    AxisCell eta_cell;
    float mean_loss;  ///< what facets hold back of diffuse light
    /// Of what they hold back, the share that leaves after all on this side and on the other.
    float back, through;
  };

  /// What depends on `out` alone.
  struct View {
    Vector3f o;      ///< out in the surface's own space, turned upside down where needed so that o.z > 0
    bool is_below;   ///< it was
    bool is_inside;  ///< in solid glass, where there is no coat
    int side, other_side;  ///< of sides_, where out is and beyond
    Ggx::Eye eye;          ///< of rough facets
    FacetShares smooth;    ///< of smooth facets
    float coat_passes, layer_passes, mirror_loss, glass_loss, coat_loss;
    // How often each lobe is chosen; their sum is 1. `back` and `through` are the matt ones.
    float p_mirror, p_passing, p_coat, p_facet, p_back, p_through;
  };

  void set_up_shares(const MaterialValues& material);
  void set_up_frame(const BsdfFrame& frame);
  void set_up_roughness(const MaterialValues& material, bool has_facets);
  void set_up_layers(const MaterialValues& material, float outside);
  void set_up_coat_loss();
  void set_up_metal(const MaterialValues& material, float outside);
  void set_up_sides(const BsdfFrame& frame, float layer_eta);
  void set_up_glass();

  Color3f metal_fresnel(float cosine) const;
  FacetShares facet_shares(const View& view, float cosine) const;
  // These take directions in the surface's own space, on either side.
  /// What a facet's reflection loses to masking, 0..1, to be made up for; of glass from its side.
  float mirror_loss(const Vector3f& v) const;
  float glass_loss(const GlassSide& side, const Vector3f& v) const;
  float layer_passes(const Vector3f& v) const;
  float coat_passes(float cosine, bool is_inside) const;
  /// What metal's facets lose below the coat for their roughness, to be made up for.
  float coat_loss(const Vector3f& v) const;
  /// What the coat makes of light that comes from a matt lobe of this albedo, o's share apart.
  Color3f coated(const View& view, float i_passes, const Color3f& albedo) const;

  /// Null if out is on the wrong side of a normal.
  const View* look(const Vector3f& out) const;
  bool look_anew(const Vector3f& out, View& view) const;
  void choose_lobes(View& view) const;
  /// With what the coat lets through.
  Color3f matt_reflection(const View& view, const Vector3f& i, float i_passes) const;
  Color3f matt_transmission(const View& view, const Vector3f& i) const;
  void add_coat(const View& view, const Vector3f& i, Scattered& result) const;
  void add_facet_reflection(const View& view, const Vector3f& i, Scattered& result) const;
  void add_thin_transmission(const View& view, const Vector3f& i, Scattered& result) const;
  void add_facet_transmission(const View& view, const Vector3f& i, Scattered& result) const;
  Scattered scatter(const View& view, const Vector3f& i) const;
  Scattered scatter(const Vector3f& out, const Vector3f& in) const;

  bool sample_matt(const Vector3f& out, const Vector2f& u, BsdfSample& sample) const;
  bool sample_smooth_facet(const View& view, float u_lobe, const Vector3f& out, BsdfSample& sample) const;
  bool sample_rough_facet(const View& view, float u_lobe, const Vector2f& u, Vector3f& i) const;
  bool finish_delta(BsdfSample& sample, const Vector3f& direction, const Color3f& share, float probability,
                    bool is_transmission) const;
  Vector3f to_world(const View& view, const Vector3f& local) const;

  // Only the first two groups are of any use to a purely matt surface, and only they are set then: most
  // surfaces are matt.
  Color3f color_;
  bool is_black_, is_matt_, is_delta_;
  Vector3f geometric_normal_, normal_;

  Vector3f tangent_, bitangent_;
  bool is_thin_, is_measured_, has_compensation_, is_isotropic_;
  float mirror_, passing_, metal_, opaque_, glass_;  // shares of the surface, 1 in all
  float coat_;                                       // of all but the mirror
  float coat_share_;                                 // times what the mirror leaves
  float alpha_x_, alpha_y_, coat_alpha_;             // 0: smooth
  Ggx facets_, coat_facets_;                         // where they are rough
  float specular_, layer_eta_, coat_eta_;
  Color3f metal_f0_;
  ConductorSquares conductor_;
  Color3f metal_mean_;      // of Fresnel's reflectance, diffuse light
  Color3f metal_multiple_;  // what of light held back by facets leaves at last
  float mirror_mean_loss_, layer_mean_passes_, coat_mean_passes_;
  float coat_loss_share_, coat_mean_loss_;  // of what the table of coats says; and its mean
  const ReflectionTable* reflection_;
  AlphaCell cell_, coat_cell_, glass_cell_;  // of one roughness
  DrawnCell drawn_cell_;                     // of two
  AlphaCell coat_base_cell_;                 // the base's, in the table of coats
  AxisCell coat_loss_cell_;
  AxisCell layer_eta_cell_, coat_eta_cell_;
  GlassSide sides_[2];  // outside, inside

  mutable Vector3f looked_from_;
  mutable bool can_look_;
  mutable View view_;
};

}  // namespace raytracer
