// SPDX-License-Identifier: Apache-2.0
// KeepFreedMemory: what a program that solves many problems calls first.
//
// The C library of GNU gives freed memory back to the system at once, from 128 kB on: a matrix of 130 rows. Its
// next allocation then costs more than a small problem's solution. It concerns the whole process, so no
// function of the library calls it.

#pragma once

#include <cstdlib>
#ifdef __GLIBC__
#include <malloc.h>
#endif

namespace stiction {

// Up to 256 MB that are free stay with the process, in blocks of up to 32 MB. Elsewhere nothing is done.
inline void KeepFreedMemory() {
#ifdef __GLIBC__
  mallopt(M_MMAP_THRESHOLD, 32 << 20);
  mallopt(M_TRIM_THRESHOLD, 256 << 20);
#endif
}

}  // namespace stiction
