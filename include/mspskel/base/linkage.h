// Implementations stand in detail/*_impl.h. Header-only, a public header includes its own, and everything is
// inline; with the compiled library (MSPSKEL_COMPILED) public headers only declare, and src/ compiles each
// implementation once.
#pragma once

#ifdef MSPSKEL_COMPILED
#define MSPSKEL_INLINE
#else
#define MSPSKEL_INLINE inline
#endif
