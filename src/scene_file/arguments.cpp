#include "scene_file/arguments.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "core/suggest.hpp"

namespace raytracer::scene_file {
namespace {

constexpr std::size_t kMostNumbers = 12;  // of a matrix

std::string did_you_mean(std::string_view word) {
  return word.empty() ? std::string() : fmt::format("did you mean '{}'?", word);
}

class ArgumentReader {
 public:
  ArgumentReader(const PropertyRow& row, const PropertyNode& property, const Source& source,
                 const Visibility& visibility, Evaluator& evaluator, Diagnostics& diagnostics)
      : row_(row),
        property_(property),
        source_(source),
        visibility_(visibility),
        evaluator_(evaluator),
        diagnostics_(diagnostics) {}

  std::optional<Argument> read() {
    for (const ValueNode& value : property_.values) {
      if (value.kind == ValueKind::kBad) return std::nullopt;  // reported where it was read
    }
    if (property_.values.empty()) {
      error(property_.name, fmt::format("'{}' needs {}", row_.name, describe_type(row_)), example());
      return std::nullopt;
    }
    switch (row_.type) {
      case PropertyType::kWord:
        return word();
      case PropertyType::kMaterial:
      case PropertyType::kName:
        return name();
      case PropertyType::kBoolean:
        return single(ValueType::kBoolean);
      case PropertyType::kString:
      case PropertyType::kFile:
        return single(ValueType::kString);
      case PropertyType::kStop:
        return stop();
      case PropertyType::kNumbers:
      case PropertyType::kIndices:
        return list();
      default:
        return numbers();
    }
  }

 private:
  // A number and the value node that it came from.
  struct Component {
    double number;
    const ValueNode* node;
  };

  std::string_view text(const ValueNode& value) const { return source_.text(value.span); }
  std::string example() const { return fmt::format("{} {}", row_.name, example_value(row_)); }
  Span values_from(std::size_t first) const {
    return {property_.values[first].span.begin, property_.values.back().span.end};
  }
  void error(Span span, std::string message, std::string suggestion = {}) {
    diagnostics_.error({&source_, span}, std::move(message), std::move(suggestion));
  }

  void wrong_type(const ValueNode& value, std::string_view what) {
    error(value.span, fmt::format("'{}' takes {}, found {}", row_.name, describe_type(row_), what),
          example());
  }

  // A number and a colour, which goes in front: numbers[3] is where it stands.
  std::optional<Argument> stop() {
    PropertyNode place = property_, color = property_;
    place.values = property_.values.first(1);
    color.values = property_.values.subspan(1);
    PropertyRow number_row = row_, color_row = row_;
    number_row.type = PropertyType::kNumber;
    color_row.type = PropertyType::kColor;
    color_row.range = kAnyNumber;
    if (color.values.empty()) {
      error(property_.name, fmt::format("'{}' needs {}", row_.name, describe_type(row_)), example());
      return std::nullopt;
    }
    const auto at = ArgumentReader(number_row, place, source_, visibility_, evaluator_, diagnostics_).read();
    auto result = ArgumentReader(color_row, color, source_, visibility_, evaluator_, diagnostics_).read();
    if (!at || !result) return std::nullopt;
    result->numbers[3] = at->numbers[0];
    result->depends_on_time = result->depends_on_time || at->depends_on_time;
    return result;
  }

  bool is_spread() const { return row_.type == PropertyType::kSize || row_.type == PropertyType::kColor; }

  // Adds a value's numbers to the components; a vector counts as three where more than one is wanted.
  bool take(const ValueNode& node, const Value& value) {
    const bool fits = value.is_number() || (value.is_vector() && most_numbers(row_.type) > 2);
    if (!fits) {
      const std::string_view kind = describe(value.type);
      if (value.is_boolean() && node.kind == ValueKind::kWord) {
        wrong_type(node, text(node));
        return false;
      }
      wrong_type(node, node.kind == ValueKind::kExpression
                           ? std::string(kind)
                           : fmt::format("{} {}",
                                         kind.starts_with("a ") ? "the" + std::string(kind.substr(1)) : kind,
                                         text(node)));
      return false;
    }
    argument_.is_display = value.is_display && property_.values.size() == 1;
    argument_.depends_on_time = argument_.depends_on_time || value.depends_on_time;
    for (int i = 0; i < (value.is_vector() ? 3 : 1); ++i) {
      if (count_ < components_.size()) components_[count_] = {value.vector[i], &node};
      ++count_;
    }
    return true;
  }

  std::optional<Argument> numbers() {
    for (const ValueNode& node : property_.values) {
      const Value value = evaluator_.evaluate(node, source_, visibility_);
      if (!value.is_known() || !take(node, value)) return std::nullopt;
    }
    if (!check_count()) return std::nullopt;
    bool sound = true;
    for (std::size_t i = 0; i < count_; ++i) {
      sound = check_range(components_[i]) && sound;
      argument_.numbers[i] = components_[i].number;
    }
    if (is_spread() && count_ == 1) argument_.numbers[1] = argument_.numbers[2] = argument_.numbers[0];
    return sound ? std::optional(argument_) : std::nullopt;
  }

  // As numbers(), however many.
  std::optional<Argument> list() {
    argument_.list.reserve(property_.values.size());
    bool sound = true;
    for (const ValueNode& node : property_.values) {
      const Value value = evaluator_.evaluate(node, source_, visibility_);
      count_ = 0;
      if (!value.is_known() || !take(node, value)) return std::nullopt;
      for (std::size_t i = 0; i < count_; ++i) {
        sound = check_range(components_[i]) && sound;
        argument_.list.push_back(components_[i].number);
        if (row_.type == PropertyType::kIndices) argument_.places.push_back(node.span);
      }
    }
    return sound ? std::optional(std::move(argument_)) : std::nullopt;
  }

  bool check_count() {
    const std::size_t most = most_numbers(row_.type);
    if (count_ == most || (is_spread() && count_ == 1)) return true;
    const std::size_t first_extra = count_ > most ? std::min(most, property_.values.size() - 1) : 0;
    error(values_from(first_extra),
          fmt::format("'{}' takes {}, found {}", row_.name, describe_type(row_), count_), example());
    return false;
  }

  bool check_range(const Component& component) {
    const Range& range = row_.range;
    const double x = component.number;
    const ValueNode& node = *component.node;
    const std::string found =
        node.kind == ValueKind::kNumber ? std::string(text(node)) : detail::number_text(x);
    if (x >= range.least && x <= range.most && !(range.above_least && x == range.least)) {
      const bool whole = row_.type == PropertyType::kInteger || row_.type == PropertyType::kPixels ||
                         row_.type == PropertyType::kIndices;
      if (!whole || x == std::floor(x)) return true;
      error(node.span, fmt::format("'{}' takes {}, found {}", row_.name, describe_type(row_), found),
            row_.type == PropertyType::kIndices
                ? example()
                : fmt::format("{} {}", row_.name, std::max(range.least, std::round(x))));
      return false;
    }
    std::string hint;
    if (row_.type == PropertyType::kColor && range.most == 1 && x > 1 && x <= 255) {
      hint = "1 is full strength; 0..255 is written #rrggbb";
    }
    error(node.span, fmt::format("'{}' must be {}, found {}", row_.name, describe_range(range, x), found),
          hint);
    return false;
  }

  bool check_single() {
    if (property_.values.size() == 1) return true;
    error(values_from(1),
          fmt::format("'{}' takes {}, found {} values", row_.name, describe_type(row_),
                      property_.values.size()),
          example());
    return false;
  }

  std::optional<Argument> single(ValueType wanted) {
    const ValueNode& node = property_.values.front();
    const Value value = evaluator_.evaluate(node, source_, visibility_);
    if (!value.is_known()) return std::nullopt;
    if (value.type != wanted) {
      wrong_type(node, describe(value.type));
      return std::nullopt;
    }
    if (!check_single()) return std::nullopt;
    argument_.numbers[0] = value.x();
    argument_.text = value.text;
    argument_.depends_on_time = value.depends_on_time;
    return argument_;
  }

  std::optional<Argument> word() {
    const ValueNode& first = property_.values.front();
    if (first.kind != ValueKind::kWord) {
      wrong_type(first, text(first));
      return std::nullopt;
    }
    if (!check_single()) return std::nullopt;
    const auto found = std::ranges::find(row_.words, text(first));
    if (found == row_.words.end()) {
      error(first.span, fmt::format("'{}' takes {}, found '{}'", row_.name, describe_type(row_), text(first)),
            did_you_mean(nearest_word(text(first), row_.words)));
      return std::nullopt;
    }
    argument_.index = static_cast<std::uint32_t>(found - row_.words.begin());
    return argument_;
  }

  std::optional<Argument> name() {
    const ValueNode& first = property_.values.front();
    if (first.kind != ValueKind::kWord) {
      wrong_type(first, text(first));
      return std::nullopt;
    }
    if (!check_single()) return std::nullopt;
    argument_.text = text(first);
    return argument_;
  }

  const PropertyRow& row_;
  const PropertyNode& property_;
  const Source& source_;
  const Visibility& visibility_;
  Evaluator& evaluator_;
  Diagnostics& diagnostics_;
  Argument argument_;
  std::array<Component, kMostNumbers> components_{};
  std::size_t count_ = 0;
};

}  // namespace

std::size_t most_numbers(PropertyType type) {
  switch (type) {
    case PropertyType::kNumber:
    case PropertyType::kInteger:
      return 1;
    case PropertyType::kPixels:
    case PropertyType::kPair:
      return 2;
    case PropertyType::kVector:
    case PropertyType::kSize:
    case PropertyType::kColor:
      return 3;
    case PropertyType::kAxisAngle:
    case PropertyType::kStop:
      return 4;
    case PropertyType::kMatrix:
      return kMostNumbers;
    case PropertyType::kNumbers:
    case PropertyType::kIndices:
      return std::numeric_limits<std::size_t>::max();
    default:
      return 0;
  }
}

std::optional<Argument> read_argument(const PropertyRow& row, const PropertyNode& property,
                                      const Source& source, const Visibility& visibility,
                                      Evaluator& evaluator, Diagnostics& diagnostics) {
  return ArgumentReader(row, property, source, visibility, evaluator, diagnostics).read();
}

}  // namespace raytracer::scene_file
