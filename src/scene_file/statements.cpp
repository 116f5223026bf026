// The statements: include, let, for, if, define, and the use of what was defined.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <unordered_set>

#include "core/suggest.hpp"
#include "scene_file/builder.hpp"
#include "scene_file/colors.hpp"

namespace raytracer::scene_file {
namespace {

// Reading a file is no small step: ten files that each include the next one ten times would be 10^10 of them.
constexpr std::uint64_t kStepsPerInclude = 10'000;
constexpr std::uint64_t kStepsPerUse = 10;

PropertyType parameter_type(ValueType type) {
  switch (type) {
    case ValueType::kBoolean:
      return PropertyType::kBoolean;
    case ValueType::kVector:
      return PropertyType::kVector;
    case ValueType::kColor:
      return PropertyType::kColor;
    case ValueType::kString:
      return PropertyType::kString;
    default:
      return PropertyType::kNumber;
  }
}

}  // namespace

void Builder::build_include(const IncludeNode& include, const Surroundings& around) {
  const Place place{around.source, include.file.span};
  if (!spend(kStepsPerInclude, place)) return;
  if (include_depth_ >= limits_.include_depth) {
    return halt(place, fmt::format("files include each other more than {} deep", limits_.include_depth),
                "does a file include itself? --limit includes=N allows more");
  }
  // What is wrong has been told after a few turns of a loop; more of them would only take time.
  constexpr int kMostBadTurns = 100;
  int& failed_turns = failed_includes_[&include];
  if (failed_turns > kMostBadTurns) return;
  const Value file = evaluator_.evaluate(include.file, *around.source, around.frame->values);
  const SyntaxTree* tree = files_.include(std::string(file.text), place, diagnostics_);
  if (tree == nullptr) {
    ++failed_turns;
    return;
  }
  Surroundings inside = around;
  inside.source = tree->source;
  int& bad_turns = bad_includes_[tree];
  if (bad_turns > kMostBadTurns) return;
  const std::size_t errors_before = diagnostics_.error_count() + diagnostics_.repeated();
  const Diagnostics::UsedFrom used_from(diagnostics_,
                                        {around.source, {include.keyword.begin, include.file.span.end}});
  ++include_depth_;
  build_items(tree->items, inside);
  --include_depth_;
  if (diagnostics_.error_count() + diagnostics_.repeated() > errors_before) ++bad_turns;
}

void Builder::build_let(const LetNode& let, const Surroundings& around, std::size_t let_base, bool is_top) {
  const Place place{around.source, let.name_span};
  Value value = evaluator_.evaluate(*let.value, *around.source, around.frame->values);
  if (!spend(1, place)) return;
  auto& bindings = evaluator_.bindings();
  const std::size_t known = bindings.find(let.name, around.frame->values);
  if (known != Bindings<NamedValue>::npos && known >= let_base) {
    diagnostics_.error(place, fmt::format("'{}' is assigned twice", place.text()),
                       "a name keeps its value; take a second name",
                       {{bindings.at(known).place, "first assigned here"}});
    return;
  }
  if (is_top) {
    const auto replacement = replaced_lets_.find(let.name);
    const bool replaces = replacement != replaced_lets_.end();
    if (replaces) value = replaced(replacement->second, value, place);
    top_level_lets_.push_back({std::string(place.text()), value, replaces});
  }
  bindings.push(let.name, {value, &let, false}, place);
}

// What the caller says in place of a let's own value; it must be of the same type. A colour may be said as
// one number, as in the scene.
Value Builder::replaced(const Replacement& replacement, const Value& original, const Place& place) const {
  if (original.type == ValueType::kString) return Value::string(replacement.text);
  const Value& value = replacement.value;
  const bool is_color = original.type == ValueType::kColor;
  if (is_color && value.is_number()) return Value::color(Vector3d(value.x()));
  const bool fits = value.type == original.type || (value.is_vector() && original.is_vector());
  if (!original.is_known() || fits) return value;
  const bool may_be_slip = is_color && value.type == ValueType::kString;
  const std::string_view nearest =
      may_be_slip ? nearest_word(replacement.text, color_names()) : std::string_view();
  throw Error(ErrorKind::kUsage,
              fmt::format("--set {}={}: '{}' is {} in the scene, not {}{}", place.text(), replacement.text,
                          place.text(), describe(original.type), describe(value.type),
                          nearest.empty() ? "" : fmt::format("; did you mean '{}'?", nearest)));
}

// Both ends belong to the loop; the number of turns is known before the first one.
void Builder::build_for(const ForNode& loop, const Surroundings& around) {
  const Place place{around.source, {loop.keyword.begin, loop.name_span.end}};
  bool known = spend(1, place), depends_on_time = around.depends_on_time;
  const auto number = [&](const Expression* expression, double otherwise) {
    if (expression == nullptr) return otherwise;
    const Value value = evaluator_.evaluate(*expression, *around.source, around.frame->values);
    if (value.is_known() && !value.is_number()) {
      diagnostics_.error({around.source, expression->span},
                         fmt::format("'for' counts in numbers, found {}", describe(value.type)));
    }
    known = known && value.is_number();
    depends_on_time = depends_on_time || value.depends_on_time;
    return value.x();
  };
  const double from = number(loop.from, 0), to = number(loop.to, 0), step = number(loop.step, 1);
  if (!known) return;
  if (step == 0) {
    diagnostics_.error({around.source, loop.step->span}, "a loop with a 'step' of 0 never ends", "step 1");
    return;
  }
  const double turns = std::floor((to - from) / step + 1e-9) + 1;
  if (!(turns <= static_cast<double>(limits_.steps))) {
    diagnostics_.error(
        place, fmt::format("this loop has {} turns; a scene has at most {} steps", turns, limits_.steps),
        "--limit steps=N allows more");
    return;
  }
  if (turns > 1 && !has_room_for(turns * least_shapes(around).in_turn_of(loop), place)) return;
  auto& bindings = evaluator_.bindings();
  NameTable names;
  Surroundings inside = around;
  inside.is_top = false;
  inside.names = &names;
  inside.depends_on_time = depends_on_time;
  for (double k = 0; k < turns && !halted_; ++k) {
    const std::size_t value_height = bindings.height(), definition_height = definitions_.height(),
                      material_height = materials_.height();
    if (!spend(1, place)) break;
    names.clear();
    inside.let_base = value_height;
    inside.definition_base = definition_height;
    inside.material_base = material_height;
    Value value = Value::number(from + k * step);
    value.depends_on_time = depends_on_time;
    bindings.push(loop.name, {value, nullptr, false}, {around.source, loop.name_span});
    build_items(loop.items, inside);
    bindings.pop_to(value_height);
    definitions_.pop_to(definition_height);
    materials_.pop_to(material_height);
  }
}

void Builder::build_if(const IfNode& choice, const Surroundings& around) {
  const Value condition = evaluator_.evaluate(*choice.condition, *around.source, around.frame->values);
  if (!spend(1, {around.source, choice.keyword}) || !condition.is_known()) return;
  if (!condition.is_boolean()) {
    diagnostics_.error({around.source, choice.condition->span},
                       fmt::format("'if' takes true or false, found {}", describe(condition.type)),
                       "if t > 2 { … }");
    return;
  }
  auto& bindings = evaluator_.bindings();
  const std::size_t value_height = bindings.height(), definition_height = definitions_.height();
  Surroundings inside = around;
  inside.is_top = false;
  inside.let_base = value_height;
  inside.definition_base = definition_height;
  inside.depends_on_time = around.depends_on_time || condition.depends_on_time;
  build_items(condition.is_true() ? choice.items : choice.else_items, inside);
  // A definition chosen by a condition stays, unless it may see a let that goes.
  if (bindings.height() > value_height) definitions_.pop_to(definition_height);
  bindings.pop_to(value_height);
}

Value Builder::parameter_default(const ParameterNode& parameter, const Surroundings& around) {
  std::array<Value, 3> values;
  const auto count = parameter.values.size();
  bool known = true;
  for (std::size_t i = 0; i < std::min(count, values.size()); ++i) {
    values[i] = evaluator_.evaluate(parameter.values[i], *around.source, around.frame->values);
    known = known && values[i].is_known();
  }
  if (!known || count == 1) return values[0];
  const bool is_vector =
      count == 3 && values[0].is_number() && values[1].is_number() && values[2].is_number();
  if (is_vector) return Value::of_vector({values[0].x(), values[1].x(), values[2].x()});
  diagnostics_.error(
      {around.source, {parameter.values.front().span.begin, parameter.values.back().span.end}},
      fmt::format("the default of a parameter is one value or three numbers, found {} values", count),
      "(size 1, at 0 1 0, hat black)");
  return {};
}

void Builder::build_define(const DefineNode& define, const Surroundings& around) {
  const Place place{around.source, define.name_span};
  if (!spend(1, place)) return;
  auto definition = std::make_shared<Definition>();
  definition->node = &define;
  definition->source = around.source;
  definition->name = place.text();
  definition->frame = *around.frame;
  definition->is_top = around.is_top;
  for (const ParameterNode& parameter : define.parameters) {
    PropertyRow row;
    row.name = around.source->text(parameter.name_span);
    definition->defaults.push_back(parameter_default(parameter, around));
    row.type = parameter_type(definition->defaults.back().type);
    definition->parameters.push_back(row);
  }
  definition->row.name = definition->name;
  definition->row.placing = Placing::kAffine;
  definition->row.takes_material = true;
  definition->row.properties = definition->parameters;
  const std::size_t known = definitions_.find(define.name, around.frame->definitions);
  if (known != decltype(definitions_)::npos && known >= around.definition_base) {
    diagnostics_.error(place, fmt::format("'{}' is defined twice", definition->name), {},
                       {{definitions_.at(known).place, "first defined here"}});
    return;
  }
  if (SceneRecorder* told = recorder()) told->define(definition.get(), definition->name);
  if (around.is_top) top_definitions_.push_back(definition);
  diagnostics_.mute(true);  // what is wrong is told when it is used
  definition->least = least_shapes(around).of(define);
  diagnostics_.mute(false);
  // Its own name belongs to what the body sees: a definition may use itself.
  definition->heights = {evaluator_.bindings().height(), definitions_.height() + 1, materials_.height()};
  definitions_.push(define.name, std::move(definition), place);
}

LeastShapes Builder::least_shapes(const Surroundings& around) {
  return LeastShapes(evaluator_, *around.source, around.frame->values,
                     [this, &around](NameId name) { return find_definition(name, around); });
}

// Whether neither it nor any of the definitions in it has been used.
bool Builder::is_fresh(const Definition& definition) const {
  std::unordered_set<const Definition*> seen = {&definition};
  std::vector<const Definition*> waiting = {&definition};
  while (!waiting.empty()) {
    const Definition* next = waiting.back();
    waiting.pop_back();
    if (used_definitions_.contains(next->node)) return false;
    for (const auto& inner : next->least.uses) {
      if (seen.insert(inner.get()).second) waiting.push_back(inner.get());
    }
  }
  return true;
}

void Builder::build_use(const std::shared_ptr<const Definition>& definition, const BlockNode& block,
                        const Surroundings& around) {
  const Place place{around.source, block.header()};
  if (!spend(kStepsPerUse, place)) return;
  if (use_depth_ >= limits_.nesting) {
    return halt(place, fmt::format("uses of definitions are nested more than {} deep", limits_.nesting),
                "a definition that uses itself needs an 'if' that ends it; --limit nesting=N allows more");
  }
  if (is_fresh(*definition) && !has_room_for(definition->least.at_first, place)) return;
  used_definitions_[definition->node] = true;
  const std::string_view name =
      block.words.empty() ? std::string_view() : around.source->text(block.words[0]);
  register_name(definition->row, name, place, around);
  std::vector<Value> arguments = definition->defaults;
  const SceneRecorder::Block recorded(recorder(), definition->row, name);
  BlockContext context(*this, definition->row, block, around, name);
  context.parameters_ = &arguments;
  if (!fill(context, nullptr)) return;
  if (SceneRecorder* told = recorder()) told->use(definition.get(), arguments);

  Surroundings inside;
  inside.source = definition->source;
  inside.kind = definition->name;
  inside.to_world = context.placed(Vector3d(0));
  inside.material = context.material_.value_or(around.material);
  inside.depends_on_time = context.depends_on_time();

  // The first use is built where it stands; when the same comes again, it is built once more in its own
  // space, for that and all later uses. One level of instances: uses inside uses are built out.
  if (store_.is_recording()) return build_body(*definition, arguments, inside, place);
  const void* owner = definition->is_top ? static_cast<const void*>(definition->node) : definition.get();
  const std::string key = use_key(owner, arguments, inside.material);
  UseRecord& record = uses_[key];
  if (++record.count == 1) {
    const std::uint64_t shapes = shapes_made_, lights = lights_made_, endless = store_.endless_made(),
                        built_out = built_out_;
    build_body(*definition, arguments, inside, place);
    UseRecord& done = uses_[key];  // the body's own uses may have moved it
    done.shapes = built_out_ - built_out;
    done.can_be_shared =
        shapes_made_ - shapes >= kLeastToShare && lights_made_ == lights && store_.endless_made() == endless;
    return;
  }
  if (!record.can_be_shared) return build_body(*definition, arguments, inside, place);
  if (record.shared == nullptr) {
    if (!has_room_for(static_cast<double>(record.shapes), place)) return;
    const std::uint64_t built_out = built_out_;
    auto shared = share_body(*definition, arguments, inside, key, place);
    built_out_ = built_out;
    record.shared = std::move(shared);
  }
  note_shape(place);
  built_out_ += record.shapes - 1;
  if (record.shared != nullptr) store_.add_instance(record.shared, inside.to_world);
}

// The body of a definition in its own space, with a tree over it.
std::shared_ptr<const SharedShapes> Builder::share_body(const Definition& definition,
                                                        const std::vector<Value>& arguments,
                                                        Surroundings inside, const std::string& key,
                                                        const Place& used_at) {
  // Of what is defined at the top and uses no time every moment finds the same.
  const bool may_be_kept = definition.is_top && !inside.depends_on_time;
  if (may_be_kept) {
    if (auto kept = store_.find_kept(key)) return kept;
  }
  inside.to_world = Transform{};
  ShapeBatch list;
  const bool used_time = evaluator_.uses_time();
  evaluator_.forget_time();
  store_.record(list);
  build_body(definition, arguments, inside, used_at);
  store_.stop_recording();
  const bool uses_time = evaluator_.uses_time();
  if (used_time) evaluator_.note_time();
  if (halted_) return nullptr;
  auto shared = ShapeStore::share(std::move(list), draft_.scene.materials);
  if (may_be_kept && !uses_time) store_.keep(key, shared);
  return shared;
}

// Runs a definition's statements with its parameters bound, seeing what its text sees.
void Builder::build_body(const Definition& definition, const std::vector<Value>& arguments,
                         Surroundings inside, const Place& used_at) {
  const Diagnostics::UsedFrom used_from(diagnostics_, used_at);
  const SceneRecorder::Body recorded(recorder(), &definition, arguments);
  auto& bindings = evaluator_.bindings();
  const std::array<std::size_t, 3> heights = {bindings.height(), definitions_.height(), materials_.height()};
  Frame frame;
  frame.values = {heights[0], definition.heights[0], &definition.frame.values};
  frame.definitions = {heights[1], definition.heights[1], &definition.frame.definitions};
  frame.materials = {heights[2], definition.heights[2], &definition.frame.materials};
  NameTable names;
  inside.frame = &frame;
  inside.names = &names;
  inside.let_base = heights[0];
  inside.definition_base = heights[1];
  inside.material_base = heights[2];
  for (std::size_t i = 0; i < arguments.size(); ++i) {
    const ParameterNode& parameter = definition.node->parameters[i];
    bindings.push(parameter.name, {arguments[i], nullptr, false}, {definition.source, parameter.name_span});
  }
  ++use_depth_;
  build_items(definition.node->items, inside);
  --use_depth_;
  bindings.pop_to(heights[0]);
  definitions_.pop_to(heights[1]);
  materials_.pop_to(heights[2]);
}

}  // namespace raytracer::scene_file
