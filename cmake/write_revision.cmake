# cmake -DSOURCE=... -DOUT=... -P write_revision.cmake: writes a source with the commit that is
# built, only where it changed, so that nothing else is compiled again. Without git, or from a
# tarball (also one that was unpacked within another repository), it is "unknown".
set(revision "unknown")
find_program(git git)
if(git AND EXISTS "${SOURCE}/.git")
  execute_process(COMMAND "${git}" rev-parse --short=12 HEAD WORKING_DIRECTORY "${SOURCE}"
                  RESULT_VARIABLE failed OUTPUT_VARIABLE head ERROR_QUIET
                  OUTPUT_STRIP_TRAILING_WHITESPACE)
  if(NOT failed)
    set(revision "${head}")
    execute_process(COMMAND "${git}" --no-optional-locks diff-index --quiet HEAD --
                    WORKING_DIRECTORY "${SOURCE}" RESULT_VARIABLE changed ERROR_QUIET)
    if(changed)
      string(APPEND revision " with changes")
    endif()
  endif()
endif()
set(text "// Written by cmake/write_revision.cmake.
#include \"apps/version.h\"

namespace hexcal {

std::string RevisionText() { return \"${revision}\"; }

}  // namespace hexcal
")
set(before "")
if(EXISTS "${OUT}")
  file(READ "${OUT}" before)
endif()
if(NOT text STREQUAL before)
  file(WRITE "${OUT}" "${text}")
endif()
