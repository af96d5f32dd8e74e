// Everything that core_symbols must find. Built for that check's own test and linked nowhere.
#include <pthread.h>

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>

namespace godobject::planted {

struct Guarded {
  Guarded();
  ~Guarded();
  int value;
};

void keep(void* block);  // nowhere: the optimiser must believe that somebody looks

void forbidden(void* block, int* number, std::size_t bytes, pthread_mutex_t* mutex, double x) {
  static Guarded guarded;
  pthread_mutex_lock(mutex);
  keep(std::malloc(bytes));
  keep(std::calloc(bytes, 8));
  keep(std::memcpy(std::realloc(block, 2 * bytes), number, bytes));
  keep(::operator new(bytes));
  keep(std::fopen("planted", "r"));
  std::free(mutex);
  delete number;
  std::printf("%f %d\n", std::sqrt(x), guarded.value);
  if (std::getenv("PLANTED") == nullptr) throw bytes;
  if (x > 1.0) std::abort();
}

}  // namespace godobject::planted
