# What the reports' pages are made of, embedded in the program so that a report is one file.

# hexcal_embed(page.css PageCss out_variable): a source with `std::string_view PageCss()`.
# A file that is not there is embedded as no text. With GLOBAL name, a script that defines
# window.Plotly leaves it as window.name, too.
function(hexcal_embed file function out)
  cmake_parse_arguments(ARG "" "GLOBAL" "" ${ARGN})
  set(HEXCAL_EMBED_FUNCTION ${function})
  set(HEXCAL_EMBED_TEXT "")
  if(EXISTS "${file}")
    file(READ "${file}" HEXCAL_EMBED_TEXT)
    if(ARG_GLOBAL)
      string(APPEND HEXCAL_EMBED_TEXT "\nwindow.${ARG_GLOBAL} = window.Plotly;\n")
    endif()
    set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS "${file}")
  endif()
  # A page ends at the first such tag, wherever it stands.
  string(REGEX MATCH "</[sS][cC][rR][iI][pP][tT]|<!--|\\)hexcal\"" clash "${HEXCAL_EMBED_TEXT}")
  if(clash)
    message(FATAL_ERROR "${file} has ${clash} in it and cannot stand in a page")
  endif()
  set(source "${CMAKE_CURRENT_BINARY_DIR}/${function}.cc")
  configure_file("${PROJECT_SOURCE_DIR}/cmake/embedded_text.cc.in" "${source}" @ONLY)
  # A page is longer than the text that every compiler must take.
  set_source_files_properties("${source}" PROPERTIES COMPILE_OPTIONS -Wno-overlength-strings)
  set(${out} "${source}" PARENT_SCOPE)
endfunction()

# Brings the chart library that report/html/assets/package-lock.json pins, by version and hash, to
# the build folder, and says in which folder its packages are. Without npm or a network there is none, and reports show their tables instead.
function(hexcal_fetch_charts out)
  set(assets "${PROJECT_SOURCE_DIR}/report/html/assets")
  file(SHA256 "${assets}/package-lock.json" lock)
  string(SUBSTRING ${lock} 0 12 lock)
  set(folder "${PROJECT_BINARY_DIR}/charts-${lock}")
  set(${out} "" PARENT_SCOPE)
  set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS "${assets}/package-lock.json")
  if(NOT HEXCAL_CHARTS)
    return()
  endif()
  if(EXISTS "${folder}/complete")
    set(${out} "${folder}/node_modules" PARENT_SCOPE)
    return()
  endif()
  find_program(HEXCAL_NPM npm)
  if(NOT HEXCAL_NPM)
    message(STATUS "Reports: tables in place of pictures, for there is no npm to fetch plotly.js")
    return()
  endif()
  file(COPY "${assets}/package.json" "${assets}/package-lock.json" DESTINATION "${folder}")
  execute_process(
    COMMAND "${HEXCAL_NPM}" ci --ignore-scripts --no-audit --no-fund --prefer-offline
            --fetch-retries=1 --loglevel=error
    WORKING_DIRECTORY "${folder}" TIMEOUT 180
    RESULT_VARIABLE failed OUTPUT_VARIABLE said ERROR_VARIABLE said)
  if(failed)
    message(STATUS "Reports: tables in place of pictures, for npm could not fetch plotly.js:\n${said}")
    return()
  endif()
  file(TOUCH "${folder}/complete")
  set(${out} "${folder}/node_modules" PARENT_SCOPE)
endfunction()
