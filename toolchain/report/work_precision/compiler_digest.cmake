# Writes a source with the digest of LIBRARIES, a comma-separated list of files: those that make images.
string(REPLACE "," ";" LIBRARIES "${LIBRARIES}")
set(digests "")
foreach(library ${LIBRARIES})
  file(SHA256 "${library}" digest)
  string(APPEND digests "${digest}")
endforeach()
string(SHA256 digest "${digests}")
file(WRITE "${OUTPUT}" "#include \"toolchain/report/work_precision/compiler_digest.h\"

namespace godobject::report {

const char* compiler_digest() { return \"${digest}\"; }

}  // namespace godobject::report
")
