#pragma once

/// Of a function: one version for each width of the processor's vectors, chosen when the program is loaded. Its source
/// takes no fused products (CMakeLists.txt), so all versions give the same bits. (By a feature: "arch=" would be chosen
/// on processors of that make only.)
#if defined(__x86_64__) && defined(__gnu_linux__)
#define GODOBJECT_VECTOR_WIDTHS __attribute__((target_clones("avx2", "default")))
#else
#define GODOBJECT_VECTOR_WIDTHS
#endif
