// JSON (RFC 8259) to values that remember their places. Strict: what the standard does not allow is an error.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>

#include "scene_file/diagnostics.hpp"
#include "scene_file/syntax.hpp"

namespace raytracer::scene_file {

enum class JsonType : std::uint8_t {
  kNull,
  kTrue,
  kFalse,
  kNumber,
  kString,
  kArray,
  kObject,
  kBad,  ///< already reported; stands for a value that nobody knows
};

struct JsonMember;

struct JsonValue {
  JsonType type = JsonType::kNull;
  Span span;                            ///< with quotes, brackets or braces
  double number = 0;                    ///< of a kNumber
  std::span<const JsonValue> elements;  ///< of a kArray
  std::span<const JsonMember> members;  ///< of a kObject, in the order written; no two have the same key

  /// Of a kString: what is between the quotes, escapes as written.
  Span inside() const { return {span.begin + 1, span.end - 1}; }
};

struct JsonMember {
  JsonValue key;  ///< a kString
  JsonValue value;
};

/// Parses a source that holds one value, nested about twice as deep as blocks may be; null where it does not,
/// and the first mistake has been reported. A mistake that leaves no doubt of where the text goes on is
/// reported without ending it.
const JsonValue* parse_json(const Source& source, Arena& arena, Diagnostics& diagnostics);

/// The text of a string, its escapes resolved. `inside` stands between the quotes and is well-formed.
std::string json_unescape(std::string_view inside);

/// The text as a string with its quotes.
std::string json_quoted(std::string_view text);

}  // namespace raytracer::scene_file
