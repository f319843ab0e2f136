# What an installed hexcal consists of: the program (component `program`), and what others build on
# (component `development`): headers, static libraries, find_package(hexcal), hexcal.pc.
include(GNUInstallDirs)
include(CMakePackageConfigHelpers)

# Included as inside the project, "geometry/pose.h": the folders stay together in one of their own.
set(HEXCAL_HEADERS "${CMAKE_INSTALL_INCLUDEDIR}/hexcal")
# Bottom to top. What stops at the model needs no Ceres.
set(HEXCAL_MODEL_LAYERS config geometry measurement model)
set(HEXCAL_SOLVER_LAYERS residuals estimator discovery report)

# The layers as -l flags: a library stands before those that it uses.
function(hexcal_library_flags result)
  set(flags "")
  foreach(layer ${ARGN})
    string(PREPEND flags "-lhexcal_${layer} ")
  endforeach()
  string(STRIP "${flags}" flags)
  set(${result} "${flags}" PARENT_SCOPE)
endfunction()

function(hexcal_install_development)
  set(package "${CMAKE_INSTALL_LIBDIR}/cmake/hexcal")
  foreach(group Model Solver)
    string(TOUPPER ${group} upper)
    set(targets ${HEXCAL_${upper}_LAYERS})
    list(TRANSFORM targets PREPEND hexcal_)
    install(TARGETS ${targets} EXPORT hexcal${group}
            ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT development)
    install(EXPORT hexcal${group} NAMESPACE hexcal:: DESTINATION ${package}
            COMPONENT development)
  endforeach()
  foreach(layer ${HEXCAL_MODEL_LAYERS} ${HEXCAL_SOLVER_LAYERS})
    install(DIRECTORY ${layer} DESTINATION ${HEXCAL_HEADERS} COMPONENT development
            FILES_MATCHING PATTERN "*.h")
  endforeach()

  list(JOIN HEXCAL_SOLVER_LAYERS "|" HEXCAL_SOLVER_ALTERNATIVES)
  configure_package_config_file(cmake/hexcalConfig.cmake.in hexcalConfig.cmake
                                INSTALL_DESTINATION ${package})
  # Before 1.0 a minor version may break what stands on it.
  write_basic_package_version_file(hexcalConfigVersion.cmake COMPATIBILITY SameMinorVersion)
  install(FILES ${PROJECT_BINARY_DIR}/hexcalConfig.cmake
                ${PROJECT_BINARY_DIR}/hexcalConfigVersion.cmake
          DESTINATION ${package} COMPONENT development)

  hexcal_library_flags(HEXCAL_MODEL_FLAGS ${HEXCAL_MODEL_LAYERS})
  hexcal_library_flags(HEXCAL_SOLVER_FLAGS ${HEXCAL_SOLVER_LAYERS})
  # From where the file lies, so that an installed tree may be moved.
  file(RELATIVE_PATH HEXCAL_PREFIX_FROM_PC "/${CMAKE_INSTALL_LIBDIR}/pkgconfig" "/")
  string(REGEX REPLACE "/$" "" HEXCAL_PREFIX_FROM_PC "${HEXCAL_PREFIX_FROM_PC}")
  foreach(name hexcal hexcal-model)
    configure_file(cmake/${name}.pc.in ${name}.pc @ONLY)
    install(FILES ${PROJECT_BINARY_DIR}/${name}.pc
            DESTINATION ${CMAKE_INSTALL_LIBDIR}/pkgconfig COMPONENT development)
  endforeach()
endfunction()

function(hexcal_install)
  install(TARGETS hexcal RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR} COMPONENT program)
  # What the program itself prints of its commands.
  set(printed "${PROJECT_BINARY_DIR}/printed")
  file(MAKE_DIRECTORY "${printed}")
  add_custom_command(
    OUTPUT "${printed}/hexcal.1.gz" "${printed}/hexcal" "${printed}/_hexcal"
    COMMAND hexcal man > "${printed}/hexcal.1"
    COMMAND gzip -9nf "${printed}/hexcal.1"
    COMMAND hexcal completion bash > "${printed}/hexcal"
    COMMAND hexcal completion zsh > "${printed}/_hexcal"
    DEPENDS hexcal)
  add_custom_target(hexcal_printed ALL DEPENDS "${printed}/hexcal.1.gz")
  install(FILES "${printed}/hexcal.1.gz" DESTINATION ${CMAKE_INSTALL_MANDIR}/man1 COMPONENT program)
  install(FILES "${printed}/hexcal"
    DESTINATION ${CMAKE_INSTALL_DATADIR}/bash-completion/completions COMPONENT program)
  install(FILES "${printed}/_hexcal"
    DESTINATION ${CMAKE_INSTALL_DATADIR}/zsh/site-functions COMPONENT program)
  hexcal_install_development()
endfunction()
