// One block: its properties against the rows of its kind, its place in the world, its children.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/suggest.hpp"
#include "raytracer/error.hpp"
#include "scene_file/arguments.hpp"
#include "scene_file/builder.hpp"

namespace raytracer::scene_file {
namespace {

glm::dmat3 rotation_about(const Vector3d& axis, double degrees) {
  // Rodrigues' formula as a matrix; glm's columns are written one per line.
  const Vector3d n = glm::normalize(axis);
  // Quarter turns are exact: nobody wants 6e-17 where a 0 belongs.
  const double turns = degrees / 90;
  const bool quarter = turns == std::floor(turns);
  const int quarters = quarter ? static_cast<int>(std::fmod(std::fmod(turns, 4) + 4, 4)) : 0;
  constexpr double kSines[] = {0, 1, 0, -1};
  const double s = quarter ? kSines[quarters] : std::sin(glm::radians(degrees));
  const double c = quarter ? kSines[(quarters + 1) % 4] : std::cos(glm::radians(degrees));
  const Vector3d m = (1 - c) * n;
  return {Vector3d(m.x * n.x + c, m.x * n.y + s * n.z, m.x * n.z - s * n.y),
          Vector3d(m.y * n.x - s * n.z, m.y * n.y + c, m.y * n.z + s * n.x),
          Vector3d(m.z * n.x + s * n.y, m.z * n.y - s * n.x, m.z * n.z + c)};
}

Vector3d vector_of(const Argument& a) { return {a.numbers[0], a.numbers[1], a.numbers[2]}; }

Transform matrix_of(const Argument& a) {
  Transform transform;
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 3; ++column) {
      transform.linear[column][row] = a.numbers[static_cast<std::size_t>(4 * row + column)];
    }
    transform.translation[row] = a.numbers[static_cast<std::size_t>(4 * row + 3)];
  }
  return transform;
}

}  // namespace

Transform PlacingWords::about(const Vector3d& spot) const {
  if (matrix) return *matrix;
  const Vector3d fixed = pivot.value_or(spot);
  return {linear, fixed - linear * fixed + translation};
}

SceneDraft& BlockContext::draft() { return builder_.draft_; }

const Given* BlockContext::given(std::string_view property) const {
  const auto found = std::ranges::find_if(given_, [&](const Given& g) { return g.row->name == property; });
  return found == given_.end() ? nullptr : &*found;
}

void BlockContext::error(std::string_view property, std::string message, std::string suggestion) {
  const Given* written = given(property);
  builder_.diagnostics_.error(written != nullptr ? written->place : header(), std::move(message),
                              std::move(suggestion));
}

// Notes a property as given; false where it was given before, which is an error unless it places the block.
bool BlockContext::accept(const PropertyRow& row, const Place& place) {
  const Given* first = given(row.name);
  const bool repeatable = row.store == nullptr && row.type != PropertyType::kMaterial && row.name != "pivot" &&
                          row.name != "matrix";
  if (first != nullptr && !repeatable) {
    builder_.diagnostics_.error(place, fmt::format("'{}' is given twice", row.name), {},
                                {{first->place, "first given here"}});
    return false;
  }
  given_.push_back({&row, place});
  return true;
}

bool BlockContext::apply_placing(const PropertyRow& row, const Argument& argument, const Place& place) {
  const auto reject = [&](std::string message, std::string suggestion = {}) {
    builder_.diagnostics_.error(place, std::move(message), std::move(suggestion));
    return false;
  };
  const bool is_matrix = row.name == "matrix";
  if (given_.size() > 1) {
    for (const Given& other : given_) {
      const bool places = other.row->store == nullptr && other.row->type != PropertyType::kMaterial;
      if (places && (other.row->name == "matrix") != is_matrix) {
        return reject("'matrix' stands in place of all other transforms", "write either");
      }
    }
  }
  if (row.name == "translate") {
    placing_.translation += vector_of(argument);
  } else if (row.name == "rotate") {
    const Vector3d turns = vector_of(argument);
    placing_.linear = rotation_about({0, 0, 1}, turns.z) * rotation_about({0, 1, 0}, turns.y) *
                      rotation_about({1, 0, 0}, turns.x) * placing_.linear;
  } else if (row.name == "rotate_axis") {
    const Vector3d axis = vector_of(argument);
    if (glm::length(axis) == 0) return reject("the axis of 'rotate_axis' has no length");
    placing_.linear = rotation_about(axis, argument.numbers[3]) * placing_.linear;
  } else if (row.name == "scale") {
    const Vector3d factors = vector_of(argument);
    if (row_.placing == Placing::kRigid) {
      return reject(fmt::format("'scale' means nothing to a {}", row_.name), "it has no size of its own");
    }
    if (factors.x == 0 || factors.y == 0 || factors.z == 0) {
      return reject("'scale' must not be 0", "a thing without size can't be seen");
    }
    for (int column = 0; column < 3; ++column) placing_.linear[column] *= factors;
  } else if (row.name == "pivot") {
    placing_.pivot = vector_of(argument);
  } else {
    placing_.matrix = matrix_of(argument);
    const glm::dmat3& m = placing_.matrix->linear;
    const double volume = glm::length(m[0]) * glm::length(m[1]) * glm::length(m[2]);
    if (!(std::abs(glm::determinant(m)) > 1e-12 * volume)) {
      return reject("'matrix' is flat: it can't be inverted", "the first three columns must span space");
    }
  }
  return true;
}

void BlockContext::report_unknown_property(Span name) {
  const std::string_view word = around_.source->text(name);
  std::vector<std::string_view> known;
  for (const PropertyRow& row : row_.properties) known.push_back(row.name);
  if (row_.takes_material) known.push_back(material_property().name);
  if (row_.placing != Placing::kNone) {
    for (const PropertyRow& row : transform_properties()) known.push_back(row.name);
  }
  const std::string_view nearest = nearest_word(word, known);
  std::string suggestion;
  if (!nearest.empty()) {
    suggestion = fmt::format("did you mean '{}'?", nearest);
  } else if (row_.has_children && find_kind(word) != nullptr) {
    suggestion = fmt::format("a block needs braces: {} {{ … }}", word);
  } else {
    suggestion = fmt::format("it has {}", fmt::join(known, ", "));
  }
  builder_.diagnostics_.error(place(name), fmt::format("{} has no property '{}'", row_.name, word), suggestion);
}

bool BlockContext::fill_item(const PropertyNode& property, void* input) {
  const PropertyRow* row = find_property(row_, around_.source->text(property.name));
  if (row == nullptr) {
    report_unknown_property(property.name);
    return false;
  }
  if (!accept(*row, place(property.whole()))) return false;
  const auto argument = read_argument(*row, property, *around_.source, builder_.diagnostics_);
  if (!argument) return false;
  if (row->type == PropertyType::kMaterial) {
    material_ = builder_.find_material(argument->text, place(property.values.front().span), around_);
    return material_.has_value();
  }
  if (row->store == nullptr) return apply_placing(*row, *argument, place(property.whole()));
  row->store(input, *argument);
  return true;
}

// A block inside this one: a material in place, a child, or a mistake.
bool BlockContext::fill_block(const BlockNode& block, void*) {
  const std::string_view word = around_.source->text(block.kind);
  const PropertyRow* row = find_property(row_, word);
  if (row != nullptr && row->type == PropertyType::kMaterial && block.words.empty()) {
    if (!accept(*row, place(block.header()))) return false;
    material_ = builder_.build_inline_material(block, around_);
    return material_.has_value();
  }
  if (row != nullptr && (row->type != PropertyType::kMaterial || !row_.has_children)) {
    const bool names_material = row->type == PropertyType::kMaterial;
    builder_.diagnostics_.error(
        place(block.header()), fmt::format("'{}' takes {}, found a block", word, describe_type(*row)),
        names_material ? "a material in place has no name" : fmt::format("{} {}", word, example_value(*row)));
    return false;
  }
  if (row_.has_children) return true;  // its turn comes when this block is whole
  if (find_kind(word) != nullptr || may_have_variant(word)) {
    builder_.diagnostics_.error(place(block.header()), fmt::format("a {} can't hold a {}", row_.name, word),
                                "put both into a group");
  } else {
    report_unknown_property(block.kind);
  }
  return false;
}

bool fill(BlockContext& context, void* input) {
  bool sound = true;
  const Place header = context.header();
  for (const ItemNode& item : context.node_.items) {
    if (const auto* property = std::get_if<const PropertyNode*>(&item)) {
      sound = context.fill_item(**property, input) && sound;
    } else if (const auto* block = std::get_if<const BlockNode*>(&item)) {
      sound = context.fill_block(**block, input) && sound;
    } else if (!context.row_.has_children) {
      const Span keyword = std::get<const IncludeNode*>(item)->keyword;
      context.builder_.diagnostics_.error(context.place(keyword),
                                          fmt::format("a {} can't include a file", context.row_.name),
                                          "'include' stands where a block may stand");
      sound = false;
    }
  }
  for (const PropertyRow& row : context.row_.properties) {
    if (row.required && !context.is_given(row.name)) {
      context.builder_.diagnostics_.error(header, fmt::format("{} has no '{}'", context.row_.name, row.name),
                                          fmt::format("{} {}", row.name, example_value(row)));
      sound = false;
    }
  }
  return sound;
}

void BlockContext::build_children() {
  Scope scope{around_.scope, {}};
  Surroundings inside{around_.source, row_.name, placed(Vector3d(0)), material_.value_or(around_.material), &scope};
  for (const ItemNode& item : node_.items) {
    const auto* block = std::get_if<const BlockNode*>(&item);
    const bool is_own_material =
        block != nullptr && (*block)->words.empty() && around_.source->text((*block)->kind) == "material";
    if (!std::holds_alternative<const PropertyNode*>(item) && !is_own_material) builder_.build_item(item, inside);
  }
}

void BlockContext::add_shape(std::unique_ptr<Shape> shape) {
  SceneDescription& scene = builder_.draft_.scene;
  scene.shapes.push_back(std::move(shape));
  scene.material_of.push_back(material_.value_or(around_.material));
}

std::uint32_t BlockContext::add_material(const Material& material) {
  SceneDescription& scene = builder_.draft_.scene;
  const auto index = static_cast<std::uint32_t>(scene.materials.size());
  scene.materials.push_back(material);
  builder_.last_material_ = index;
  return index;
}

}  // namespace raytracer::scene_file
