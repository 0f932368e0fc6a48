// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

/// @file
/// What stands before every function that may run on a GPU: CUDA and HIP compilers have to be told,
/// to all others it is nothing.

#pragma once

#if defined(__CUDACC__) || defined(__HIPCC__)
#define REGAIN_HOST_DEVICE __host__ __device__
#else
#define REGAIN_HOST_DEVICE
#endif

/// The same before the small functions that everything else is made of, and before those that make
/// up an eval or a sample. Vectors of floats go through memory where a function is called, which
/// costs more than such a function does, and the compiler's own estimate does not know that. Where
/// time to compile counts for more, REGAIN_NO_FORCED_INLINE leaves it to the compiler, as
/// sanitizers do.
#if defined(__GNUC__) && !defined(__CUDACC__) && !defined(__HIPCC__) && \
    !defined(__SANITIZE_ADDRESS__) && !defined(REGAIN_NO_FORCED_INLINE)
#define REGAIN_INLINE inline __attribute__((always_inline))
#else
#define REGAIN_INLINE REGAIN_HOST_DEVICE inline
#endif
