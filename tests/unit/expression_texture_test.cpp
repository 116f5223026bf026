// Formulas over surfaces: the program says what the evaluator says.
#include "textures/expression_texture.hpp"

#include <cmath>
#include <random>
#include <string>

#include "catch.hpp"
#include "scene_file/expression_compiler.hpp"
#include "scene_file/parser.hpp"

using namespace raytracer;
using namespace raytracer::scene_file;

namespace {

// An expression, and the two ways to compute it.
class Formula {
 public:
  explicit Formula(const std::string& text)
      : source_("formula", "", text),
        evaluator_(names_, Moment{2, 49}, budget_, diagnostics_),
        expression_(parse_lone_expression(source_, names_, arena_, diagnostics_)) {
    names_.id_of("k");
    evaluator_.bindings().push(names_.id_of("k"), {Value::number(3), nullptr, false}, {});
  }

  bool is_parsed() const { return expression_ != nullptr; }

  std::optional<CompiledExpression> compiled() {
    return compile_expression(*expression_, source_, {}, evaluator_, diagnostics_);
  }

  // Nothing where the evaluator says that something is wrong at that point.
  std::optional<Value> evaluated(const TexturePoint& point) {
    auto& bindings = evaluator_.bindings();
    const std::size_t height = bindings.height();
    const auto bind = [&](const char* name, const Value& value) {
      bindings.push(names_.id_of(name), {value, nullptr, false}, {});
    };
    bind("p", Value::of_vector(Vector3d(point.position)));
    bind("n", Value::of_vector(Vector3d(point.normal)));
    bind("u", Value::number(static_cast<double>(point.uv.x)));
    bind("v", Value::number(static_cast<double>(point.uv.y)));
    const Value value = evaluator_.evaluate(*expression_, source_, {});
    bindings.pop_to(height);
    return value.is_known() ? std::optional(value) : std::nullopt;
  }

  std::string first_message() {
    auto messages = diagnostics_.take();
    return messages.empty() ? std::string() : messages[0].message;
  }

 private:
  Names names_;
  Source source_;
  Arena arena_;
  Budget budget_{1'000'000};
  Diagnostics diagnostics_;
  Evaluator evaluator_;
  const Expression* expression_;
};

TexturePoint some_point(std::mt19937& engine) {
  const auto number = [&] { return 4 * static_cast<float>(engine()) * 0x1p-32F - 2; };
  TexturePoint point;
  point.position = {number(), number(), number()};
  point.normal = glm::normalize(Vector3f(number(), number(), number()));
  point.uv = {number(), number()};
  return point;
}

bool is_near(double a, double b) { return std::abs(a - b) <= 1e-9 * (1 + std::abs(a) + std::abs(b)); }

// Random expressions of a number or a vector.
class Writer {
 public:
  explicit Writer(unsigned seed) : engine_(seed) {}

  std::string number(int depth) {
    const auto a = [&] { return number(depth - 1); };
    const auto w = [&] { return vector(depth - 1); };
    if (depth == 0) return pick({"u", "v", "p.x", "n.y", "k", "0.5", "-1.25", "t", "pi"});
    switch (engine_() % 22) {
      case 0:
        return "(" + a() + " + " + a() + ")";
      case 1:
        return "(" + a() + " - " + a() + ")";
      case 2:
        return "(" + a() + " * " + a() + ")";
      case 3:
        return "(" + a() + " / " + a() + ")";
      case 4:
        return "(" + a() + " % " + a() + ")";
      case 5:
        return "(" + a() + " ^ 2)";
      case 6:
        return pick({"sin", "cos", "tan", "exp", "abs", "floor", "ceil", "round", "sign", "sqrt", "log",
                     "asin", "acos"}) +
               "(" + a() + ")";
      case 7:
        return pick({"atan2", "min", "max", "mod", "pow"}) + "(" + a() + ", " + a() + ")";
      case 8:
        return pick({"clamp", "mix", "smoothstep"}) + "(" + a() + ", " + a() + ", " + a() + ")";
      case 9:
        return pick({"length", "noise"}) + "(" + w() + ")";
      case 10:
        return "dot(" + w() + ", " + w() + ")";
      case 11:
        return w() + pick({".x", ".y", ".z"});
      case 12:
        return "random(" + w() + ", " + a() + ")";
      case 13:
        return "noise(" + a() + ")";
      case 14:
        return "(" + boolean(depth - 1) + " ? " + a() + " : " + a() + ")";
      case 15:
        return "(-" + a() + ")";
      case 16:
        return "min(" + a() + ", " + a() + ", " + a() + ")";
      default:
        return "(" + a() + pick({" + ", " * ", " - "}) + a() + ")";
    }
  }

  std::string vector(int depth) {
    const auto a = [&] { return number(depth - 1); };
    const auto w = [&] { return vector(depth - 1); };
    if (depth <= 0) return pick({"p", "n", "(1, 2, 3)", "red"});
    switch (engine_() % 9) {
      case 0:
        return "(" + a() + ", " + a() + ", " + a() + ")";
      case 1:
        return "(" + w() + pick({" + ", " - ", " * ", " / ", " % "}) + w() + ")";
      case 2:
        return "(" + a() + " * " + w() + ")";
      case 3:
        return "(" + w() + pick({" * ", " / "}) + a() + ")";
      case 4:
        return "normalize(" + w() + ")";
      case 5:
        return "cross(" + w() + ", " + w() + ")";
      case 6:
        return pick({"abs", "floor", "sign"}) + "(" + w() + ")";
      case 7:
        return "mix(" + w() + ", " + w() + ", " + a() + ")";
      default:
        return "(" + boolean(depth - 1) + " ? " + w() + " : " + w() + ")";
    }
  }

  std::string boolean(int depth) {
    if (depth <= 0) return pick({"u > 0", "true", "v <= k"});
    switch (engine_() % 4) {
      case 0:
        return "(" + number(depth - 1) + pick({" < ", " <= ", " > ", " >= ", " == ", " != "}) +
               number(depth - 1) + ")";
      case 1:
        return "(" + boolean(depth - 1) + pick({" and ", " or "}) + boolean(depth - 1) + ")";
      case 2:
        return "(not " + boolean(depth - 1) + ")";
      default:
        return "(" + vector(depth - 1) + " == " + vector(depth - 1) + ")";
    }
  }

 private:
  std::string pick(std::initializer_list<const char*> list) { return list.begin()[engine_() % list.size()]; }
  std::mt19937 engine_;
};

}  // namespace

TEST_CASE("a formula's program computes what the evaluator computes", "[textures][expressions]") {
  std::mt19937 engine(7);
  int compared = 0;
  for (unsigned seed = 0; seed < 600; ++seed) {
    Writer writer(seed);
    const std::string text = seed % 2 == 0 ? writer.number(4) : writer.vector(3);
    INFO(text);
    Formula formula(text);
    REQUIRE(formula.is_parsed());
    const auto compiled = formula.compiled();
    if (!compiled) {
      // A constant part of it is no number; else all is well-typed.
      const std::string message = formula.first_message();
      INFO(message);
      CHECK(message.find(" is wanted") == std::string::npos);
      continue;
    }
    for (int i = 0; i < 4; ++i) {
      const TexturePoint point = some_point(engine);
      const auto expected = formula.evaluated(point);
      const Vector3d found = compiled->program.run(point);
      ExpressionProgram chained = compiled->program;
      chain(chained);
      REQUIRE(chained.run(point) == found);
      REQUIRE(std::isfinite(found.x + found.y + found.z));
      if (!expected) continue;
      ++compared;
      for (int c = 0; c < (expected->is_vector() ? 3 : 1); ++c)
        REQUIRE(is_near(found[c], expected->vector[c]));
    }
  }
  CHECK(compared > 500);
}

TEST_CASE("formulas at known points", "[textures][expressions]") {
  TexturePoint point;
  point.position = {1, 2, 3};
  point.normal = {0, 0, 1};
  point.uv = {0.25F, 0.75F};
  const struct {
    const char* text;
    Vector3d value;
  } known[] = {
      {"u + v", {1, 0, 0}},
      {"p", {1, 2, 3}},
      {"p.z * n.z + k", {6, 0, 0}},
      {"(u, v, 0.5)", {0.25, 0.75, 0.5}},
      {"1 / (u - 0.25)", {0, 0, 0}},
      {"sqrt(u - 1)", {0, 0, 0}},
      {"log(u - 0.25)", {0, 0, 0}},
      {"p / (u - 0.25)", {0, 0, 0}},
      {"exp(10000 * u)", {0, 0, 0}},
      {"normalize(p - (1, 2, 3))", {0, 0, 0}},
      {"(u < v and v < 1) ? (1, 0, 0) : (0, 1, 0)", {1, 0, 0}},
      {"u == 0.25 or 1 / 0.5 > 3 ? 1 : 0", {1, 0, 0}},
      {"hsv(120 * u * 4, 1, 1)", {0, 1, 0}},
      {"max(u, v, 0.5)", {0.75, 0, 0}},
  };
  for (const auto& k : known) {
    INFO(k.text);
    Formula formula(k.text);
    const auto compiled = formula.compiled();
    REQUIRE(compiled);
    const Vector3d found = compiled->program.run(point);
    for (int c = 0; c < 3; ++c) CHECK(is_near(found[c], k.value[c]));
  }
}

TEST_CASE("mistakes in a formula are told as the evaluator tells them", "[textures][expressions]") {
  const struct {
    const char* text;
    const char* message;
  } known[] = {
      {"u + p", "'+' between a number and a vector"},
      {"sin(p)", "'sin' takes a number as its first argument, found a vector"},
      {"u.x", "a vector is wanted here, found a number"},
      {"u and true", "true or false is wanted here, found a number"},
      {"p < 1", "a number is wanted here, found a vector"},
      {"u > 0 ? p : 1", "both outcomes must be of one kind, found a vector and a number"},
      {"u > 0", "a number or a vector is wanted here, found true or false"},
      {"u + sqrt(-1)", "'sqrt' of -1: a negative number has no square root"},
      {"u + q", "there is no 'q'"},
      {"dot(p, u)", "'dot' takes a vector as its second argument, found a number"},
  };
  for (const auto& k : known) {
    INFO(k.text);
    Formula formula(k.text);
    REQUIRE(formula.is_parsed());
    CHECK_FALSE(formula.compiled());
    CHECK(formula.first_message() == k.message);
  }
}
