// Text with places: what every later stage points back into.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace raytracer::scene_file {

/// Bytes [begin, end) of a source.
struct Span {
  std::uint32_t begin = 0, end = 0;
};

/// A line and a column, both from 1; the column counts characters (code points).
struct LineColumn {
  std::uint32_t line = 1, column = 1;
};

/// One text file, or standard input, held whole.
class Source {
 public:
  /// `name` is how messages call it, `path` its canonical path (empty for text without a file).
  Source(std::string name, std::string path, std::string text);

  const std::string& name() const { return name_; }
  const std::string& path() const { return path_; }
  std::string_view text() const { return text_; }
  std::string_view text(Span span) const {
    return std::string_view(text_).substr(span.begin, span.end - span.begin);
  }

  LineColumn locate(std::uint32_t offset) const;
  /// The line that holds `offset`, without its line end; of a long one the characters that lie within `reach`
  /// bytes of it.
  std::string_view line_at(std::uint32_t offset, std::uint32_t reach = UINT32_MAX) const;

 private:
  std::string name_, path_, text_;
  mutable std::vector<std::uint32_t> line_starts_;  // filled by the first message
};

/// Where something was said: a span of a source. The source outlives every Place.
struct Place {
  const Source* source = nullptr;
  Span span;

  std::string_view text() const { return source->text(span); }
};

}  // namespace raytracer::scene_file
