# cmake -DSOURCE=DIR -DOUTPUT=FILE -P source_commit.cmake
# Writes a source file with the commit that is built. Leaves it alone if it has that commit already.
execute_process(COMMAND git -C "${SOURCE}" describe --always --dirty --exclude "*"
  OUTPUT_VARIABLE commit OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET RESULT_VARIABLE failed)
if(failed)
  set(commit unknown)
endif()
file(CONFIGURE OUTPUT "${OUTPUT}" CONTENT [[
#include "toolchain/command_line/source_commit.h"

const char* const godobject::command::kSourceCommit = "@commit@";
]] @ONLY)
