#pragma once

/// Attribute of a function: the compiler makes one version for each width of the processor's vectors, and the loader
/// chooses one. The source is compiled without fused products (CMakeLists.txt), so all versions give the same bits.
/// (The attribute names a feature: "arch=" would match only processors of that manufacturer.)
#if defined(__x86_64__) && defined(__gnu_linux__)
#define GODOBJECT_VECTOR_WIDTHS __attribute__((target_clones("avx2", "default")))
#else
#define GODOBJECT_VECTOR_WIDTHS
#endif
