# What the project stands on; docs/architecture.md says why. The installed package file repeats only the names.
set(THREADS_PREFER_PTHREAD_FLAG ON)
find_package(Threads REQUIRED)
find_package(ZLIB REQUIRED)
find_package(PNG REQUIRED)
find_package(JPEG REQUIRED)
find_package(OpenEXR CONFIG REQUIRED)
find_package(TBB REQUIRED)
find_package(fmt REQUIRED)
find_package(CLI11 REQUIRED)
find_package(glm REQUIRED)
if(NOT TARGET glm::glm)  # Debian 12's glm names its target otherwise
  add_library(glm::glm INTERFACE IMPORTED)
  target_include_directories(glm::glm INTERFACE ${GLM_INCLUDE_DIRS})
endif()

# Embree 4 where it is, else Embree 3; src/scene/embree.hpp evens out the difference.
find_package(embree 4 QUIET)
if(NOT embree_FOUND)
  find_package(embree 3 REQUIRED)
endif()
