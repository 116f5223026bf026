// What the parser makes of a text: inert nodes that remember their places. They exist once per source text and
// are never changed.
#pragma once

#include <algorithm>
#include <cstdint>
#include <memory>
#include <memory_resource>
#include <span>
#include <type_traits>
#include <variant>
#include <vector>

#include "scene_file/source.hpp"

namespace raytracer::scene_file {

enum class ValueKind : std::uint8_t { kNumber, kString, kColor, kWord, kBad };

/// One value as it was written.
struct ValueNode {
  ValueKind kind = ValueKind::kBad;
  Span span;
  double number = 0;  ///< of a kNumber
};

/// `radius 0.5`
struct PropertyNode {
  Span name;
  std::span<const ValueNode> values;

  Span whole() const { return {name.begin, values.empty() ? name.end : values.back().span.end}; }
};

struct BlockNode;

/// `include "file"`
struct IncludeNode {
  Span keyword;
  ValueNode file;
};

using ItemNode = std::variant<const PropertyNode*, const BlockNode*, const IncludeNode*>;

/// `light spot lamp { … }`: a kind, up to two words behind it, and what stands between the braces.
struct BlockNode {
  Span kind;
  std::span<const Span> words;
  std::span<const ItemNode> items;
  std::uint32_t end = 0;  ///< behind the closing brace

  Span header() const { return {kind.begin, words.empty() ? kind.end : words.back().end}; }
};

/// Memory for nodes: handed out piece by piece, given back all at once. Nodes need no destructor.
class Arena {
 public:
  template <class T>
  const T* make(const T& value) {
    static_assert(std::is_trivially_destructible_v<T>);
    return new (memory_.allocate(sizeof(T), alignof(T))) T(value);
  }
  template <class T>
  std::span<const T> copy(std::span<const T> values) {
    static_assert(std::is_trivially_destructible_v<T>);
    if (values.empty()) return {};
    T* first = static_cast<T*>(memory_.allocate(values.size_bytes(), alignof(T)));
    std::uninitialized_copy(values.begin(), values.end(), first);
    return {first, values.size()};
  }

 private:
  std::pmr::monotonic_buffer_resource memory_{4096};
};

/// A whole source, parsed.
struct SyntaxTree {
  const Source* source = nullptr;
  std::span<const ItemNode> items;
  std::vector<Span> comments;
  Arena arena;
};

}  // namespace raytracer::scene_file
