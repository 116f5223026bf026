#include "limit_world.hpp"

#include <charconv>
#include <cmath>
#include <cstdlib>
#include <cstring>

#include "core/mapped_file.hpp"
#include "core/parallel.hpp"
#include "raytracer/error.hpp"

namespace raytracer::limit {
namespace {

/// The words of a text, one after the other.
class Words {
 public:
  explicit Words(std::string_view text) : rest_(text) {}

  /// Empty at the end.
  std::string_view word() {
    const auto is_gap = [](char c) { return c == ' ' || c == '\n'; };
    while (!rest_.empty() && is_gap(rest_.front())) rest_.remove_prefix(1);
    std::size_t length = 0;
    while (length < rest_.size() && !is_gap(rest_[length])) ++length;
    const std::string_view found = rest_.substr(0, length);
    rest_.remove_prefix(length);
    return found;
  }

  template <class Number>
  Number number() {
    const std::string_view digits = word();
    Number value{};
    if (std::from_chars(digits.data(), digits.data() + digits.size(), value).ec != std::errc()) {
      throw Error(ErrorKind::kScene, "a number is missing");
    }
    return value;
  }

  template <class Vector>
  Vector vector() {
    Vector v;
    for (int i = 0; i < Vector::length(); ++i) v[i] = number<typename Vector::value_type>();
    return v;
  }

 private:
  std::string_view rest_;
};

/// A binary PLY as make_mesh.py writes it: x y z, and triangles as a byte 3 and three numbers.
void read_ply(const std::string& path, Part& part) {
  const MappedFile file(path);
  const std::string_view text = file.bytes();
  const std::size_t body = text.find("end_header\n") + 11;
  const auto count = [&](const char* word) {
    return std::strtoull(text.data() + text.find(word) + std::strlen(word), nullptr, 10);
  };
  part.points.reserve(count("element vertex ") + 1);  // Embree reads four floats at a time
  part.points.resize(count("element vertex "));
  part.triangles.resize(count("element face "));
  const char* at = text.data() + body;
  std::memcpy(part.points.data(), at, 12 * part.points.size());
  at += 12 * part.points.size();
  constexpr std::size_t kRows = 65536;
  parallel_for(part.triangles.size() / kRows + 1, [&](std::size_t i) {
    const std::size_t end = std::min(part.triangles.size(), (i + 1) * kRows);
    for (std::size_t k = i * kRows; k < end; ++k) std::memcpy(&part.triangles[k], at + 13 * k + 1, 12);
  });
}

Camera read_camera(Words& words, const World& world) {
  const auto position = words.vector<Vector3d>(), look_at = words.vector<Vector3d>(),
             up = words.vector<Vector3d>();
  const double half_height = std::tan(glm::radians(words.number<double>()) / 2);
  return {position, look_at, up, half_height * world.width / world.height, half_height};
}

void read_picture(Words& words, World& world) {
  world.width = words.number<int>();
  world.height = words.number<int>();
  world.samples = words.number<int>();
  world.bounces = words.number<int>();
}

}  // namespace

World read_world(const std::string& path) {
  const MappedFile file(path);
  Words words(file.bytes());
  World world;
  for (std::string_view kind = words.word(); !kind.empty(); kind = words.word()) {
    if (kind == "picture") read_picture(words, world);
    if (kind == "camera") world.camera = read_camera(words, world);
    if (kind == "background") world.background = 255.0f * words.vector<Color3f>();
    if (kind == "lamp") {
      const auto position = words.vector<Vector3f>();
      const auto lambda = words.number<float>();
      world.lamps.push_back({position, lambda, words.number<int>() != 0});
    }
    // All that follows has this surface.
    if (kind == "surface") {
      const auto color = words.vector<Color3f>();
      world.parts.emplace_back().surface = {color, words.number<float>()};
    }
    if (kind == "sphere") world.parts.back().spheres.push_back(words.vector<glm::vec4>());
    if (kind == "quad") {
      const auto corner = words.vector<Vector3f>(), width = words.vector<Vector3f>();
      world.parts.back().quads.push_back({corner, width, words.vector<Vector3f>()});
    }
    if (kind == "mesh") read_ply(std::string(words.word()), world.parts.back());
  }
  return world;
}

}  // namespace raytracer::limit
