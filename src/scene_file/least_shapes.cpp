#include "scene_file/least_shapes.hpp"

#include <algorithm>
#include <cmath>

#include "scene_file/builder.hpp"
#include "scene_file/schema.hpp"

namespace raytracer::scene_file {

double LeastShapes::in_turn_of(const ForNode& loop) {
  inner_names_.push_back(loop.name);
  count(loop.items, 1, true);
  double least = shapes_;
  for (const auto& [definition, uses] : uses_) {  // in most turns a place of what is shared
    if (definition->least.built_out >= 1) least += uses.plain + uses.other;
  }
  return least;
}

LeastMade LeastShapes::of(const DefineNode& define) {
  for (const ParameterNode& parameter : define.parameters) inner_names_.push_back(parameter.name);
  inner_names_.push_back(define.name);  // what it makes of itself an `if` must end
  count(define.items, 1, true);
  return sum();
}

LeastMade LeastShapes::sum() const {
  LeastMade made;
  made.at_first = made.built_out = shapes_;
  made.is_shared = makes_shapes_alone_;
  for (const auto& [definition, uses] : uses_) {
    const LeastMade& own = definition->least;
    const double all = uses.plain + uses.other;
    made.uses.push_back(definition);
    made.is_shared = made.is_shared && own.is_shared;
    made.built_out += all * own.built_out;
    made.at_first += own.at_first;
    const bool builds_shared = uses.plain >= 2 && own.is_shared && own.built_out >= kLeastToShare;
    if (builds_shared) made.at_first += own.built_out;
    const double further = all - (builds_shared ? 2 : 1);
    made.at_first += own.built_out >= 1 ? std::max(further, 0.0) : 0;
  }
  return made;
}

void LeastShapes::count(std::span<const ItemNode> items, double times, bool is_plain) {
  for (const ItemNode& item : items) {
    if (const auto* loop = std::get_if<const ForNode*>(&item)) {
      const double turns = turns_of(**loop);
      if (turns >= 1) {
        inner_names_.push_back((*loop)->name);
        count((*loop)->items, times * turns, is_plain);
      }
      if (std::isnan(turns)) makes_shapes_alone_ = false;
    } else if (const auto* block = std::get_if<const BlockNode*>(&item)) {
      count(**block, times, is_plain);
    } else if (const auto* let = std::get_if<const LetNode*>(&item)) {
      inner_names_.push_back((*let)->name);
    } else if (const auto* define = std::get_if<const DefineNode*>(&item)) {
      inner_names_.push_back((*define)->name);
    } else if (std::holds_alternative<const IfNode*>(item)) {
      makes_shapes_alone_ = false;
    } else if (std::holds_alternative<const IncludeNode*>(item)) {
      makes_shapes_alone_ = false;
      return;  // what follows may use its names
    }
  }
}

void LeastShapes::count(const BlockNode& block, double times, bool is_plain) {
  const bool is_inner = std::ranges::find(inner_names_, block.kind_name) != inner_names_.end();
  if (const auto used = is_inner ? nullptr : find_(block.kind_name)) {
    Uses& uses = uses_[used];
    (is_plain && has_only_a_place(block) ? uses.plain : uses.other) += times;
    return;
  }
  const KindRow* kind = find_kind(source_.text(block.kind));
  const bool is_object = kind != nullptr && kind->block_class == BlockClass::kObject;
  const bool is_shape = is_object && kind->takes_material && !kind->has_children;
  if (is_object && kind->has_children) {
    count(block.items, times, is_plain && has_only_a_place(block));
  } else if (is_shape) {
    shapes_ += times;
    if (kind->name == "plane") makes_shapes_alone_ = false;  // what is endless can't be shared
  } else if (kind == nullptr || kind->block_class != BlockClass::kMaterial) {
    makes_shapes_alone_ = false;
  }
}

// Whether every use of that text is equal but for where it stands.
bool LeastShapes::has_only_a_place(const BlockNode& block) const {
  return std::ranges::all_of(block.items, [this](const ItemNode& item) {
    const auto* property = std::get_if<const PropertyNode*>(&item);
    if (property == nullptr) {
      const auto* inner = std::get_if<const BlockNode*>(&item);
      return inner == nullptr || source_.text((*inner)->kind) != "material";
    }
    const std::string_view name = source_.text((*property)->name);
    return std::ranges::find(transform_properties(), name, &PropertyRow::name) !=
           transform_properties().end();
  });
}

double LeastShapes::turns_of(const ForNode& loop) {
  const double from = number(loop.from), to = number(loop.to), step = loop.step ? number(loop.step) : 1;
  const double turns = std::floor((to - from) / step + 1e-9) + 1;
  return std::isfinite(turns) ? turns : std::nan("");
}

// Not a number where it is not known yet.
double LeastShapes::number(const Expression* e) {
  if (!is_known(*e)) return std::nan("");
  const bool used_time = evaluator_.uses_time();
  const Value value = evaluator_.evaluate(*e, source_, visible_);
  if (!used_time) evaluator_.forget_time();
  return value.is_number() ? value.x() : std::nan("");
}

bool LeastShapes::is_known(const Expression& e) const {
  if (e.operation == Operation::kName) {
    return std::ranges::find(inner_names_, e.name) == inner_names_.end() &&
           evaluator_.is_bound(e.name, visible_);
  }
  return std::ranges::all_of(e.arguments, [this](const Expression* each) { return is_known(*each); });
}

}  // namespace raytracer::scene_file
