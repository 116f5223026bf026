// Words as small numbers, so that looking a name up compares integers.
#pragma once

#include <cstdint>
#include <deque>
#include <string>
#include <string_view>
#include <unordered_map>

namespace raytracer::scene_file {

using NameId = std::uint32_t;

class Names {
 public:
  NameId id_of(std::string_view name) {
    const auto known = ids_.find(name);
    if (known != ids_.end()) return known->second;
    texts_.emplace_back(name);
    const auto id = static_cast<NameId>(texts_.size() - 1);
    ids_.emplace(texts_.back(), id);
    return id;
  }
  std::string_view text(NameId id) const { return texts_[id]; }
  std::size_t size() const { return texts_.size(); }

 private:
  std::deque<std::string> texts_;  // a deque never moves what it holds
  std::unordered_map<std::string_view, NameId> ids_;
};

}  // namespace raytracer::scene_file
