// The lines of an OBJ file: statements that may go on behind a backslash.
#pragma once

#include "meshes/text.hpp"

namespace raytracer::meshes {

/// How many characters the hidden line end has that begins here; 0 where none does.
inline std::ptrdiff_t hidden_line_end(const Cursor& c) {
  if (c.at == c.end || *c.at != '\\') return 0;
  if (c.end - c.at > 1 && c.at[1] == '\n') return 2;
  if (c.end - c.at > 2 && c.at[1] == '\r' && c.at[2] == '\n') return 3;
  return 0;
}

/// Over what stands between two words of a statement.
inline void skip_obj_blanks(Cursor& c) {
  while (c.at != c.end) {
    if (is_blank(*c.at)) {
      ++c.at;
    } else if (const std::ptrdiff_t hidden = hidden_line_end(c)) {
      c.at += hidden;
    } else {
      return;
    }
  }
}

/// Whether the line that begins at `line` goes on from the one before; something other than a blank stands
/// before that one's end.
inline bool continues_line(const char* line) {
  return line[-1] == '\n' && (line[-2] == '\\' || (line[-2] == '\r' && line[-3] == '\\'));
}

/// Behind the end of the statement that this is a place of: at its first character or behind it.
inline void skip_statement(Cursor& c) {
  do {
    skip_line(c);
  } while (c.at != c.end && continues_line(c.at));
}

/// To the first word of the next statement; false at the end of the text. Comments are no statements.
inline bool find_statement(Cursor& c) {
  while (true) {
    while (c.at != c.end && (is_blank(*c.at) || *c.at == '\n')) ++c.at;
    if (c.at == c.end) return false;
    if (*c.at != '#') return true;
    skip_line(c);
  }
}

/// The rest of the statement, which may be a name with blanks in it.
inline std::string_view read_rest(Cursor& c) {
  skip_obj_blanks(c);
  const char* const begin = c.at;
  skip_statement(c);
  const char* end = c.at;
  while (end != begin && (is_blank(end[-1]) || end[-1] == '\n')) --end;
  return {begin, static_cast<std::size_t>(end - begin)};
}

}  // namespace raytracer::meshes
