# Helpers that keep every folder's CMakeLists.txt a list of names.
set(CMAKE_CXX_STANDARD 17)
set(CMAKE_CXX_STANDARD_REQUIRED ON)
set(CMAKE_CXX_EXTENSIONS OFF)
set(CMAKE_EXPORT_COMPILE_COMMANDS ON)
# How to build is the business of whoever stands on top: inside another project it is theirs.
if(PROJECT_IS_TOP_LEVEL)
  if(NOT CMAKE_BUILD_TYPE AND NOT CMAKE_CONFIGURATION_TYPES)
    set(CMAKE_BUILD_TYPE Release CACHE STRING "Debug | Release | RelWithDebInfo" FORCE)
  endif()
  find_program(HEXCAL_CCACHE ccache)
  if(HEXCAL_CCACHE AND NOT CMAKE_CXX_COMPILER_LAUNCHER)
    set(CMAKE_CXX_COMPILER_LAUNCHER ${HEXCAL_CCACHE})
  endif()
endif()

# Warnings are for hexcal's own files, and errors only where hexcal itself is worked on.
function(hexcal_own target)
  target_compile_options(${target} PRIVATE -Wall -Wextra -Wpedantic -Wshadow -Wnon-virtual-dtor
                                           $<$<BOOL:${PROJECT_IS_TOP_LEVEL}>:-Werror>)
  if(HEXCAL_FUZZ)
    target_compile_options(${target} PRIVATE -fsanitize=fuzzer-no-link)
  endif()
  if(HEXCAL_SANITIZE)
    # A block of a matrix without columns is a null pointer and an offset in Eigen 3.4; nothing is
    # read there, and where something were, AddressSanitizer would see it.
    target_compile_options(${target} PRIVATE -fsanitize=${HEXCAL_SANITIZE}
                                             -fno-sanitize=pointer-overflow
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
    target_compile_features(hexcal_${name} PUBLIC cxx_std_17)
    target_include_directories(hexcal_${name} PUBLIC $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}>
        $<INSTALL_INTERFACE:${HEXCAL_HEADERS}>)
    target_link_libraries(hexcal_${name} PUBLIC ${ARG_LINKS} PRIVATE ${ARG_PRIVATE_LINKS})
    hexcal_own(hexcal_${name})
  else()
    add_library(hexcal_${name} INTERFACE)
    target_compile_features(hexcal_${name} INTERFACE cxx_std_17)
    target_include_directories(hexcal_${name} INTERFACE $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}>
        $<INSTALL_INTERFACE:${HEXCAL_HEADERS}>)
    target_link_libraries(hexcal_${name} INTERFACE ${ARG_LINKS})
  endif()
  add_library(hexcal::${name} ALIAS hexcal_${name})
  set_target_properties(hexcal_${name} PROPERTIES EXPORT_NAME ${name})
endfunction()

# hexcal_test(pose_test LINKS hexcal::geometry): tests/pose_test.cc, its cases listed in ctest, with
# the program's name as their label (ctest -L pose_test).
function(hexcal_test name)
  cmake_parse_arguments(ARG "" "" "LINKS" ${ARGN})
  if(ARG_UNPARSED_ARGUMENTS)
    message(FATAL_ERROR "hexcal_test(${name}): what is ${ARG_UNPARSED_ARGUMENTS}?")
  endif()
  add_executable(${name} ${name}.cc $<TARGET_OBJECTS:hexcal_locale_environment>)
  target_link_libraries(${name} PRIVATE ${ARG_LINKS} GTest::gtest GTest::gtest_main)
  target_include_directories(${name} PRIVATE ${PROJECT_SOURCE_DIR} ${PROJECT_SOURCE_DIR}/tests)
  hexcal_own(${name})
  gtest_discover_tests(${name} DISCOVERY_TIMEOUT 60 PROPERTIES TIMEOUT 600 LABELS ${name})
endfunction()
