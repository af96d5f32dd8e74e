# Options for code that runs once or leaves long computing to libraries: tests, commands and the rows of the report. GCC
# takes a third less time than with -O1 or -O3. -Og alone runs three times slower than -O1, because it keeps each vector of
# Eigen in memory; with these three passes it takes half as long again as -O1. Under -Og one warning misfires in the standard
# library.
set(QUICK_TO_COMPILE
  $<$<CONFIG:Release>:$<IF:$<CXX_COMPILER_ID:GNU>,-Og;-ftree-sra;-ftree-pta;-finline-functions-called-once;-Wno-maybe-uninitialized,-O1>>)
