// Another machine for processes that look at theirs: a library for LD_PRELOAD. Streams that read a file below /proc or
// /sys read the file of that name in the folder GODOBJECT_FAKE_MACHINE, and nothing where it has none.
#include <dlfcn.h>

#include <cstdio>
#include <cstdlib>
#include <string>

namespace {

/// The file that stands for this one.
std::string stand_in(const char* file) {
  const std::string path = file;
  const char* const folder = std::getenv("GODOBJECT_FAKE_MACHINE");
  if (folder == nullptr || !(path.starts_with("/proc/") || path.starts_with("/sys/"))) return path;
  return folder + path;
}

}  // namespace

/// The streams of the C++ library open their files with this function.
extern "C" FILE* fopen64(const char* file, const char* mode) {
  static auto* const open = reinterpret_cast<decltype(fopen64)*>(::dlsym(RTLD_NEXT, "fopen64"));
  return open(stand_in(file).c_str(), mode);
}
