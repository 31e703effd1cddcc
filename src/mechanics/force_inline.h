// Inlining is what makes derived equations of motion as fast as hand-written ones: with every dual
// operation visible the compiler deletes the terms whose seeds are literal zeros.
#pragma once

#define WHIRL_TWIN_INLINE inline __attribute__((always_inline))
