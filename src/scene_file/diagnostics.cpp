#include "scene_file/diagnostics.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <tuple>
#include <utility>

namespace raytracer::scene_file {
namespace {

bool starts_a_character(char c) { return (static_cast<unsigned char>(c) & 0xC0U) != 0x80U; }

Diagnostic make_diagnostic(Severity severity, const Place& place, std::string message,
                           std::string suggestion) {
  Diagnostic d;
  d.severity = severity;
  d.message = std::move(message);
  d.suggestion = std::move(suggestion);
  d.file = place.source->name();
  const LineColumn begin = place.source->locate(place.span.begin);
  const LineColumn end = place.source->locate(place.span.end);
  d.line = begin.line;
  d.column = begin.column;
  d.end_line = end.line;
  d.end_column = end.column;
  // Lines can be megabytes long: what lies further off is neither shown nor copied.
  constexpr std::uint32_t kReach = 500;  // bytes to either side
  const std::string_view line = place.source->line_at(place.span.begin, kReach);
  d.source_line = std::string(line);
  const char* at = place.source->text().data() + place.span.begin;
  const auto before = std::count_if(line.data(), std::max(line.data(), at), starts_a_character);
  d.source_column = d.column - static_cast<std::uint32_t>(before);
  return d;
}

// The lexer, the parser and the builder find mistakes in three passes; people read a file from the top. Files
// keep the order in which they were first spoken of, and what concerns the scene as a whole comes last.
void sort_by_place(std::vector<Diagnostic>& messages) {
  std::map<std::string, std::size_t> file_order;
  for (const Diagnostic& d : messages) file_order.try_emplace(d.file, file_order.size());
  const auto key = [&](const Diagnostic& d) {
    return std::tuple(d.line == 0, file_order[d.file], d.line, d.column);
  };
  std::ranges::stable_sort(messages,
                           [&](const Diagnostic& a, const Diagnostic& b) { return key(a) < key(b); });
}

}  // namespace

void Diagnostics::error(const Place& place, std::string message, std::string suggestion,
                        const std::vector<Note>& notes) {
  if (muted_) return;
  if (!error_places_.emplace(place.source, place.span.begin, place.span.end).second) {
    ++repeated_;
    return;
  }
  if (++errors_ > kMostErrors) return;
  Diagnostic d = make_diagnostic(Severity::kError, place, std::move(message), std::move(suggestion));
  for (const Note& note : notes) {
    d.notes.push_back(make_diagnostic(Severity::kError, note.place, note.message, {}));
  }
  constexpr std::size_t kMostUses = 4;  // the innermost ones; deeper chains are recursions
  for (std::size_t i = 0; i < std::min(kMostUses, used_from_.size()); ++i) {
    if (used_from_[used_from_.size() - 1 - i].source == nullptr) continue;
    d.notes.push_back(
        make_diagnostic(Severity::kError, used_from_[used_from_.size() - 1 - i], "used from here", {}));
  }
  messages_.push_back(std::move(d));
}

void Diagnostics::warning(const Place& place, std::string message, std::string suggestion) {
  if (!warning_places_.emplace(place.source, place.span.begin, place.span.end).second) return;
  if (++warnings_ > kMostWarnings) return;
  messages_.push_back(make_diagnostic(Severity::kWarning, place, std::move(message), std::move(suggestion)));
}

void Diagnostics::warning(const std::string& file, std::string message, std::string suggestion) {
  Diagnostic d;
  d.severity = Severity::kWarning;
  d.file = file;
  d.message = std::move(message);
  d.suggestion = std::move(suggestion);
  messages_.push_back(std::move(d));
}

std::vector<Diagnostic> Diagnostics::take() {
  sort_by_place(messages_);
  const auto add_rest = [&](Severity severity, std::size_t count, std::string_view what) {
    Diagnostic more;
    more.severity = severity;
    more.file = messages_.back().file;
    more.message = fmt::format("and {} more {}{}", count, what, count == 1 ? "" : "s");
    messages_.push_back(std::move(more));
  };
  if (warnings_ > kMostWarnings) add_rest(Severity::kWarning, warnings_ - kMostWarnings, "warning");
  if (errors_ > kMostErrors) add_rest(Severity::kError, errors_ - kMostErrors, "error");
  return std::exchange(messages_, {});
}

}  // namespace raytracer::scene_file
