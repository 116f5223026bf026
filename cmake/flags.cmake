# How every target of the project is compiled; never part of what the installed library asks of its users.
add_library(raytracer_flags INTERFACE)
target_compile_options(raytracer_flags INTERFACE
  -Wall -Wextra -Wshadow -Wconversion
  # GCC 12 warns of every "text" + std::string, optimised, without a reason (its bug 105651).
  $<$<AND:$<CXX_COMPILER_ID:GNU>,$<VERSION_LESS:$<CXX_COMPILER_VERSION>,13>>:-Wno-restrict>
  $<$<BOOL:${RAYTRACER_WERROR}>:-Werror>
  $<$<BOOL:${RAYTRACER_NATIVE}>:-march=native>
  # Nobody reads errno after a maths function, and no maths here traps; both keep loops from being vectorised.
  -fno-math-errno -fno-trapping-math
  # A product and a sum are rounded one by one, wherever the compiler puts them: a formula means the same number in a
  # loop over packets as for one ray, and on every processor.
  -ffp-contract=off)
if(RAYTRACER_SANITIZE)
  target_compile_options(raytracer_flags INTERFACE
    -fsanitize=address,undefined -fno-sanitize-recover=undefined -fno-omit-frame-pointer)
  target_link_options(raytracer_flags INTERFACE -fsanitize=address,undefined)
endif()
