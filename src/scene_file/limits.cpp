#include "scene_file/limits.hpp"

namespace raytracer::scene_file {
namespace {

constexpr LimitRow kLimits[] = {
    {"includes", &Limits::include_depth, "files that include each other"},
    {"nesting", &Limits::nesting, "uses of definitions inside each other"},
    {"shapes", &Limits::shapes, "shapes made"},
    {"steps", &Limits::steps, "steps of evaluation"},
};

}  // namespace

std::span<const LimitRow> all_limits() { return kLimits; }

}  // namespace raytracer::scene_file
