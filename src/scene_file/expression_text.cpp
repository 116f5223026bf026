#include "scene_file/expression_text.hpp"

#include <fmt/format.h>

#include "scene_file/expression_compiler.hpp"
#include "scene_file/json_text.hpp"
#include "scene_file/settings.hpp"

namespace raytracer::scene_file {
namespace {

class Writer {
 public:
  Writer(const Source& source, const Visibility& visibility, Evaluator& evaluator)
      : source_(source), visibility_(visibility), evaluator_(evaluator) {}

  std::string text(const Expression& e) {
    if (!mentions_point(e, evaluator_, visibility_)) return constant(e);
    const auto argument = [&](std::size_t i) { return text(*e.arguments[i]); };
    switch (e.operation) {
      case Operation::kName:
        return std::string(evaluator_.names().text(e.name));
      case Operation::kVector:
        return fmt::format("({}, {}, {})", argument(0), argument(1), argument(2));
      case Operation::kNegate:
      case Operation::kPlus:
      case Operation::kNot:
        return fmt::format("({}{})", symbol_of(e.operation), argument(0));
      case Operation::kChoose:
        return fmt::format("({} ? {} : {})", argument(0), argument(1), argument(2));
      case Operation::kMember:
        return fmt::format("{}.{}", argument(0), "xyz"[static_cast<int>(e.number)]);
      case Operation::kCall: {
        std::string list;
        for (std::size_t i = 0; i < e.arguments.size(); ++i) list += (i == 0 ? "" : ", ") + argument(i);
        return fmt::format("{}({})", e.function->name, list);
      }
      default:
        return fmt::format("({} {} {})", argument(0), symbol_of(e.operation), argument(1));
    }
  }

 private:
  std::string constant(const Expression& e) {
    const std::string written = to_source(evaluator_.evaluate(e, source_, visibility_));
    return written.starts_with('-') ? fmt::format("({})", written) : written;
  }

  const Source& source_;
  const Visibility& visibility_;
  Evaluator& evaluator_;
};

}  // namespace

std::string expression_json(const Expression& expression, const Source& source, const Visibility& visibility,
                            Evaluator& evaluator) {
  return fmt::format("{{\"expression\": {}}}",
                     json_quoted(Writer(source, visibility, evaluator).text(expression)));
}

}  // namespace raytracer::scene_file
