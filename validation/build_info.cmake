# Run at every build: writes OUTPUT (a C++ source) with the commit of the source tree, touching it only when it changed.
execute_process(COMMAND git -C "${SOURCE_ROOT}" rev-parse --short=12 HEAD
  OUTPUT_VARIABLE COMMIT OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET RESULT_VARIABLE FAILED)
if(FAILED)
  set(COMMIT "unknown")
else()
  execute_process(COMMAND git -C "${SOURCE_ROOT}" status --porcelain --untracked-files=no
    OUTPUT_VARIABLE CHANGES OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET)
  if(NOT CHANGES STREQUAL "")
    string(APPEND COMMIT "-dirty")
  endif()
endif()
file(READ "${FLAGS_FILE}" FLAGS)
configure_file("${TEMPLATE}" "${OUTPUT}" @ONLY)
