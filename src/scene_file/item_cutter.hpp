// Puts together what the parser, which does not know what a property takes, has cut at the wrong words.
//
// `center x 0 z  radius r` was read as `center x 0`, `z radius`, `r`. Here the words and values between two
// braces are one run again, and are cut by the kind's rows: a property takes as many values as its row says,
// and a word that names a property of the kind begins the next one. What is left in front of a '{' is the
// header of a block.
#pragma once

#include <functional>
#include <span>
#include <vector>

#include "scene_file/schema.hpp"
#include "scene_file/syntax.hpp"

namespace raytracer::scene_file {

class ItemCutter {
 public:
  /// `is_kind` tells whether a word is a kind of block, built in or defined.
  ItemCutter(const KindRow& row, const Source& source, Names& names, Arena& arena,
             std::function<bool(std::string_view)> is_kind)
      : row_(row), source_(source), names_(names), arena_(arena), is_kind_(std::move(is_kind)) {}

  /// Whether any of the items does not fit the kind as it was cut.
  bool is_needed(std::span<const ItemNode> items) const;
  std::span<const ItemNode> cut(std::span<const ItemNode> items);

 private:
  std::string_view text(const ValueNode& value) const { return source_.text(value.span); }
  ValueNode as_word(Span span) const;
  void flush(const BlockNode* body);
  void flush_before(const BlockNode* own_body);
  std::size_t cut_property(std::size_t first, const PropertyRow* row, const BlockNode* body);
  bool is_all_words(std::size_t first) const;
  bool is_header(std::size_t first, const BlockNode* body) const;
  bool takes(const PropertyRow* row, std::size_t first, std::size_t next, const BlockNode* body) const;
  void add_block(std::size_t first, const BlockNode& body);

  const KindRow& row_;
  const Source& source_;
  Names& names_;
  Arena& arena_;
  std::function<bool(std::string_view)> is_kind_;
  std::vector<ValueNode> run_;
  std::vector<ItemNode> items_;
};

}  // namespace raytracer::scene_file
