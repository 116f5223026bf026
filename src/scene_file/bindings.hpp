// What names mean: a stack of bindings, the later hiding the earlier, of which a frame shows a part.
#pragma once

#include <cstdint>
#include <vector>

#include "scene_file/names.hpp"
#include "scene_file/source.hpp"

namespace raytracer::scene_file {

/// What a piece of text sees of a stack: everything from `base` up, and below `limit` what the text around it
/// sees. The body of a definition has its parameters from `base`, and does not see what came between its
/// definition and its use.
struct Visibility {
  std::size_t base = 0, limit = 0;
  const Visibility* around = nullptr;

  bool shows(std::size_t position) const {
    for (const Visibility* v = this; v != nullptr; v = v->around) {
      if (position >= v->base) return true;
      if (position >= v->limit) return false;
    }
    return false;
  }
};

template <class T>
class Bindings {
 public:
  struct Entry {
    NameId name = 0;
    T value{};
    Place place;               ///< where the name was given
    std::uint32_t hidden = 0;  ///< the entry of the same name below, plus 1
  };

  std::size_t height() const { return entries_.size(); }

  void push(NameId name, T value, const Place& place) {
    if (name >= latest_.size()) latest_.resize(name + 1, 0);
    entries_.push_back({name, std::move(value), place, latest_[name]});
    latest_[name] = static_cast<std::uint32_t>(entries_.size());
  }

  void pop_to(std::size_t height) {
    while (entries_.size() > height) {
      latest_[entries_.back().name] = entries_.back().hidden;
      entries_.pop_back();
    }
  }

  /// The position of the binding that the frame sees, or npos.
  static constexpr std::size_t npos = static_cast<std::size_t>(-1);
  std::size_t find(NameId name, const Visibility& visibility) const {
    std::uint32_t next = name < latest_.size() ? latest_[name] : 0;
    while (next != 0) {
      if (visibility.shows(next - 1)) return next - 1;
      next = entries_[next - 1].hidden;
    }
    return npos;
  }
  const Entry& at(std::size_t position) const { return entries_[position]; }
  Entry& at(std::size_t position) { return entries_[position]; }

 private:
  std::vector<Entry> entries_;
  std::vector<std::uint32_t> latest_;  // per name, the topmost entry plus 1
};

}  // namespace raytracer::scene_file
