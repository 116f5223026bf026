// What the parser makes of a text: inert nodes that remember their places. They exist once per source text
// and are never changed.
#pragma once

#include <algorithm>
#include <cstdint>
#include <memory>
#include <memory_resource>
#include <span>
#include <type_traits>
#include <variant>
#include <vector>

#include "scene_file/names.hpp"
#include "scene_file/source.hpp"

namespace raytracer::scene_file {

struct FunctionRow;

enum class Operation : std::uint8_t {
  kUnknown,  ///< stands for text that could not be read, which has been reported
  kNumber,
  kString,
  kColor,
  kName,
  kVector,  ///< three arguments
  kNegate,
  kPlus,
  kNot,
  kAdd,
  kSubtract,
  kMultiply,
  kDivide,
  kRemainder,
  kPower,
  kLess,
  kLessEqual,
  kGreater,
  kGreaterEqual,
  kEqual,
  kNotEqual,
  kAnd,
  kOr,
  kChoose,  ///< condition, value if true, value if not
  kMember,  ///< `.x`; the component's index is in `number`
  kCall,
};

/// A node of an expression.
struct Expression {
  Operation operation = Operation::kUnknown;
  Span span;                              ///< for messages; with the parentheses around it
  Span token;                             ///< of a kName, kString or kColor: itself, without parentheses
  double number = 0;                      ///< of a kNumber
  NameId name = 0;                        ///< of a kName
  const FunctionRow* function = nullptr;  ///< of a kCall
  std::span<const Expression* const> arguments;
};

enum class ValueKind : std::uint8_t { kNumber, kString, kColor, kWord, kExpression, kBad };

/// One value as it was written.
struct ValueNode {
  Span span;
  double number = 0;                       ///< of a kNumber
  const Expression* expression = nullptr;  ///< of a kExpression
  NameId name = 0;                         ///< of a kWord; of a kString that is decoded its text
  ValueKind kind = ValueKind::kBad;
  bool is_decoded = false;  ///< of a kString: the source's text is not as it stands between its quotes
};

struct BlockNode;

/// `radius 0.5`, `color image "wood.png" { … }`
struct PropertyNode {
  Span name;
  NameId name_id = 0;
  std::span<const ValueNode> values;
  const BlockNode* body = nullptr;  ///< what stands in braces behind the values

  /// The name of a file without a word in front of it, as in `image "wood.png"`: the value is its own name.
  bool is_nameless() const { return !values.empty() && values.front().span.begin == name.begin; }
  Span whole() const { return {name.begin, values.empty() ? name.end : values.back().span.end}; }
};

/// `include "file"`
struct IncludeNode {
  Span keyword;
  ValueNode file;
};

struct LetNode;
struct ForNode;
struct IfNode;
struct DefineNode;

using ItemNode = std::variant<const PropertyNode*, const BlockNode*, const IncludeNode*, const LetNode*,
                              const ForNode*, const IfNode*, const DefineNode*>;

/// `let n = 12`
struct LetNode {
  Span name_span;
  NameId name = 0;
  const Expression* value = nullptr;
};

/// `for i from 0 to n - 1 step 2 { … }`
struct ForNode {
  Span keyword, name_span;
  NameId name = 0;
  const Expression *from = nullptr, *to = nullptr, *step = nullptr;  ///< `step` may be null: 1
  std::span<const ItemNode> items;
};

/// `if t > 2 { … } else { … }`
struct IfNode {
  Span keyword;
  const Expression* condition = nullptr;
  std::span<const ItemNode> items, else_items;
};

/// One of a definition's parameters with its default.
struct ParameterNode {
  Span name_span;
  NameId name = 0;
  std::span<const ValueNode> values;
};

/// `define snowman (size 1, hat black) { … }`
struct DefineNode {
  Span keyword, name_span;
  NameId name = 0;
  std::span<const ParameterNode> parameters;
  std::span<const ItemNode> items;
};

/// `light spot lamp { … }`: a kind, up to two words behind it, and what stands between the braces.
struct BlockNode {
  Span kind;
  NameId kind_name = 0;
  std::span<const Span> words;
  std::span<const ItemNode> items;
  std::uint32_t end = 0;  ///< behind the closing brace
  bool is_exact = false;  ///< its items need no knowledge of the kind to be told apart (JSON)
  bool is_closed = true;  ///< false where the text ended first, which has been reported

  /// In JSON the words may stand in front of the kind.
  Span header() const {
    Span all = kind;
    for (const Span& word : words) all = {std::min(all.begin, word.begin), std::max(all.end, word.end)};
    return all;
  }
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
