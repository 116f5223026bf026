#include "scene_file/settings.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <sstream>
#include <vector>

#include "core/suggest.hpp"
#include "raytracer/error.hpp"
#include "scene_file/parser.hpp"

namespace raytracer::scene_file {
namespace {

// `1 0 0`, as three numbers stand in a scene, becomes (1, 0, 0); anything else stays as it is.
std::string three_in_parentheses(const std::string& written) {
  if (written.find_first_not_of("0123456789+-.eE ") != std::string::npos) return written;
  std::istringstream words(written);
  std::vector<std::string> parts(std::istream_iterator<std::string>(words), {});
  return parts.size() == 3 ? fmt::format("({})", fmt::join(parts, ", ")) : written;
}

// A value as a person types it: what is no number, colour, vector or quoted string is text.
Value read_value(const std::string& written, Files& files) {
  const bool is_bare_vector =
      written.find(',') != std::string::npos && written.front() != '(' && written.front() != '"';
  const std::string text = is_bare_vector ? fmt::format("({})", written) : three_in_parentheses(written);
  Diagnostics ignored;
  const Source source("--set", "", text);
  Arena arena;
  const Expression* expression = parse_lone_expression(source, files.names(), arena, ignored);
  if (expression == nullptr) return Value::string(files.names().text(files.names().id_of(written)));
  Budget budget(10'000);
  Evaluator evaluator(files.names(), {}, budget, ignored);
  Value value = evaluator.evaluate(*expression, source, {});
  if (!value.is_known() || value.depends_on_time)
    return Value::string(files.names().text(files.names().id_of(written)));
  if (value.type == ValueType::kString) value.text = files.names().text(files.names().id_of(value.text));
  return value;
}

}  // namespace

void apply_settings(std::span<const Setting> settings, Files& files, Builder& builder) {
  for (const Setting& setting : settings) {
    if (setting.value.empty())
      throw Error(ErrorKind::kUsage, fmt::format("--set {}= has no value", setting.name));
    const Value value = read_value(setting.value, files);
    const bool is_text = value.type == ValueType::kString;
    builder.replace_let(files.names().id_of(setting.name), value,
                        is_text ? value.text : files.names().text(files.names().id_of(setting.value)));
  }
}

void check_settings(std::span<const Setting> settings, const Builder& builder) {
  for (const Setting& setting : settings) {
    std::vector<std::string_view> known;
    bool found = false;
    for (const Builder::TopLevelLet& let : builder.top_level_lets()) {
      known.push_back(let.name);
      found = found || let.name == setting.name;
    }
    if (found) continue;
    const std::string_view nearest = nearest_word(setting.name, known);
    throw Error(
        ErrorKind::kUsage,
        fmt::format("the scene has no top-level 'let {}'{}; {}", setting.name,
                    nearest.empty() ? "" : fmt::format(", did you mean '{}'?", nearest),
                    known.empty() ? "it has none" : fmt::format("it has {}", fmt::join(known, ", "))));
  }
}

std::string to_source(const Value& value) {
  switch (value.type) {
    case ValueType::kNumber:
      return fmt::format("{}", value.x());
    case ValueType::kBoolean:
      return value.is_true() ? "true" : "false";
    case ValueType::kVector:
      return fmt::format("({}, {}, {})", value.vector.x, value.vector.y, value.vector.z);
    case ValueType::kColor: {
      const Vector3d bytes = value.vector * 255.0;
      const Vector3d whole = glm::round(bytes);
      if (value.is_display && glm::length(bytes - whole) < 1e-6) {
        return fmt::format("#{:02x}{:02x}{:02x}", static_cast<int>(whole.x), static_cast<int>(whole.y),
                           static_cast<int>(whole.z));
      }
      return fmt::format("({}, {}, {})", value.vector.x, value.vector.y, value.vector.z);
    }
    case ValueType::kString: {
      std::string quoted = "\"";
      for (const char c : value.text) {
        if (c == '"' || c == '\\') quoted += '\\';
        quoted += c;
      }
      return quoted + '"';
    }
    case ValueType::kUnknown:
      break;
  }
  return "?";
}

}  // namespace raytracer::scene_file
