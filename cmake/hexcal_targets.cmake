# Helpers that keep every folder's CMakeLists.txt a list of names.
set(CMAKE_CXX_STANDARD 17)
set(CMAKE_CXX_STANDARD_REQUIRED ON)
set(CMAKE_CXX_EXTENSIONS OFF)
set(CMAKE_EXPORT_COMPILE_COMMANDS ON)
if(NOT CMAKE_BUILD_TYPE AND NOT CMAKE_CONFIGURATION_TYPES)
  set(CMAKE_BUILD_TYPE Release CACHE STRING "Debug | Release | RelWithDebInfo" FORCE)
endif()
find_program(HEXCAL_CCACHE ccache)
if(HEXCAL_CCACHE AND NOT CMAKE_CXX_COMPILER_LAUNCHER)
  set(CMAKE_CXX_COMPILER_LAUNCHER ${HEXCAL_CCACHE})
endif()

# Warnings are errors for hexcal's own files only; users of the library do not inherit them.
function(hexcal_own target)
  target_compile_options(${target} PRIVATE -Wall -Wextra -Wpedantic -Wshadow -Wnon-virtual-dtor
                                           -Werror)
  if(HEXCAL_SANITIZE)
    target_compile_options(${target} PRIVATE -fsanitize=${HEXCAL_SANITIZE}
                                             -fno-sanitize-recover=all -fno-omit-frame-pointer)
    target_link_options(${target} PRIVATE -fsanitize=${HEXCAL_SANITIZE})
  endif()
endfunction()

# hexcal_library(estimator SOURCES a.cc b.cc LINKS hexcal::residuals)
# LINKS are public; PRIVATE_LINKS are seen by the sources alone.
function(hexcal_library name)
  cmake_parse_arguments(ARG "" "" "SOURCES;LINKS;PRIVATE_LINKS" ${ARGN})
  if(ARG_SOURCES)
    add_library(hexcal_${name} STATIC ${ARG_SOURCES})
    target_include_directories(hexcal_${name} PUBLIC $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}>)
    target_link_libraries(hexcal_${name} PUBLIC ${ARG_LINKS} PRIVATE ${ARG_PRIVATE_LINKS})
    hexcal_own(hexcal_${name})
  else()
    add_library(hexcal_${name} INTERFACE)
    target_include_directories(hexcal_${name} INTERFACE $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}>)
    target_link_libraries(hexcal_${name} INTERFACE ${ARG_LINKS})
  endif()
  add_library(hexcal::${name} ALIAS hexcal_${name})
endfunction()

# hexcal_test(pose_test LINKS hexcal::geometry): tests/pose_test.cc, its cases listed in ctest.
function(hexcal_test name)
  cmake_parse_arguments(ARG "" "" "SOURCES;LINKS" ${ARGN})
  add_executable(${name} ${name}.cc ${ARG_SOURCES})
  target_link_libraries(${name} PRIVATE ${ARG_LINKS} GTest::gtest GTest::gtest_main)
  hexcal_own(${name})
  gtest_discover_tests(${name} DISCOVERY_TIMEOUT 60 PROPERTIES TIMEOUT 600)
endfunction()
