#include "materials/metals.hpp"

#include <array>

namespace raytracer {

namespace {

// Between the measured wavelengths interpolated linearly. Gold is weighted over each primary's spectrum
// instead: the index changes much within one.
constexpr auto kMetals = std::to_array<Metal>({
    // Rakic, Djurisic, Elazar and Majewski 1998, Appl. Opt. 37, 5271
    {"aluminium", {{1.327F, 0.889F, 0.637F}, {7.272F, 6.262F, 5.490F}}},
    // 70 % copper, 30 % zinc; Querry 1985, CRDC-CR-85034
    {"brass", {{0.445F, 0.568F, 0.947F}, {3.522F, 2.588F, 1.920F}}},
    // Johnson and Christy 1974, Phys. Rev. B 9, 5056
    {"chromium", {{3.145F, 3.034F, 2.456F}, {3.312F, 3.330F, 3.210F}}},
    {"cobalt", {{2.209F, 2.001F, 1.789F}, {4.160F, 3.735F, 3.371F}}},
    // Johnson and Christy 1972, Phys. Rev. B 6, 4370
    {"copper", {{0.275F, 1.116F, 1.247F}, {3.373F, 2.596F, 2.456F}}},
    {"gold", {{0.143F, 0.375F, 1.442F}, {3.983F, 2.386F, 1.603F}}},
    // Johnson and Christy 1974
    {"iron", {{2.892F, 2.895F, 2.646F}, {3.065F, 2.918F, 2.805F}}},
    {"nickel", {{1.990F, 1.877F, 1.765F}, {4.094F, 3.495F, 3.048F}}},
    {"palladium", {{1.765F, 1.597F, 1.445F}, {4.275F, 3.743F, 3.351F}}},
    // Rakic and others 1998
    {"platinum", {{2.310F, 2.046F, 1.887F}, {4.147F, 3.602F, 3.224F}}},
    // Johnson and Christy 1972
    {"silver", {{0.057F, 0.054F, 0.047F}, {4.254F, 3.429F, 2.803F}}},
    // Johnson and Christy 1974
    {"titanium", {{2.698F, 2.479F, 2.305F}, {3.757F, 3.351F, 3.082F}}},
    // Weaver, Olson and Lynch 1975, Phys. Rev. B 12, 1293
    {"tungsten", {{3.617F, 3.495F, 3.325F}, {2.910F, 2.718F, 2.574F}}},
});

}  // namespace

std::span<const Metal> metals() { return kMetals; }

const ConductorIndex* find_metal(std::string_view name) {
  for (const Metal& metal : kMetals) {
    if (metal.name == name) return &metal.index;
  }
  return nullptr;
}

}  // namespace raytracer
