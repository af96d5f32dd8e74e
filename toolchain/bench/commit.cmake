# cmake -DSOURCE=DIR -DOUTPUT=SOURCE -P commit.cmake: a source file that names the commit, written only when it has changed.
cmake_policy(VERSION 3.25)
execute_process(COMMAND git -C "${SOURCE}" describe --always --dirty --abbrev=12
  OUTPUT_VARIABLE commit OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET RESULT_VARIABLE failed)
if(failed)
  set(commit "unknown")
endif()
file(CONFIGURE OUTPUT "${OUTPUT}" CONTENT "#include \"toolchain/bench/build_facts.h\"

namespace godobject::bench {
const char* const kSourceCommit = \"@commit@\";
}  // namespace godobject::bench
" @ONLY)
