// The vocabulary of the scene language: one row registers a kind of block, one row each of its properties.
// Parsing, checking, suggestions and `raytracer help` all read these rows.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include "raytracer/method.hpp"
#include "raytracer/texture.hpp"
#include "raytracer/vector3f.hpp"
#include "scene_file/source.hpp"

namespace raytracer::scene_file {

class BlockContext;
struct BlockNode;

/// What may stand behind a property's name.
enum class PropertyType : std::uint8_t {
  kNumber,
  kInteger,
  kBoolean,
  kString,
  kFile,    ///< the name of a file, relative to the file that says it
  kVector,  ///< three numbers
  kSize,    ///< one number for all axes, or three
  kPixels,  ///< two whole numbers
  kPair,    ///< two numbers
  kColor,
  kWord,      ///< one of a list of words
  kMaterial,  ///< the name of a material, or one in place
  kName,      ///< a bare word: of a shape
  kStop,      ///< a number and a colour
  kAxisAngle,
  kMatrix,
  kNumbers,  ///< any number of numbers, vectors among them
  kIndices,  ///< likewise whole ones, which keep their places
};

/// The values that make sense, for each number of a property.
struct Range {
  double least = -1e18, most = 1e18;  ///< beyond, single precision and the traversal lose their footing
  bool above_least = false;           ///< `least` itself makes no sense
};

inline constexpr Range kAnyNumber{};
inline constexpr Range kPositive{0, 1e18, true};
inline constexpr Range kNotNegative{0, 1e18, false};
inline constexpr Range kShare{0, 1, false};
/// Of what shines. A quadratic light for lengths in the millions is beyond 1e15, and the product of two such
/// numbers must stay well within what single precision holds.
inline constexpr double kBrightest = 1e32;
inline constexpr Range kBrightness{0, kBrightest, false};

/// A value that fits its property: what the rows store away.
struct Argument {
  std::array<double, 12> numbers{};
  std::string text;
  std::vector<double> list;  ///< of kNumbers and kIndices
  std::vector<Span> places;  ///< of kIndices: where each of the list is written
  std::uint32_t index = 0;   ///< of a word in its list, of a material in the scene
  bool is_display = false;   ///< of a colour, as Value has it
  bool depends_on_time = false;
};

/// A colour in the numbers that the scene's method computes with; 1 is white. What was written as a display
/// colour (#rrggbb, a name) has become linear in `path`, and is as it was in `classic`.
struct ColorValue {
  Vector3d rgb{1};
};

/// A material of the scene by its index.
struct MaterialIndex {
  std::uint32_t index = 0;
};

/// A colour of a ramp, and where it stands.
struct StopValue {
  double at = 0;
  Vector3d rgb{1};
};

/// A colour that a texture may take the place of.
struct ColorOrTexture {
  Vector3d rgb{1};
  TexturePointer texture;
};

/// The name of a file as written.
struct FileName {
  std::string name;
};

/// Numbers of other things, and where each stands.
struct IndexList {
  std::vector<double> numbers;
  std::vector<Span> places;
};

struct PropertyRow {
  std::string_view name;
  PropertyType type = PropertyType::kNumber;
  std::string_view unit;
  Range range;
  std::string_view help;
  std::span<const std::string_view> words;  ///< of a kWord
  std::string_view default_text;            ///< said instead of the value in the input struct
  bool required = false;
  bool is_placing = false;  ///< a transform word
  bool is_repeatable = false;
  bool is_texture_only = false;  ///< the same value everywhere makes no sense
  bool is_opacity = false;       ///< of a picture with an alpha channel that is what counts
  std::optional<Method> method;  ///< the only one in which it has an effect
  void (*store)(void* input, const Argument& argument) = nullptr;
  void (*store_texture)(void* input, const TexturePointer& texture) = nullptr;  ///< null: it takes none
  std::string (*default_value)(const void* input,
                               const PropertyRow& row) = nullptr;  ///< as it would be written

 private:
  // First: Clang 14 wants it defined before the constants below are computed.
  template <class Field>
  constexpr PropertyRow with(Field PropertyRow::*field, const Field& value) const {
    PropertyRow row = *this;
    row.*field = value;
    return row;
  }

 public:
  constexpr PropertyRow in(std::string_view new_unit) const { return with(&PropertyRow::unit, new_unit); }
  constexpr PropertyRow within(Range new_range) const { return with(&PropertyRow::range, new_range); }
  constexpr PropertyRow one_of(std::span<const std::string_view> list) const {
    return with(&PropertyRow::words, list);
  }
  constexpr PropertyRow or_else(std::string_view said) const {
    return with(&PropertyRow::default_text, said);
  }
  constexpr PropertyRow as(PropertyType new_type) const { return with(&PropertyRow::type, new_type); }
  constexpr PropertyRow for_textures_alone() const { return with(&PropertyRow::is_texture_only, true); }
  constexpr PropertyRow only_in(Method one) const { return with(&PropertyRow::method, std::optional(one)); }
  constexpr PropertyRow as_opacity() const { return with(&PropertyRow::is_opacity, true); }
  /// A texture may stand in its place, for which `Textures` of the input struct has the member `Texture`.
  template <auto Textures, auto Texture>
  constexpr PropertyRow or_texture() const;
  constexpr PropertyRow must_be_given() const { return with(&PropertyRow::required, true); }
};

/// What of a block can be moved, turned and grown.
enum class Placing : std::uint8_t { kNone, kRigid, kAffine };

/// Where a kind of block belongs.
enum class BlockClass : std::uint8_t {
  kSetting,   ///< at the top of the scene, at most once unless it has a name
  kMaterial,  ///< anywhere; with a name it can be used later
  kTexture,   ///< likewise
  kObject,    ///< at the top and in groups
};

struct KindRow {
  std::string_view name;
  std::string_view variant;  ///< the word behind `light`; empty for the plain kind
  BlockClass block_class = BlockClass::kObject;
  Placing placing = Placing::kNone;
  bool takes_material = false;
  bool has_children = false;
  bool is_sheet = false;  ///< a shape that encloses nothing, whatever its properties
  std::string_view help;
  std::span<const PropertyRow> properties;
  std::span<const std::string_view>
      words_to_come;  ///< properties that the language knows and nothing shows yet
  void (*build)(BlockContext& context) = nullptr;
  std::string (*default_of)(const PropertyRow& row) = nullptr;
};

/// All kinds, in the order in which help lists them.
std::span<const KindRow> all_kinds();

/// The rows of `translate`, `rotate` …, which every kind with a Placing understands.
std::span<const PropertyRow> transform_properties();
/// The row of `material`, which every kind that takes one understands.
const PropertyRow& material_property();

/// The kind of that name; for kinds with variants the one of that variant. Null where there is none.
const KindRow* find_kind(std::string_view name, std::string_view variant = {});
bool may_have_variant(std::string_view kind);

/// As messages call it: sphere, sky image, and of a texture the word alone.
std::string called(const KindRow& kind);

/// What the kinds of textures are variants of: `texture checker oak { … }`.
inline constexpr std::string_view kTextureKind = "texture";
/// The kind of texture of that name, as in `color checker { … }`; null where there is none.
const KindRow* find_texture_kind(std::string_view name);

/// A property of the kind, its common ones included; null where it has none of that name.
const PropertyRow* find_property(const KindRow& kind, std::string_view name);
/// The property that a file's name without a word for it belongs to; null where the kind names no file.
const PropertyRow* find_file_property(const KindRow& kind);
/// Whether any variant of the kind has a property of that name.
bool is_property_of(std::string_view kind, std::string_view property);

/// What a property takes, in words: "three numbers".
std::string describe_type(const PropertyRow& row);
/// A value that would be right: "0 1 0".
std::string example_value(const PropertyRow& row);
/// The range in words; of a one-sided range the side that `value` is on.
std::string describe_range(const Range& range, double value = 0);
/// The default as it would be written, or words for it; empty where there is none.
std::string describe_default(const KindRow& kind, const PropertyRow& row);

// --- how rows are made
// ---------------------------------------------------------------------------------------------

/// Gathers the block's properties into the struct that its rows name; false where one of them was wrong.
bool fill(BlockContext& context, void* input);

namespace detail {

template <class T>
struct MemberPointer;
template <class Class, class Field>
struct MemberPointer<Field Class::*> {
  using Input = Class;
  using Type = Field;
};
template <class T>
struct Unwrap {
  using Type = T;
};
template <class T>
struct Unwrap<std::optional<T>> {
  using Type = T;
};

template <class T>
constexpr PropertyType property_type() {
  if constexpr (std::is_same_v<T, double>) return PropertyType::kNumber;
  if constexpr (std::is_same_v<T, int>) return PropertyType::kInteger;
  if constexpr (std::is_same_v<T, bool>) return PropertyType::kBoolean;
  if constexpr (std::is_same_v<T, std::string>) return PropertyType::kString;
  if constexpr (std::is_same_v<T, FileName>) return PropertyType::kFile;
  if constexpr (std::is_same_v<T, std::vector<double>>) return PropertyType::kNumbers;
  if constexpr (std::is_same_v<T, IndexList>) return PropertyType::kIndices;
  if constexpr (std::is_same_v<T, Vector3d>) return PropertyType::kVector;
  if constexpr (std::is_same_v<T, std::array<int, 2>>) return PropertyType::kPixels;
  if constexpr (std::is_same_v<T, std::array<double, 2>>) return PropertyType::kPair;
  if constexpr (std::is_same_v<T, std::vector<StopValue>>) return PropertyType::kStop;
  if constexpr (std::is_same_v<T, ColorOrTexture>) return PropertyType::kColor;
  if constexpr (std::is_same_v<T, ColorValue>) return PropertyType::kColor;
  if constexpr (std::is_same_v<T, MaterialIndex>) return PropertyType::kMaterial;
  if constexpr (std::is_enum_v<T>) return PropertyType::kWord;
}

template <class T>
T from_argument(const Argument& a) {
  const auto& n = a.numbers;
  if constexpr (std::is_same_v<T, double>) return n[0];
  if constexpr (std::is_same_v<T, int>) return static_cast<int>(n[0]);
  if constexpr (std::is_same_v<T, bool>) return n[0] != 0;
  if constexpr (std::is_same_v<T, std::string>) return a.text;
  if constexpr (std::is_same_v<T, FileName>) return {a.text};
  if constexpr (std::is_same_v<T, std::vector<double>>) return a.list;
  if constexpr (std::is_same_v<T, IndexList>) return {a.list, a.places};
  if constexpr (std::is_same_v<T, Vector3d>) return {n[0], n[1], n[2]};
  if constexpr (std::is_same_v<T, std::array<int, 2>>)
    return {static_cast<int>(n[0]), static_cast<int>(n[1])};
  if constexpr (std::is_same_v<T, std::array<double, 2>>) return {n[0], n[1]};
  if constexpr (std::is_same_v<T, StopValue>) return {n[3], {n[0], n[1], n[2]}};
  if constexpr (std::is_same_v<T, ColorOrTexture>) return {{n[0], n[1], n[2]}, nullptr};
  if constexpr (std::is_same_v<T, ColorValue>) return {{n[0], n[1], n[2]}};
  if constexpr (std::is_same_v<T, MaterialIndex>) return {a.index};
  if constexpr (std::is_enum_v<T>) return static_cast<T>(a.index);
}

std::string number_text(double value);

template <class T>
std::string to_text(const T& value, const PropertyRow& row) {
  if constexpr (std::is_same_v<T, double> || std::is_same_v<T, int>) {
    return number_text(static_cast<double>(value));
  } else if constexpr (std::is_same_v<T, bool>) {
    return value ? "true" : "false";
  } else if constexpr (std::is_same_v<T, Vector3d>) {
    if (row.type == PropertyType::kSize && value.x == value.y && value.y == value.z)
      return number_text(value.x);
    return number_text(value.x) + ' ' + number_text(value.y) + ' ' + number_text(value.z);
  } else if constexpr (std::is_same_v<T, std::array<int, 2>> || std::is_same_v<T, std::array<double, 2>>) {
    return number_text(value[0]) + ' ' + number_text(value[1]);
  } else if constexpr (std::is_same_v<T, ColorValue> || std::is_same_v<T, ColorOrTexture>) {
    if (value.rgb.x == value.rgb.y && value.rgb.y == value.rgb.z) return number_text(value.rgb.x);
    return number_text(value.rgb.x) + ' ' + number_text(value.rgb.y) + ' ' + number_text(value.rgb.z);
  } else if constexpr (std::is_enum_v<T>) {
    return std::string(row.words[static_cast<std::size_t>(value)]);
  } else {
    return {};
  }
}

}  // namespace detail

/// A row for a member of the struct that a block's properties are gathered in; its type follows the member's.
template <auto Member>
constexpr PropertyRow property(std::string_view name, std::string_view help) {
  using Pointer = detail::MemberPointer<decltype(Member)>;
  using Input = typename Pointer::Input;
  using Field = typename detail::Unwrap<typename Pointer::Type>::Type;
  PropertyRow row;
  row.name = name;
  row.help = help;
  row.type = detail::property_type<Field>();
  row.store = [](void* input, const Argument& argument) {
    if constexpr (std::is_same_v<Field, std::vector<StopValue>>) {
      (static_cast<Input*>(input)->*Member).push_back(detail::from_argument<StopValue>(argument));
    } else {
      static_cast<Input*>(input)->*Member = detail::from_argument<Field>(argument);
    }
  };
  row.is_repeatable = std::is_same_v<Field, std::vector<StopValue>>;
  if constexpr (std::is_same_v<Field, ColorOrTexture>) {
    row.store_texture = [](void* input, const TexturePointer& texture) {
      (static_cast<Input*>(input)->*Member).texture = texture;
    };
  }
  row.default_value = [](const void* input, const PropertyRow& self) -> std::string {
    const auto& member = static_cast<const Input*>(input)->*Member;
    if constexpr (std::is_same_v<Field, typename Pointer::Type>) return detail::to_text(member, self);
    return {};  // an optional one: nothing unless given
  };
  return row;
}

template <auto Textures, auto Texture>
constexpr PropertyRow PropertyRow::or_texture() const {
  using Input = typename detail::MemberPointer<decltype(Textures)>::Input;
  PropertyRow row = *this;
  row.store_texture = [](void* input, const TexturePointer& texture) {
    static_cast<Input*>(input)->*Textures.*Texture = texture;
  };
  return row;
}

/// A row for a kind of block: `Build` gets the gathered properties once all of them are sound.
template <class Input, void (*Build)(const Input&, BlockContext&)>
KindRow kind(std::string_view name, std::string_view help, std::span<const PropertyRow> properties) {
  KindRow row;
  row.name = name;
  row.help = help;
  row.properties = properties;
  row.build = [](BlockContext& context) {
    Input input;
    if (fill(context, &input)) Build(input, context);
  };
  row.default_of = [](const PropertyRow& property_row) {
    const Input input;
    return property_row.default_value(&input, property_row);
  };
  return row;
}

}  // namespace raytracer::scene_file
