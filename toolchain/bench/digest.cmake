# cmake -DFILE=ARCHIVE -DOUTPUT=SOURCE -P digest.cmake: a source file that names what ARCHIVE holds.
file(SHA256 "${FILE}" digest)
file(WRITE "${OUTPUT}" "#include \"toolchain/bench/build_facts.h\"

namespace godobject::bench {
const char* const kCompilerDigest = \"${digest}\";
}  // namespace godobject::bench
")
