# What `cmake --install` puts where: program, library, headers, the package file for find_package(raytracer), and the
# man page and shell completions, which the program writes from its own option table.
include(CMakePackageConfigHelpers)

if(BUILD_SHARED_LIBS)
  set_target_properties(raytracer_library PROPERTIES
    VERSION ${PROJECT_VERSION} SOVERSION ${PROJECT_VERSION_MAJOR}.${PROJECT_VERSION_MINOR})
  set_target_properties(raytracer_program PROPERTIES INSTALL_RPATH "$ORIGIN/../${CMAKE_INSTALL_LIBDIR}")
endif()
install(TARGETS raytracer_program RUNTIME)
install(TARGETS raytracer_library EXPORT raytracerTargets)
install(DIRECTORY include/raytracer DESTINATION ${CMAKE_INSTALL_INCLUDEDIR} FILES_MATCHING PATTERN "*.hpp")
install(FILES LICENSE DESTINATION ${CMAKE_INSTALL_DOCDIR})

set(package_folder ${CMAKE_INSTALL_LIBDIR}/cmake/raytracer)
install(EXPORT raytracerTargets NAMESPACE raytracer:: DESTINATION ${package_folder})
configure_package_config_file(cmake/raytracerConfig.cmake.in raytracerConfig.cmake
  INSTALL_DESTINATION ${package_folder})
write_basic_package_version_file(raytracerConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/raytracerConfig.cmake ${PROJECT_BINARY_DIR}/raytracerConfigVersion.cmake
  DESTINATION ${package_folder})

# install_help(<file> <folder> <words after "raytracer help">...)
function(install_help file folder)
  set(path ${PROJECT_BINARY_DIR}/help/${file})
  add_custom_command(OUTPUT ${path}
    COMMAND ${CMAKE_COMMAND} -E make_directory ${PROJECT_BINARY_DIR}/help
    COMMAND raytracer_program help ${ARGN} > ${path}
    DEPENDS raytracer_program VERBATIM)
  set_property(TARGET raytracer_help APPEND PROPERTY SOURCES ${path})
  install(FILES ${path} DESTINATION ${folder})
endfunction()
add_custom_target(raytracer_help ALL)
install_help(raytracer.1 ${CMAKE_INSTALL_MANDIR}/man1 --man)
install_help(raytracer ${CMAKE_INSTALL_DATADIR}/bash-completion/completions --completions bash)
install_help(_raytracer ${CMAKE_INSTALL_DATADIR}/zsh/site-functions --completions zsh)
install_help(raytracer.fish ${CMAKE_INSTALL_DATADIR}/fish/vendor_completions.d --completions fish)
