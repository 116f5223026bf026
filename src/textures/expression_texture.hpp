// Formulas over a point of a surface, as programs that are run at every hit.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "raytracer/texture.hpp"

namespace raytracer {

/// What a step of a program does. All work on numbers in numbered places; a vector is three places in a row.
/// `to`: where the result goes; `a`, `b`, `c`: where the operands stand.
enum class ExpressionStep : std::uint8_t {
  kCopy,
  kNegate,
  kAdd,
  kSubtract,
  kMultiply,
  kDivide,            ///< by 0: 0
  kRemainder,         ///< with the sign of a; by 0: 0
  kModulo,            ///< with the sign of b; by 0: 0
  kPower,             ///< where that is no number: 0
  kMultiplyAdd,       ///< a * b + c
  kMultiplySubtract,  ///< c - a * b
  kAddVector,
  kSubtractVector,
  kMultiplyVector,
  kScaleVector,  ///< vector a by the number b
  kLess,         ///< comparisons and logic: 1 or 0
  kLessEqual,
  kEqual,
  kAnd,
  kOr,
  kNot,
  kChoose,  ///< b where a is not 0, else c
  kSin,     ///< of degrees, likewise all angles
  kCos,
  kTan,
  kAsin,
  kAcos,
  kAtan2,
  kSqrt,
  kExp,
  kLog,
  kAbs,
  kMin,
  kMax,
  kFloor,
  kCeil,
  kRound,
  kSign,
  kClamp,  ///< a to b..c
  kMix,    ///< from a to b by c
  kSmoothstep,
  kLength,     ///< from here on a and b are vectors
  kNormalize,  ///< of no direction: no direction
  kDot,
  kCross,
  kNoise,
  kRandom,  ///< of b numbers from a on; b is no place but their count
  kCall,    ///< three numbers from a on, to three from `to` on; b is the number of a function
  // What chain() makes of steps: one operand is what the step before has computed, which need not be waited
  // for until it can be read back from its place.
  kAddLast,               ///< last + b
  kSubtractLast,          ///< last - b
  kSubtractFromLast,      ///< a - last
  kMultiplyLast,          ///< last * b
  kMultiplyAddLast,       ///< a * b + last
  kMultiplyLastAdd,       ///< last * b + c
  kMultiplySubtractLast,  ///< last - a * b
};

struct ExpressionInstruction {
  ExpressionStep step = ExpressionStep::kCopy;
  std::uint16_t to = 0, a = 0, b = 0, c = 0;
};

/// Three numbers from three, for what has no step of its own.
using ExpressionFunction = Vector3d (*)(const Vector3d&);

/// The places are numbered: the point's values first, then the constants, then what is computed.
struct ExpressionProgram {
  static constexpr std::uint16_t kPosition = 0, kNormal = 3, kU = 6, kV = 7, kFirstConstant = 8;
  static constexpr std::size_t kMostPlaces = 1024;

  std::vector<double> constants;
  std::vector<ExpressionInstruction> instructions;
  std::vector<ExpressionFunction> functions;
  std::uint16_t places = kFirstConstant;  ///< how many there are
  std::uint16_t result = 0;
  bool is_vector = false;  ///< the result; a number is grey

  /// The result at a point, a number in x. What is not finite is 0.
  Vector3d run(const TexturePoint& point) const;
};

/// Lets steps take what the step before them has computed as it is; the results stay what they are.
void chain(ExpressionProgram& program);

TexturePointer make_expression_texture(ExpressionProgram program);

}  // namespace raytracer
