// How a diagnostic looks: as a compiler prints it, and as JSON.
#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <vector>

#include "core/printable.hpp"
#include "raytracer/scene_file.hpp"

namespace raytracer {
namespace {

constexpr std::size_t kWidestLine = 110;  // characters of a source line that a message shows

// A word of a scene may be as long as the scene; a message about it is not.
std::string message_text(const std::string& text) {
  constexpr std::size_t kLongestMessage = 400;
  return shortened(text, kLongestMessage);
}

// The same for a terminal: on one line, and nothing in it that steers.
std::string one_line(const std::string& text) {
  std::string out;
  for (const std::string& character : printable_characters(message_text(text))) out += character;
  return out;
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
  // The first character of source_line need not be the line's first.
  const std::size_t column = std::min<std::size_t>(d.column - d.source_column, characters.size());
  const Window window = window_around(column, characters.size());
  out += fmt::format("{:>{}} |\n{:>{}} | ", "", gutter, d.line, gutter);
  const bool is_cut = window.first > 0 || d.source_column > 1;
  if (is_cut) out += "…";
  for (std::size_t i = window.first; i < window.last; ++i) out += characters[i];
  if (window.last < characters.size()) out += "…";
  out += fmt::format("\n{:>{}} | ", "", gutter);
  if (is_cut) out += ' ';
  // A tab keeps its own width above and below.
  for (std::size_t i = window.first; i < column; ++i) out += characters[i] == "\t" ? '\t' : ' ';
  const std::size_t line_end = std::max(window.last, column + 1);
  const std::size_t end =
      d.end_line == d.line ? std::min<std::size_t>(d.end_column - d.source_column, line_end) : line_end;
  out.append(std::max<std::size_t>(1, end > column ? end - column : 1), '^');
  if (!d.suggestion.empty()) out += ' ' + one_line(d.suggestion);
  out += '\n';
}

void append_message(std::string& out, const Diagnostic& d, const char* label) {
  out += fmt::format("{}: {}\n", label, one_line(d.message));
  if (d.line == 0) {
    if (!d.suggestion.empty()) out += fmt::format("  {}\n", one_line(d.suggestion));
    return;
  }
  const std::size_t gutter = std::to_string(d.line).size();
  out += fmt::format("{:>{}}--> {}:{}:{}\n", "", gutter, one_line(d.file), d.line, d.column);
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
      d.severity == Severity::kError ? "error" : "warning", json_string(message_text(d.message)),
      json_string(message_text(d.suggestion)));
  if (!d.notes.empty()) {
    out += ", \"notes\": [";
    for (std::size_t i = 0; i < d.notes.size(); ++i) {
      const Diagnostic& n = d.notes[i];
      out += fmt::format(R"({}{{"file": {}, "line": {}, "column": {}, "end_column": {}, "message": {}}})",
                         i > 0 ? ", " : "", json_string(n.file), n.line, n.column, n.end_column,
                         json_string(message_text(n.message)));
    }
    out += ']';
  }
  return out + '}';
}

}  // namespace raytracer
