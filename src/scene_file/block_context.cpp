// One block: its properties against the rows of its kind, its place in the world, its children.
#include <fmt/format.h>

#include <algorithm>

#include "core/suggest.hpp"
#include "scene_file/arguments.hpp"
#include "scene_file/builder.hpp"
#include "scene_file/colors.hpp"
#include "scene_file/item_cutter.hpp"
#include "scene_file/placing.hpp"

namespace raytracer::scene_file {
namespace {

// A transform word: the builder itself knows what to do with it.
bool is_placing(const PropertyRow& row) { return row.store == nullptr && row.is_placing; }

}  // namespace

SceneDraft& BlockContext::draft() { return builder_.draft_; }

const Given* BlockContext::given(std::string_view property) const {
  const auto found = std::ranges::find_if(given_, [&](const Given& g) { return g.row->name == property; });
  return found == given_.end() ? nullptr : &*found;
}

void BlockContext::error(std::string_view property, std::string message, std::string suggestion) {
  builder_.diagnostics_.error(place_of(property), std::move(message), std::move(suggestion));
}

void BlockContext::value_error(std::string_view property, std::string message, std::string suggestion) {
  builder_.diagnostics_.error(given(property)->values, std::move(message), std::move(suggestion));
}

void BlockContext::error_at(Span span, std::string message, std::string suggestion) {
  builder_.diagnostics_.error(place(span), std::move(message), std::move(suggestion));
}

void BlockContext::warning(std::string_view property, std::string message, std::string suggestion) {
  builder_.diagnostics_.warning(place_of(property), std::move(message), std::move(suggestion));
}

Place BlockContext::place_of(std::string_view property) const {
  const Given* written = given(property);
  return written != nullptr ? written->place : header();
}

Method BlockContext::method() const { return builder_.method_; }

// The message of a shape that can't be quotes the property it is about; the place is that property's, if it
// was given.
void BlockContext::report_bad_shape(std::string_view problem) {
  const std::size_t open = problem.find('\'');
  const std::size_t close = open == std::string_view::npos ? open : problem.find('\'', open + 1);
  const bool names_property = close != std::string_view::npos;
  error(names_property ? problem.substr(open + 1, close - open - 1) : std::string_view(),
        std::string(problem));
}

// Notes a property as given; false where it was given before, which is an error unless it places the block.
bool BlockContext::accept(const PropertyRow& row, const Place& place, const Place& values) {
  const Given* first = given(row.name);
  const bool repeatable =
      row.is_repeatable || (is_placing(row) && row.name != "pivot" && row.name != "matrix");
  if (first != nullptr && !repeatable) {
    builder_.diagnostics_.error(place, fmt::format("'{}' is given twice", row.name), {},
                                {{first->place, "first given here"}});
    return false;
  }
  if (given_.empty()) given_.reserve(8);
  if (first == nullptr) given_.push_back({&row, place, values});
  return true;
}

bool BlockContext::apply_placing(const PropertyRow& row, const Argument& argument, const Place& place) {
  const bool is_matrix = row.name == "matrix";
  for (const Given& other : given_) {
    if (is_placing(*other.row) && (other.row->name == "matrix") != is_matrix) {
      builder_.diagnostics_.error(place, "'matrix' stands in place of all other transforms", "write either");
      return false;
    }
  }
  if (row.name == "scale" && row_.placing == Placing::kRigid) {
    builder_.diagnostics_.error(place, fmt::format("'scale' means nothing to a {}", row_.name),
                                "it has no size of its own");
    return false;
  }
  const std::string problem = add_placing(row.name, argument, placing_);
  if (!problem.empty()) builder_.diagnostics_.error(place, problem);
  return problem.empty();
}

void BlockContext::report_unknown_property(Span name) {
  const std::string_view word = around_.source->text(name);
  std::vector<std::string_view> known;
  for (const PropertyRow& row : row_.properties) known.push_back(row.name);
  if (row_.takes_material) known.push_back(material_property().name);
  if (row_.placing != Placing::kNone) {
    for (const PropertyRow& row : transform_properties()) known.push_back(row.name);
  }
  std::string_view nearest = nearest_word(word, known);
  if (nearest.empty()) {  // `rotate` of a picture: uv_rotate
    const auto longer = std::ranges::find_if(
        known, [&](std::string_view each) { return each.ends_with(fmt::format("_{}", word)); });
    if (longer != known.end()) nearest = *longer;
  }
  std::string suggestion;
  if (std::ranges::find(row_.words_to_come, word) != row_.words_to_come.end()) {
    builder_.diagnostics_.error(place(name), fmt::format("'{}' can't be shown yet", word),
                                "a later version will; remove it");
    return;
  }
  if (!nearest.empty()) {
    suggestion = fmt::format("did you mean '{}'?", nearest);
  } else if (row_.takes_material && is_property_of("material", word)) {
    suggestion = fmt::format("that is the material's: material {{ {} … }}", word);
  } else if (row_.has_children && find_kind(word) != nullptr) {
    suggestion = fmt::format("a block needs braces: {} {{ … }}", word);
  } else {
    suggestion = fmt::format("it has {}", fmt::join(known, ", "));
  }
  builder_.diagnostics_.error(place(name), fmt::format("{} has no property '{}'", called(row_), word),
                              suggestion);
}

void BlockContext::store(const PropertyRow& row, const Argument& argument, void* input) {
  if (parameters_ == nullptr) {
    const bool is_number =
        row_.block_class == BlockClass::kTexture && builder_.texture_meaning_ != TextureMeaning::kLight;
    if (!argument.is_display || builder_.method_ == Method::kClassic || is_number) {
      return row.store(input, argument);
    }
    Argument linear = argument;
    for (std::size_t i = 0; i < 3; ++i) linear.numbers[i] = linear_from_display(argument.numbers[i]);
    return row.store(input, linear);
  }
  Value& value = (*parameters_)[static_cast<std::size_t>(&row - row_.properties.data())];
  const auto& n = argument.numbers;
  switch (row.type) {
    case PropertyType::kVector:
    case PropertyType::kColor: {
      const bool is_color = row.type == PropertyType::kColor || argument.is_display;
      value = is_color ? Value::color({n[0], n[1], n[2]}) : Value::of_vector({n[0], n[1], n[2]});
      value.is_display = argument.is_display;
      break;
    }
    case PropertyType::kString:
      value.text = builder_.evaluator_.names().text(builder_.evaluator_.names().id_of(argument.text));
      break;
    default:
      value.vector = {n[0], 0, 0};
      break;
  }
  value.depends_on_time = argument.depends_on_time;
}

bool BlockContext::fill_item(const PropertyNode& property, void* input) {
  const PropertyRow* row = property.is_nameless() ? find_file_property(row_)
                                                  : find_property(row_, around_.source->text(property.name));
  if (row == nullptr) {
    report_unknown_property(property.name);
    return false;
  }
  const Span whole = property.whole();
  if (!accept(*row, place(whole),
              place({property.values.empty() ? whole.begin : property.values.front().span.begin, whole.end})))
    return false;
  if (parameters_ == nullptr && misses_texture(*row, property)) return false;
  if (row->store_texture != nullptr && parameters_ == nullptr) {
    if (const auto is_sound = fill_texture_item(*row, property, input)) return *is_sound;
  }
  if (property.body != nullptr) {
    builder_.diagnostics_.error(place(property.body->header()),
                                fmt::format("'{}' takes {}, found a block", row->name, describe_type(*row)),
                                fmt::format("{} {}", row->name, example_value(*row)));
    return false;
  }
  const auto argument = read_argument(*row, property, *around_.source, around_.frame->values,
                                      builder_.evaluator_, builder_.diagnostics_);
  if (!argument) return false;
  depends_on_time_ = depends_on_time_ || argument->depends_on_time;
  if (SceneHasher* hasher = builder_.hasher()) hasher->add(*row, *argument);
  if (row->type == PropertyType::kMaterial) {
    material_ = builder_.find_material(argument->text, place(property.values.front().span), around_);
    note_material();
    return material_.has_value();
  }
  const bool is_parameter = parameters_ != nullptr && !is_placing(*row);
  if (SceneRecorder* recorder = builder_.recorder(); recorder && !is_parameter) {
    Argument told = *argument;
    if (row->type == PropertyType::kFile)
      told.text = builder_.files_.seen_from(recorder->folder(), told.text, *around_.source);
    recorder->add(*row, told);
  }
  if (is_placing(*row)) return apply_placing(*row, *argument, place(property.whole()));
  if (row->method && !is_parameter) {
    builder_.draft_.render.particular.push_back({row->name, *row->method, place(whole)});
  }
  store(*row, *argument, input);
  return true;
}

// What is made of a material that changes with time changes with it.
void BlockContext::note_material() {
  depends_on_time_ = depends_on_time_ || (material_ && builder_.material_uses_[*material_].depends_on_time);
}

// A block inside this one: a material in place, a child, or a mistake.
bool BlockContext::fill_block(const BlockNode& block, void* input) {
  const std::string_view word = around_.source->text(block.kind);
  const PropertyRow* row = find_property(row_, word);
  if (row != nullptr && row->type == PropertyType::kMaterial && block.words.empty()) {
    if (!accept(*row, place(block.header()), place(block.header()))) return false;
    material_ = builder_.build_inline_material(block, around_);
    note_material();
    return material_.has_value();
  }
  if (row != nullptr && row->store_texture != nullptr && block.words.size() == 1 && parameters_ == nullptr) {
    return accept(*row, place(block.header()), place(block.header())) &&
           fill_texture_block(*row, block, input);
  }
  const bool is_texture = row != nullptr && row->type != PropertyType::kMaterial && block.words.size() == 1 &&
                          find_texture_kind(around_.source->text(block.words[0])) != nullptr;
  if (is_texture) {
    report_no_texture(*row, block.words[0]);
    return false;
  }
  if (row != nullptr && (row->type != PropertyType::kMaterial || !row_.has_children)) {
    const bool names_material = row->type == PropertyType::kMaterial;
    builder_.diagnostics_.error(
        place(block.header()), fmt::format("'{}' takes {}, found a block", word, describe_type(*row)),
        names_material ? "a material in place has no name" : fmt::format("{} {}", word, example_value(*row)));
    return false;
  }
  if (row_.has_children) return true;  // its turn comes when this block is whole
  if (!node_.is_closed) {              // it may well stand behind this block, whose '}' is missing
    builder_.build_block(block, around_);
    return true;
  }
  const KindRow* kind = find_kind(word);
  if (kind != nullptr || builder_.find_definition(block.kind_name, around_) != nullptr) {
    const bool is_setting = kind != nullptr && kind->block_class == BlockClass::kSetting;
    builder_.diagnostics_.error(
        place(block.header()), fmt::format("a {} can't hold a {}", row_.name, word),
        is_setting ? fmt::format("'{}' stands at the top of the scene", word) : "put both into a group");
  } else {
    report_unknown_property(block.kind);
  }
  return false;
}

// The items as they are meant: where the parser can't have known what a property takes, cut anew by this
// kind's rows.
void BlockContext::cut_items() {
  items_ = node_.items;
  if (node_.is_exact) return;
  ItemCutter cutter(row_, *around_.source, builder_.evaluator_.names(), builder_.draft_.nodes,
                    [this](std::string_view word) {
                      return find_kind(word) != nullptr ||
                             builder_.find_definition(builder_.evaluator_.names().id_of(word), around_) !=
                                 nullptr;
                    });
  if (cutter.is_needed(node_.items)) items_ = cutter.cut(node_.items);
}

bool BlockContext::fill_items(void* input) {
  bool sound = true;
  for (const ItemNode& item : items_) {
    if (const auto* property = std::get_if<const PropertyNode*>(&item)) {
      sound = fill_item(**property, input) && sound;
    } else if (const auto* block = std::get_if<const BlockNode*>(&item)) {
      sound = fill_block(**block, input) && sound;
    } else if (const auto* let = std::get_if<const LetNode*>(&item)) {
      builder_.build_let(**let, around_, let_base_, false);
    } else if (!row_.has_children && node_.is_closed) {
      report_statement(item);
      sound = false;
    }
  }
  return sound;
}

// A statement in a block that has no room for one.
void BlockContext::report_statement(const ItemNode& item) {
  const Span keyword = std::visit(
      [](const auto* node) -> Span {
        if constexpr (requires { node->keyword; }) return node->keyword;
        return {};
      },
      item);
  builder_.diagnostics_.error(
      place(keyword), fmt::format("'{}' can't stand in a {}", around_.source->text(keyword), row_.name),
      "it stands where a block may stand; a single value can be chosen: (a > 0 ? 1 : 2)");
}

bool BlockContext::check_required() {
  std::vector<std::string> missing;
  std::string example;
  for (const PropertyRow& row : row_.properties) {
    if (!row.required || is_given(row.name)) continue;
    missing.push_back(fmt::format("'{}'", row.name));
    if (example.empty()) example = fmt::format("{} {}", row.name, example_value(row));
  }
  if (missing.empty()) return true;
  builder_.diagnostics_.error(header(), fmt::format("{} has no {}", called(row_), fmt::join(missing, ", ")),
                              example);
  return false;
}

bool fill(BlockContext& context, void* input) {
  Evaluator& evaluator = context.builder_.evaluator_;
  context.let_base_ = evaluator.bindings().height();
  SceneHasher* hasher = context.builder_.hasher();
  if (hasher != nullptr) {
    hasher->begin_block(context.row_, context.name_, context.around_.to_world, context.around_.material);
  }
  context.cut_items();
  bool sound = context.fill_items(input);
  sound = context.check_required() && sound;
  evaluator.bindings().pop_to(context.let_base_);
  if (hasher != nullptr) hasher->end_block(context.material_);
  if (!sound && context.row_.has_children) context.build_children();  // for the mistakes in them
  return sound;
}

void BlockContext::build_children() {
  Surroundings inside = around_;
  inside.kind = row_.name;
  inside.to_world = placed(Vector3d(0));
  inside.material = material_.value_or(around_.material);
  inside.let_base = builder_.evaluator_.bindings().height();
  inside.depends_on_time = depends_on_time();
  inside.is_unclosed = around_.is_unclosed || !node_.is_closed;
  inside.is_top = false;
  const std::size_t definition_height = builder_.definitions_.height();
  inside.definition_base = definition_height;
  const auto is_child = [&](const ItemNode& item) {
    const auto* block = std::get_if<const BlockNode*>(&item);
    if (block == nullptr) return !std::holds_alternative<const PropertyNode*>(item);
    return !(*block)->words.empty() || around_.source->text((*block)->kind) != "material";
  };
  for (const ItemNode& item : items_) {
    if (is_child(item)) builder_.build_item(item, inside);
  }
  builder_.evaluator_.bindings().pop_to(inside.let_base);
  builder_.definitions_.pop_to(definition_height);
}

// Light that goes into a sheet of solid glass would never come out.
void BlockContext::warn_of_solid_sheet(const Material& material) {
  if (material.transmission == 0 || material.thin) return;
  warning({}, fmt::format("a {} encloses nothing, and its material lets light in", row_.name),
          "a pane's material is thin: material { transmission 1  thin true }");
}

void BlockContext::add_shape(std::unique_ptr<Shape> shape) {
  builder_.note_shape(header());
  const std::uint32_t material = material_.value_or(around_.material);
  if (!name_.empty() && shape->bounds().is_finite()) {
    builder_.draft_.named_shapes.try_emplace(std::string(name_), shape->bounds());
  }
  if (row_.is_sheet) warn_of_solid_sheet(builder_.draft_.scene.materials[material]);
  constexpr std::size_t kMostPlaces = 1000;
  auto& places = builder_.draft_.shining_places;
  if (builder_.draft_.scene.materials[material].is_emissive() && places.size() < kMostPlaces) {
    places.insert_or_assign(shape.get(), header());  // at an address that another may have had
  }
  builder_.store_.add(std::move(shape), material, depends_on_time());
}

void BlockContext::add_mesh_file(std::string_view property, const std::string& file, MeshOptions options) {
  options.linear_colors = builder_.method_ == Method::kPath;
  const Place& place = given(property)->place;
  const std::string path =
      builder_.files_.find(file, place, "a file to read a mesh from", builder_.diagnostics_);
  if (path.empty()) return;
  SceneHasher* hasher = builder_.hasher();
  MeshFile* mesh = builder_.meshes_.read(path, file, options, place, hasher != nullptr);
  if (mesh == nullptr) return;
  if (hasher != nullptr) hasher->add_content(*mesh->hash);
  builder_.note_shape(header());
  const MeshUse use{mesh,
                    placed(Vector3d(0)),
                    material_.value_or(around_.material),
                    material_.has_value(),
                    depends_on_time(),
                    place};
  if (builder_.is_trying_) return;
  if (!builder_.store_.is_recording()) return builder_.meshes_.add(use);
  try {
    std::vector<Material>& materials = builder_.draft_.scene.materials;
    builder_.meshes_.add_copy(use, materials, builder_.store_.recorded());
    builder_.material_uses_.resize(materials.size(), {{}, true, false, 0});
  } catch (const Error& problem) {
    builder_.diagnostics_.error(place, fmt::format("'{}': {}", file, problem.what()));
  }
}

void BlockContext::add_light(const Light& light) {
  builder_.note_shape(header());
  ++builder_.lights_made_;
  builder_.draft_.scene.lights.push_back(light);
  builder_.draft_.light_places.push_back(header());
}

std::uint32_t BlockContext::add_material(const Material& material) {
  SceneDescription& scene = builder_.draft_.scene;
  const auto index = static_cast<std::uint32_t>(scene.materials.size());
  scene.materials.push_back(material);
  builder_.material_uses_.push_back({{}, true, false, 0});
  builder_.last_material_ = index;
  if (SceneHasher* hasher = builder_.hasher()) hasher->add_material(index);
  return index;
}

}  // namespace raytracer::scene_file
