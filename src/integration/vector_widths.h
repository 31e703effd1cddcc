// One function, compiled for several widths of vector: the machine's widest is taken at start-up,
// and the build still runs on any x86-64.
#pragma once

#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__)
#define WHIRL_TWIN_VECTOR_WIDTHS \
  __attribute__((target_clones("avx512f", "arch=haswell", "default")))
#else
#define WHIRL_TWIN_VECTOR_WIDTHS
#endif
