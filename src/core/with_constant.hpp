// From a value that is the same for a whole loop to a loop of its own for each: compilers make no vector
// instructions of a loop that chooses by it.
#pragma once

#include <type_traits>

namespace raytracer {

/// Calls function(constant) with the one of the constants that `value` equals, as a type; with the last one
/// where none does.
template <auto kFirst, auto... kRest, class Value, class Function>
inline auto with_constant(Value value, const Function& function) {
  if constexpr (sizeof...(kRest) > 0) {
    if (value != kFirst) return with_constant<kRest...>(value, function);
  }
  return function(std::integral_constant<Value, kFirst>());
}

}  // namespace raytracer
