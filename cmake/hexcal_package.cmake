# Debian packages by `cpack` (scripts/package): hexcal, the program, and libhexcal-dev, what others
# build on. Dates come from SOURCE_DATE_EPOCH where it is set, so that a build can be repeated.
set(HEXCAL_CONTACT "hexcal contributors <contributors@hexcal.invalid>" CACHE STRING
    "Who answers for the Debian packages: name <address>")

# Debian's own papers of a package, in its folder of documentation.
function(hexcal_debian_papers component package)
  set(folder "${PROJECT_BINARY_DIR}/debian/${package}")
  string(TIMESTAMP HEXCAL_DATE "%a, %d %b %Y %H:%M:%S +0000" UTC)
  configure_file(cmake/debian/changelog.in "${folder}/changelog" @ONLY)
  configure_file(cmake/debian/copyright "${folder}/copyright" COPYONLY)
  add_custom_command(
    OUTPUT "${folder}/changelog.gz"
    COMMAND gzip -9nkf "${folder}/changelog"
    DEPENDS "${folder}/changelog")
  add_custom_target(hexcal_changelog_${component} ALL DEPENDS "${folder}/changelog.gz")
  install(FILES "${folder}/changelog.gz" "${folder}/copyright"
          DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/${package} COMPONENT ${component})
endfunction()

function(hexcal_package)
  hexcal_debian_papers(program hexcal)
  hexcal_debian_papers(development libhexcal-dev)
  set(CPACK_GENERATOR DEB)
  set(CPACK_PACKAGE_NAME hexcal)
  set(CPACK_PACKAGE_VERSION ${PROJECT_VERSION})
  set(CPACK_PACKAGE_CONTACT "${HEXCAL_CONTACT}")
  set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "${PROJECT_DESCRIPTION}")
  set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
  set(CPACK_STRIP_FILES ON)
  set(CPACK_COMPONENTS_ALL program development)
  set(CPACK_DEB_COMPONENT_INSTALL ON)
  set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
  set(CPACK_DEBIAN_PACKAGE_CONTROL_STRICT_PERMISSION ON)
  set(CPACK_DEBIAN_PACKAGE_SECTION science)

  set(CPACK_DEBIAN_PROGRAM_PACKAGE_NAME hexcal)
  set(CPACK_DEBIAN_PROGRAM_PACKAGE_SHLIBDEPS ON)
  set(CPACK_DEBIAN_PROGRAM_DESCRIPTION "base and tool calibration of hexapods
Finds where a parallel robot stands and where its tool is from what an optical
tracker saw of them, with the covariance of all 12 parameters, and names what
the model of the robot still misses.")

  set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_NAME libhexcal-dev)
  set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_SECTION libdevel)
  set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_DEPENDS
      "libboost-dev, libceres-dev, libeigen3-dev, libfmt-dev, libgflags-dev, libgoogle-glog-dev, libsqlite3-dev, libssl-dev, libyaml-cpp-dev, nlohmann-json3-dev")
  set(CPACK_DEBIAN_DEVELOPMENT_DESCRIPTION "base and tool calibration of hexapods (development files)
Headers, static libraries, a CMake package and files for pkg-config, which
others need to build on hexcal.")
  include(CPack)
endfunction()
