# Warnings of every target; errors where this is the top-level project. `godobject_embedded` adds what holds in the rooms that run on the device.

add_library(godobject_warnings INTERFACE)
target_compile_options(godobject_warnings INTERFACE
  -Wall -Wextra -Wpedantic -Wshadow -Wconversion -Wsign-conversion -Wold-style-cast -Wnon-virtual-dtor -Wcast-align
  -Wundef $<$<BOOL:${PROJECT_IS_TOP_LEVEL}>:-Werror>)

# -Wnull-dereference only here: it misfires on GCC 12's own std::vector, which these rooms do not use.
# Each function has a section of its own: a program linked with --gc-sections holds only what it calls.
# Stack use is that of what runs on the device: without optimiser, or with a sanitizer, the figure means nothing.
add_library(godobject_embedded INTERFACE)
target_link_libraries(godobject_embedded INTERFACE godobject_warnings)
target_compile_options(godobject_embedded INTERFACE
  -fno-exceptions -fno-rtti -fno-threadsafe-statics -ffunction-sections -fdata-sections
  -Wvla -Wdouble-promotion -Wnull-dereference
  $<$<CONFIG:Release,RelWithDebInfo,MinSizeRel>:-Wstack-usage=16384>)
