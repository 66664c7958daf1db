// Hot loops compiled twice: for any x86-64 and for processors with AVX, which need fewer instructions for the
// same operations; what they call is compiled into them. The loader takes what the processor has. Without FMA
// no operation is fused, so results are the same to the last bit.
#pragma once

// Sanitizers instrument what the loader calls before they are ready.
#if defined(__x86_64__) && defined(__gnu_linux__) && defined(__GNUC__) && !defined(__clang__) && \
    !defined(__AVX__) && !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
#define MSPSKEL_AVX_CLONES __attribute__((target_clones("avx", "default"), flatten))
#else
#define MSPSKEL_AVX_CLONES
#endif
