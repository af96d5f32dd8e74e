// A full disk for the logs of a process: a library for LD_PRELOAD. A file that the process makes below an open folder
// appears, but takes no byte. hand.csv is spared: a run whose hand.csv cannot be written ends with an error.
#include <dlfcn.h>
#include <fcntl.h>
#include <unistd.h>

#include <cstdarg>
#include <cstring>

namespace {

int open_in_folder(const char* function, int folder, const char* file, int flags, mode_t mode) {
  using Open = int (*)(int, const char*, int, ...);
  auto* const open = reinterpret_cast<Open>(::dlsym(RTLD_NEXT, function));
  const int made = open(folder, file, flags, mode);
  if (made < 0 || (flags & O_CREAT) == 0 || std::strcmp(file, "hand.csv") == 0) return made;
  ::close(made);
  return ::open("/dev/full", O_WRONLY | O_APPEND | O_CLOEXEC);
}

}  // namespace

/// The controller makes its logs with this function.
extern "C" int openat(int folder, const char* file, int flags, ...) {
  va_list rest;
  va_start(rest, flags);
  const mode_t mode = (flags & O_CREAT) != 0 ? va_arg(rest, mode_t) : 0;
  va_end(rest);
  return open_in_folder("openat", folder, file, flags, mode);
}

/// The same function with another name, where files may be large.
extern "C" int openat64(int folder, const char* file, int flags, ...) {
  va_list rest;
  va_start(rest, flags);
  const mode_t mode = (flags & O_CREAT) != 0 ? va_arg(rest, mode_t) : 0;
  va_end(rest);
  return open_in_folder("openat64", folder, file, flags, mode);
}
