# cmake -DFILE=ARCHIVE -DOUTPUT=SOURCE -P compiler_digest.cmake: writes a source file with the SHA-256 of ARCHIVE.
file(SHA256 "${FILE}" digest)
file(WRITE "${OUTPUT}" "#include \"toolchain/scene_compiler/compiler_digest.h\"

namespace godobject::scene_compiler {

const char* compiler_digest() { return \"${digest}\"; }

}  // namespace godobject::scene_compiler
")
