# cmake -DSOURCE=DIR -DOUTPUT=FILE -P source_commit.cmake: a source file that says which commit was built; left alone where it does.
execute_process(COMMAND git -C "${SOURCE}" describe --always --dirty --exclude "*"
  OUTPUT_VARIABLE commit OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET RESULT_VARIABLE failed)
if(failed)
  set(commit unknown)
endif()
file(CONFIGURE OUTPUT "${OUTPUT}" CONTENT [[
#include "toolchain/command_line/source_commit.h"

const char* const godobject::command::kSourceCommit = "@commit@";
]] @ONLY)
