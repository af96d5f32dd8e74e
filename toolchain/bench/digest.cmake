# cmake -DFILE=ARCHIVE -DOUTPUT=SOURCE -P digest.cmake: writes a source file with the SHA-256 of ARCHIVE.
file(SHA256 "${FILE}" digest)
file(WRITE "${OUTPUT}" "#include \"toolchain/bench/build_facts.h\"

namespace godobject::bench {
const char* const kCompilerDigest = \"${digest}\";
}  // namespace godobject::bench
")
