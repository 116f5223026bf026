#include "scene_file/item_cutter.hpp"

#include <algorithm>

#include "scene_file/arguments.hpp"
#include "scene_file/colors.hpp"

namespace raytracer::scene_file {
namespace {

constexpr std::size_t kMostHeaderWords = 3;  // light spot lamp

}  // namespace

bool ItemCutter::is_needed(std::span<const ItemNode> items) const {
  for (const ItemNode& item : items) {
    const auto* block = std::get_if<const BlockNode*>(&item);
    if (block != nullptr) {  // `center 0 0 z material { … }` was read as a block `z` of the name `material`
      const std::string_view word = source_.text((*block)->kind);
      if (!(*block)->words.empty() && !is_kind_(word) && find_property(row_, word) == nullptr) return true;
    }
    const auto* property = std::get_if<const PropertyNode*>(&item);
    if (property == nullptr || (*property)->is_nameless()) continue;
    if (find_property(row_, source_.text((*property)->name)) == nullptr || (*property)->values.empty())
      return true;
  }
  return false;
}

ValueNode ItemCutter::as_word(Span span) const {
  ValueNode value;
  value.kind = ValueKind::kWord;
  value.span = span;
  value.name = names_.id_of(source_.text(span));
  return value;
}

std::span<const ItemNode> ItemCutter::cut(std::span<const ItemNode> items) {
  for (const ItemNode& item : items) {
    if (const auto* property = std::get_if<const PropertyNode*>(&item)) {
      if ((*property)->is_nameless()) {  // stands in front of all others
        items_.push_back(item);
        continue;
      }
      run_.push_back(as_word((*property)->name));
      run_.insert(run_.end(), (*property)->values.begin(), (*property)->values.end());
      if ((*property)->body != nullptr) flush_before((*property)->body);
    } else if (const auto* block = std::get_if<const BlockNode*>(&item)) {
      run_.push_back(as_word((*block)->kind));
      for (const Span word : (*block)->words) run_.push_back(as_word(word));
      flush(*block);
    } else {
      flush(nullptr);
      items_.push_back(item);
    }
  }
  flush(nullptr);
  return arena_.copy(std::span<const ItemNode>(items_));
}

// Cuts the run that ends here with a property that has a body of its own: `color image "wood.png" { … }`.
void ItemCutter::flush_before(const BlockNode* own_body) {
  flush(nullptr);
  if (items_.empty() || !std::holds_alternative<const PropertyNode*>(items_.back())) return;
  PropertyNode property = *std::get<const PropertyNode*>(items_.back());
  property.body = own_body;
  items_.back() = arena_.make(property);
}

// Cuts the run that ends here, in front of a body or not.
void ItemCutter::flush(const BlockNode* body) {
  std::size_t i = 0;
  while (i < run_.size()) {
    const PropertyRow* row = find_property(row_, text(run_[i]));
    const bool names_material =
        row != nullptr && row->type == PropertyType::kMaterial && row_.has_children && i + 2 == run_.size();
    const bool names_texture = row != nullptr && row->store_texture != nullptr && i + 2 == run_.size() &&
                               run_.back().kind == ValueKind::kWord;
    const bool is_unknown = row == nullptr && is_all_words(i) && run_.size() - i <= kMostHeaderWords;
    if (body != nullptr && (is_unknown || is_header(i, body) || names_material || names_texture)) {
      add_block(i, *body);
      break;
    }
    i = cut_property(i, row, body);
  }
  run_.clear();
}

bool ItemCutter::is_all_words(std::size_t first) const {
  return std::all_of(run_.begin() + static_cast<std::ptrdiff_t>(first), run_.end(),
                     [](const ValueNode& value) { return value.kind == ValueKind::kWord; });
}

// Whether the words from here to the body are the header of a block.
bool ItemCutter::is_header(std::size_t first, const BlockNode* body) const {
  const std::size_t count = run_.size() - first;
  if (body == nullptr || count == 0 || count > kMostHeaderWords) return false;
  if (!is_all_words(first)) return false;
  const std::string_view word = text(run_[first]);
  return count == 1 || (is_kind_(word) && find_property(row_, word) == nullptr);
}

// Whether the value at `next` still belongs to the property that begins at `first`.
bool ItemCutter::takes(const PropertyRow* row, std::size_t first, std::size_t next,
                       const BlockNode* body) const {
  const ValueNode& value = run_[next];
  if (value.kind != ValueKind::kWord) return true;
  if (is_header(next, body)) return false;
  const std::size_t taken = next - first - 1;
  const bool is_property = find_property(row_, text(value)) != nullptr;
  if (taken == 0) {
    // `size size` may well be the let of that name; `radius center 0 1 0` is not.
    const bool has_values = next + 1 < run_.size() && run_[next + 1].kind != ValueKind::kWord;
    return !(is_property && has_values);
  }
  if (is_property || row == nullptr || taken >= most_numbers(row->type)) return false;
  // A colour by its name is whole.
  const ValueNode& before = run_[first + 1];
  const bool is_whole = row->type == PropertyType::kColor &&
                        (before.kind == ValueKind::kColor ||
                         (before.kind == ValueKind::kWord && named_color(text(before)).has_value()));
  return !is_whole;
}

std::size_t ItemCutter::cut_property(std::size_t first, const PropertyRow* row, const BlockNode* body) {
  std::size_t next = first + 1;
  while (next < run_.size() && takes(row, first, next, body)) ++next;
  if (body != nullptr && next == run_.size()) {  // `radius 1 { … }`
    add_block(first, *body);
    return next;
  }
  PropertyNode property;
  property.name = run_[first].span;
  property.name_id = names_.id_of(text(run_[first]));
  property.values = arena_.copy(std::span<const ValueNode>(run_).subspan(first + 1, next - first - 1));
  items_.emplace_back(arena_.make(property));
  return next;
}

void ItemCutter::add_block(std::size_t first, const BlockNode& body) {
  BlockNode block = body;
  block.kind = run_[first].span;
  block.kind_name = names_.id_of(text(run_[first]));
  std::vector<Span> words;
  for (std::size_t i = first + 1; i < run_.size(); ++i) words.push_back(run_[i].span);
  block.words = arena_.copy(std::span<const Span>(words));
  items_.emplace_back(arena_.make(block));
}

}  // namespace raytracer::scene_file
