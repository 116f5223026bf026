# cmake -D build= -D config= -D project= -D work= -D generator= -D compiler= -D flags= -D version= -P run.cmake
# From nothing each time: a file left over from an older install would hide that the new one lacks it.
set(prefix ${work}/installed)
file(REMOVE_RECURSE ${prefix} ${work}/stranger)

function(run)
  execute_process(COMMAND ${ARGN} RESULT_VARIABLE status OUTPUT_VARIABLE output ERROR_VARIABLE output)
  if(NOT status EQUAL 0)
    string(REPLACE ";" " " command "${ARGN}")
    message(FATAL_ERROR "${command}\ngave ${status}:\n${output}")
  endif()
  set(output "${output}" PARENT_SCOPE)
endfunction()

run(${CMAKE_COMMAND} --install ${build} --config ${config} --prefix ${prefix})

run(${prefix}/bin/raytracer --version)
if(NOT output MATCHES "${version}")
  message(FATAL_ERROR "The installed program says it is ${output} instead of ${version}")
endif()
foreach(file share/man/man1/raytracer.1 share/bash-completion/completions/raytracer
    share/zsh/site-functions/_raytracer share/fish/vendor_completions.d/raytracer.fish)
  file(STRINGS ${prefix}/${file} mention REGEX "raytracer" LIMIT_COUNT 1)
  if(NOT mention)
    message(FATAL_ERROR "${file} does not speak of raytracer")
  endif()
endforeach()

run(${CMAKE_COMMAND} -S ${project} -B ${work}/stranger -G ${generator}
  -D CMAKE_PREFIX_PATH=${prefix} -D CMAKE_CXX_COMPILER=${compiler} -D CMAKE_CXX_FLAGS=${flags}
  -D CMAKE_BUILD_TYPE=${config})
run(${CMAKE_COMMAND} --build ${work}/stranger --config ${config})
run(${CMAKE_COMMAND} --build ${work}/stranger --config ${config} --target run)
