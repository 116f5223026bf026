#include "scene_file/arguments.hpp"

#include <fmt/format.h>

#include <cmath>
#include <vector>

#include "core/suggest.hpp"
#include "scene_file/colors.hpp"
#include "scene_file/lexer.hpp"

namespace raytracer::scene_file {
namespace {

std::string did_you_mean(std::string_view word) {
  return word.empty() ? std::string() : fmt::format("did you mean '{}'?", word);
}

class ArgumentReader {
 public:
  ArgumentReader(const PropertyRow& row, const PropertyNode& property, const Source& source,
                 Diagnostics& diagnostics)
      : row_(row), property_(property), source_(source), diagnostics_(diagnostics) {}

  std::optional<Argument> read() {
    for (const ValueNode& value : property_.values) {
      if (value.kind == ValueKind::kBad) return std::nullopt;  // reported where it was read
    }
    if (property_.values.empty()) {
      error(property_.name, fmt::format("'{}' needs {}", row_.name, describe_type(row_)), example());
      return std::nullopt;
    }
    switch (row_.type) {
      case PropertyType::kNumber:
      case PropertyType::kInteger: return numbers({1});
      case PropertyType::kPixels: return numbers({2});
      case PropertyType::kVector: return numbers({3});
      case PropertyType::kSize: return spread(numbers({1, 3}));
      case PropertyType::kAxisAngle: return numbers({4});
      case PropertyType::kMatrix: return numbers({12});
      case PropertyType::kColor: return color();
      case PropertyType::kBoolean: return word_of(kBooleans);
      case PropertyType::kWord: return word_of(row_.words);
      case PropertyType::kMaterial: return name();
      case PropertyType::kString: return string();
    }
    return std::nullopt;
  }

 private:
  static constexpr std::string_view kBooleans[] = {"false", "true"};

  std::string_view text(const ValueNode& value) const { return source_.text(value.span); }
  std::string example() const { return fmt::format("{} {}", row_.name, example_value(row_)); }
  Span all_values() const { return {property_.values.front().span.begin, property_.values.back().span.end}; }
  void error(Span span, std::string message, std::string suggestion = {}) {
    diagnostics_.error({&source_, span}, std::move(message), std::move(suggestion));
  }

  void wrong_type(const ValueNode& value) {
    const std::string_view what = value.kind == ValueKind::kString  ? "the string "
                                  : value.kind == ValueKind::kColor ? "the colour "
                                                                    : "";
    const std::string_view quote = value.kind == ValueKind::kWord ? "'" : "";
    error(value.span,
          fmt::format("'{}' takes {}, found {}{}{}{}", row_.name, describe_type(row_), what, quote, text(value),
                      quote),
          example());
  }

  bool check_count(std::size_t wanted) {
    const std::span<const ValueNode> values = property_.values;
    if (values.size() == wanted) return true;
    const bool too_many = values.size() > wanted;
    error(too_many ? Span{values[wanted].span.begin, values.back().span.end} : all_values(),
          fmt::format("'{}' takes {}, found {}", row_.name, describe_type(row_), values.size()), example());
    return false;
  }

  bool check_range(const ValueNode& value) {
    const Range& range = row_.range;
    const double x = value.number;
    if (x >= range.least && x <= range.most && !(range.above_least && x == range.least)) {
      const bool whole = row_.type == PropertyType::kInteger || row_.type == PropertyType::kPixels;
      if (!whole || x == std::floor(x)) return true;
      error(value.span, fmt::format("'{}' takes {}, found {}", row_.name, describe_type(row_), text(value)),
            fmt::format("{} {}", row_.name, std::max(range.least, std::round(x))));
      return false;
    }
    std::string hint;
    if (row_.type == PropertyType::kColor && range.most == 1 && x > 1 && x <= 255) {
      hint = "1 is full strength; 0..255 is written #rrggbb";
    }
    error(value.span, fmt::format("'{}' must be {}, found {}", row_.name, describe_range(range), text(value)),
          hint);
    return false;
  }

  std::optional<Argument> numbers(std::initializer_list<std::size_t> counts) {
    const std::span<const ValueNode> values = property_.values;
    for (const ValueNode& value : values) {
      if (value.kind == ValueKind::kNumber) continue;
      wrong_type(value);
      return std::nullopt;
    }
    std::size_t wanted = *(counts.end() - 1);
    for (const std::size_t count : counts) wanted = values.size() == count ? count : wanted;
    if (!check_count(wanted)) return std::nullopt;
    Argument argument;
    bool sound = true;
    for (std::size_t i = 0; i < values.size(); ++i) {
      sound = check_range(values[i]) && sound;
      argument.numbers[i] = values[i].number;
    }
    return sound ? std::optional(argument) : std::nullopt;
  }

  // One number stands for three.
  std::optional<Argument> spread(std::optional<Argument> argument) const {
    if (argument && property_.values.size() == 1) {
      argument->numbers[1] = argument->numbers[2] = argument->numbers[0];
    }
    return argument;
  }

  std::optional<Argument> color() {
    const ValueNode& first = property_.values.front();
    if (first.kind == ValueKind::kNumber) return spread(numbers({1, 3}));
    if (first.kind == ValueKind::kString) {
      wrong_type(first);
      return std::nullopt;
    }
    if (property_.values.size() > 1) {
      error({property_.values[1].span.begin, property_.values.back().span.end},
            fmt::format("'{}' takes one colour", row_.name), example());
      return std::nullopt;
    }
    const std::optional<Vector3d> rgb =
        first.kind == ValueKind::kColor ? hexadecimal_color(text(first))
                                                                        : named_color(text(first));
    if (!rgb) {
      error(first.span, fmt::format("there is no colour '{}'", text(first)),
            did_you_mean(nearest_word(text(first), color_names())));
      return std::nullopt;
    }
    Argument argument;
    argument.numbers = {rgb->x, rgb->y, rgb->z};
    return argument;
  }

  std::optional<Argument> word_of(std::span<const std::string_view> words) {
    const ValueNode& first = property_.values.front();
    if (first.kind != ValueKind::kWord) {
      wrong_type(first);
      return std::nullopt;
    }
    if (!check_count(1)) return std::nullopt;
    for (std::size_t i = 0; i < words.size(); ++i) {
      if (words[i] != text(first)) continue;
      Argument argument;
      argument.index = static_cast<std::uint32_t>(i);
      argument.numbers[0] = static_cast<double>(i);
      return argument;
    }
    error(first.span, fmt::format("'{}' takes {}, found '{}'", row_.name, describe_type(row_), text(first)),
          did_you_mean(nearest_word(text(first), words)));
    return std::nullopt;
  }

  std::optional<Argument> name() {
    const ValueNode& first = property_.values.front();
    if (first.kind != ValueKind::kWord) {
      wrong_type(first);
      return std::nullopt;
    }
    if (!check_count(1)) return std::nullopt;
    Argument argument;
    argument.text = text(first);
    return argument;
  }

  std::optional<Argument> string() {
    const ValueNode& first = property_.values.front();
    if (first.kind != ValueKind::kString) {
      wrong_type(first);
      return std::nullopt;
    }
    if (!check_count(1)) return std::nullopt;
    Argument argument;
    argument.text = unquote(text(first));
    return argument;
  }

  const PropertyRow& row_;
  const PropertyNode& property_;
  const Source& source_;
  Diagnostics& diagnostics_;
};

}  // namespace

std::optional<Argument> read_argument(const PropertyRow& row, const PropertyNode& property, const Source& source,
                                      Diagnostics& diagnostics) {
  return ArgumentReader(row, property, source, diagnostics).read();
}

}  // namespace raytracer::scene_file
