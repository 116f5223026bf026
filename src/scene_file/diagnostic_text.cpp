// How a diagnostic looks: as a compiler prints it, and as JSON.
#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <vector>

#include "raytracer/scene_file.hpp"

namespace raytracer {
namespace {

constexpr std::size_t kWidestLine = 110;  // characters of a source line that a message shows

// Splits UTF-8 into its characters; what is no UTF-8 or would steer a terminal becomes a replacement character.
std::vector<std::string> printable_characters(const std::string& line) {
  static const std::string kReplacement = "\xEF\xBF\xBD";
  std::vector<std::string> characters;
  for (std::size_t i = 0; i < line.size();) {
    const auto lead = static_cast<unsigned char>(line[i]);
    std::size_t length = lead < 0x80 ? 1 : lead >= 0xF0 ? 4 : lead >= 0xE0 ? 3 : lead >= 0xC0 ? 2 : 0;
    bool valid = length > 0 && lead < 0xF8 && i + length <= line.size();
    for (std::size_t k = 1; valid && k < length; ++k) {
      valid = (static_cast<unsigned char>(line[i + k]) & 0xC0U) == 0x80U;
    }
    if (!valid) length = 1;
    const bool steers = (lead < 0x20 && lead != '\t') || lead == 0x7F || (lead == 0xC2 && valid &&
                        static_cast<unsigned char>(line[i + 1]) < 0xA0);
    characters.push_back(valid && !steers ? line.substr(i, length) : kReplacement);
    i += length;
  }
  return characters;
}

// The part of a long line that holds the underlined columns.
struct Window {
  std::size_t first, last;  // characters [first, last)
};

Window window_around(std::size_t column, std::size_t length) {
  if (length <= kWidestLine) return {0, length};
  const std::size_t before = std::min<std::size_t>(column, kWidestLine / 2);
  const std::size_t first = std::min(column - before, length - kWidestLine);
  return {first, std::min(first + kWidestLine, length)};
}

void append_snippet(std::string& out, const Diagnostic& d, std::size_t gutter) {
  const std::vector<std::string> characters = printable_characters(d.source_line);
  const std::size_t column = std::min<std::size_t>(d.column - 1, characters.size());
  const Window window = window_around(column, characters.size());
  out += fmt::format("{:>{}} |\n{:>{}} | ", "", gutter, d.line, gutter);
  if (window.first > 0) out += "…";
  for (std::size_t i = window.first; i < window.last; ++i) out += characters[i];
  if (window.last < characters.size()) out += "…";
  out += fmt::format("\n{:>{}} | ", "", gutter);
  if (window.first > 0) out += ' ';
  // A tab keeps its own width above and below.
  for (std::size_t i = window.first; i < column; ++i) out += characters[i] == "\t" ? '\t' : ' ';
  const std::size_t line_end = std::max(window.last, column + 1);
  const std::size_t end = d.end_line == d.line ? std::min<std::size_t>(d.end_column - 1, line_end) : line_end;
  out.append(std::max<std::size_t>(1, end > column ? end - column : 1), '^');
  if (!d.suggestion.empty()) out += ' ' + d.suggestion;
  out += '\n';
}

void append_message(std::string& out, const Diagnostic& d, const char* label) {
  out += fmt::format("{}: {}\n", label, d.message);
  if (d.line == 0) {
    if (!d.suggestion.empty()) out += fmt::format("  {}\n", d.suggestion);
    return;
  }
  const std::size_t gutter = std::to_string(d.line).size();
  out += fmt::format("{:>{}}--> {}:{}:{}\n", "", gutter, d.file, d.line, d.column);
  append_snippet(out, d, gutter);
}

std::string json_string(const std::string& text) {
  std::string out = "\"";
  for (const std::string& character : printable_characters(text)) {
    if (character == "\"" || character == "\\") out += '\\';
    out += character == "\t" ? "\\t" : character;
  }
  return out + '"';
}

}  // namespace

std::string to_text(const Diagnostic& diagnostic) {
  std::string out;
  append_message(out, diagnostic, diagnostic.severity == Severity::kError ? "error" : "warning");
  for (const Diagnostic& note : diagnostic.notes) append_message(out, note, "note");
  return out;
}

std::string to_json(const Diagnostic& d) {
  std::string out = fmt::format(
      R"({{"file": {}, "line": {}, "column": {}, "end_line": {}, "end_column": {}, "severity": "{}", "message": {}, "suggestion": {})",
      json_string(d.file), d.line, d.column, d.end_line, d.end_column,
      d.severity == Severity::kError ? "error" : "warning", json_string(d.message),
      json_string(d.suggestion));
  if (!d.notes.empty()) {
    out += ", \"notes\": [";
    for (std::size_t i = 0; i < d.notes.size(); ++i) {
      const Diagnostic& n = d.notes[i];
      out += fmt::format(R"({}{{"file": {}, "line": {}, "column": {}, "end_column": {}, "message": {}}})",
                         i > 0 ? ", " : "", json_string(n.file), n.line, n.column, n.end_column,
                         json_string(n.message));
    }
    out += ']';
  }
  return out + '}';
}

}  // namespace raytracer
