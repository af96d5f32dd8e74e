#include <fcntl.h>
#include <sys/mman.h>
#include <unistd.h>

#include <cstdlib>
#include <cstring>

#include "toolchain/mutation/schemata.h"

#ifndef MUTANT_PLACES
#error "define MUTANT_PLACES: the number of places of the mutated tree"
#endif

namespace mutant {

unsigned char chosen[MUTANT_PLACES];

namespace {

unsigned char* record = nullptr;

/// Maps the file of the variable GODOBJECT_MUTANT_REACHED, so that the record outlives a crash and is shared with child
/// processes. The file has a byte for each place.
void begin_record(const char* path) {
  const int file = open(path, O_RDWR | O_CLOEXEC);
  if (file < 0) return;
  void* mapped = mmap(nullptr, MUTANT_PLACES, PROT_READ | PROT_WRITE, MAP_SHARED, file, 0);
  close(file);
  if (mapped == MAP_FAILED) return;
  record = static_cast<unsigned char*>(mapped);
  std::memset(chosen, kRecord, sizeof(chosen));
}

/// GODOBJECT_MUTANT=PLACE:ALTERNATIVE activates a mutant.
__attribute__((constructor(101))) void start() {
  if (const char* path = std::getenv("GODOBJECT_MUTANT_REACHED")) begin_record(path);
  if (const char* text = std::getenv("GODOBJECT_MUTANT")) {
    char* end = nullptr;
    const unsigned long place = std::strtoul(text, &end, 10);
    if (*end != ':' || place >= MUTANT_PLACES) return;
    chosen[place] = static_cast<unsigned char>(std::strtoul(end + 1, nullptr, 10));
  }
}

}  // namespace

unsigned char reached(unsigned place) noexcept {
  chosen[place] = 0;
  if (record != nullptr) record[place] = 1;
  return 0;
}

}  // namespace mutant
