#include "meshes/ply_header.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "meshes/chunks.hpp"
#include "meshes/text.hpp"

namespace raytracer::meshes {
namespace {

struct TypeName {
  std::string_view name;
  PlyType type;
};
constexpr TypeName kTypes[] = {
    {"char", PlyType::kInt8},      {"int8", PlyType::kInt8},       {"uchar", PlyType::kUint8},
    {"uint8", PlyType::kUint8},    {"short", PlyType::kInt16},     {"int16", PlyType::kInt16},
    {"ushort", PlyType::kUint16},  {"uint16", PlyType::kUint16},   {"int", PlyType::kInt32},
    {"int32", PlyType::kInt32},    {"uint", PlyType::kUint32},     {"uint32", PlyType::kUint32},
    {"float", PlyType::kFloat32},  {"float32", PlyType::kFloat32}, {"double", PlyType::kFloat64},
    {"float64", PlyType::kFloat64}};

struct SlotName {
  std::string_view name;
  PlySlot slot;
};
constexpr SlotName kSlotNames[] = {{"x", kX},
                                   {"y", kY},
                                   {"z", kZ},
                                   {"nx", kNormalX},
                                   {"ny", kNormalY},
                                   {"nz", kNormalZ},
                                   {"u", kU},
                                   {"s", kU},
                                   {"texture_u", kU},
                                   {"v", kV},
                                   {"t", kV},
                                   {"texture_v", kV},
                                   {"red", kRed},
                                   {"green", kGreen},
                                   {"blue", kBlue},
                                   {"r", kRed},
                                   {"g", kGreen},
                                   {"b", kBlue},
                                   {"diffuse_red", kRed},
                                   {"diffuse_green", kGreen},
                                   {"diffuse_blue", kBlue}};

class HeaderReader {
 public:
  explicit HeaderReader(std::string_view file) : file_(file), c_(file) {}

  PlyHeader read() {
    if (file_.substr(0, 3) != "ply" || (file_.size() > 3 && !is_blank(file_[3]) && file_[3] != '\n')) {
      throw Failure{c_.at, "a PLY file begins with the line 'ply'"};
    }
    skip_line(c_);
    while (true) {
      if (c_.at == c_.end) throw Failure{c_.at, "the file ends within the header"};
      line_ = c_.at;
      const std::string_view word = next_word();
      if (word == "end_header") break;
      read_line(word);
      skip_line(c_);
    }
    finish_line();
    if (!has_format_) throw Failure{line_, "the header does not say the format"};
    skip_line(c_);
    header_.body = static_cast<std::size_t>(c_.at - file_.data());
    check();
    return std::move(header_);
  }

 private:
  std::string_view next_word() {
    skip_blanks(c_);
    return read_word(c_);
  }

  void finish_line() {
    const std::string_view more = next_word();
    if (!more.empty()) throw Failure{line_, fmt::format("nothing is expected before {}", in_quotes(more))};
  }

  void read_line(std::string_view word) {
    if (word == "format") {
      read_format();
    } else if (word == "element") {
      read_element();
    } else if (word == "property") {
      read_property();
    } else if (std::any_of(word.begin(), word.end(), [](char c) { return c > 0 && c < ' '; })) {
      throw Failure{line_, fmt::format("{} does not belong into a header", in_quotes(word))};
    }
    // Comments, "obj_info", and what some programs write without saying that it is a comment.
  }

  void read_format() {
    const std::string_view word = next_word();
    if (word == "ascii") {
      header_.format = PlyFormat::kAscii;
    } else if (word == "binary_little_endian") {
      header_.format = PlyFormat::kLittleEndian;
    } else if (word == "binary_big_endian") {
      header_.format = PlyFormat::kBigEndian;
    } else {
      throw Failure{line_, fmt::format("the format {} is none of 'ascii', 'binary_little_endian' and "
                                       "'binary_big_endian'",
                                       in_quotes(word))};
    }
    has_format_ = true;
  }

  void read_element() {
    PlyElement element;
    element.name = next_word();
    const std::string_view word = next_word();
    Cursor number(word);
    std::int64_t rows = 0;
    if (!read_integer(number, rows) || number.at != number.end || rows < 0) {
      throw Failure{line_, fmt::format("{} is not a number of elements", in_quotes(word))};
    }
    element.rows = static_cast<std::uint64_t>(rows);
    if (header_.find(element.name) != nullptr) {
      throw Failure{line_, fmt::format("the element {} stands twice in the header", in_quotes(element.name))};
    }
    if (header_.elements.size() == 1000) throw Failure{line_, "the header has more than 1000 elements"};
    finish_line();
    header_.elements.push_back(std::move(element));
  }

  void read_property() {
    if (header_.elements.empty()) throw Failure{line_, "a property stands before any element"};
    PlyProperty property;
    std::string_view type = next_word();
    if (type == "list") {
      property.is_list = true;
      property.count_type = type_of(next_word());
      if (!is_integer(property.count_type)) throw Failure{line_, "a list's length is a whole number"};
      type = next_word();
    }
    property.type = type_of(type);
    property.name = next_word();
    if (property.name.empty()) throw Failure{line_, "the property has no name"};
    finish_line();
    header_.elements.back().properties.push_back(std::move(property));
  }

  PlyType type_of(std::string_view word) const {
    for (const TypeName& known : kTypes) {
      if (known.name == word) return known.type;
    }
    throw Failure{line_, fmt::format("{} is not a type of numbers", in_quotes(word))};
  }

  void check() const {
    const PlyElement* const vertex = header_.find("vertex");
    if (vertex == nullptr) throw Failure{line_, "the header announces no element 'vertex'"};
    if (vertex->rows >= std::numeric_limits<std::uint32_t>::max()) {
      throw Failure{line_, fmt::format("{} vertices are more than can be numbered", vertex->rows)};
    }
    std::vector<int> seen(kSlots, 0);
    for (const PlyProperty& property : vertex->properties) {
      const PlySlot slot = slot_of(property);
      if (slot != kNoSlot && seen[static_cast<std::size_t>(slot)]++ > 0 && slot <= kZ) {
        throw Failure{line_, fmt::format("a vertex has two properties {}", in_quotes(property.name))};
      }
    }
    if (seen[kX] == 0 || seen[kY] == 0 || seen[kZ] == 0) {
      throw Failure{line_, "a vertex has not all of the properties 'x', 'y' and 'z'"};
    }
  }

  std::string_view file_;
  Cursor c_;
  const char* line_ = nullptr;
  bool has_format_ = false;
  PlyHeader header_;
};

}  // namespace

std::size_t size_of(PlyType type) {
  constexpr std::size_t kSizes[] = {1, 1, 2, 2, 4, 4, 4, 8};
  return kSizes[static_cast<std::size_t>(type)];
}

double white_of(PlyType type) {
  constexpr double kWhites[] = {127, 255, 32767, 65535, 2147483647, 4294967295, 1, 1};
  return kWhites[static_cast<std::size_t>(type)];
}

bool PlyElement::has_lists() const {
  return std::any_of(properties.begin(), properties.end(), [](const PlyProperty& p) { return p.is_list; });
}

std::size_t PlyElement::least_row_size() const {
  std::size_t size = 0;
  for (const PlyProperty& property : properties) {
    size += size_of(property.is_list ? property.count_type : property.type);
  }
  return size;
}

int PlyElement::corner_list() const {
  if (name != "face" && name != "tristrips") return -1;
  for (std::size_t i = 0; i < properties.size(); ++i) {
    const PlyProperty& property = properties[i];
    if (property.is_list && is_integer(property.type) &&
        (property.name == "vertex_indices" || property.name == "vertex_index")) {
      return static_cast<int>(i);
    }
  }
  return -1;
}

const PlyElement* PlyHeader::find(std::string_view name) const {
  const auto found =
      std::find_if(elements.begin(), elements.end(), [&](const PlyElement& e) { return e.name == name; });
  return found == elements.end() ? nullptr : &*found;
}

PlySlot slot_of(const PlyProperty& property) {
  if (property.is_list) return kNoSlot;
  for (const SlotName& known : kSlotNames) {
    if (known.name == property.name) return known.slot;
  }
  return kNoSlot;
}

PlyHeader read_ply_header(std::string_view file) { return HeaderReader(file).read(); }

}  // namespace raytracer::meshes
